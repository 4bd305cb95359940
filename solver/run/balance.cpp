#include "solver/run/balance.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "common/index.hpp"
#include "solver/parallel/grain_values.hpp"

namespace mpfem {

namespace {

/// Less work of the busiest rank than by this factor is not worth a new division: measured times scatter as much.
constexpr double least_gain = 1.05;

double tets_of(const Model& model, std::int32_t grain) {
  return model.tet_offset[at(grain) + 1] - model.tet_offset[at(grain)];
}

/// Largest of some busy times over their mean.
double imbalance_of(std::span<const double> busy) {
  const double sum = std::accumulate(busy.begin(), busy.end(), 0.0);
  return sum > 0 ? *std::ranges::max_element(busy) * static_cast<double>(busy.size()) / sum : 1;
}

/// s that `amount` has cost if `all` of it has cost `seconds`.
double share(double amount, double all, double seconds) {
  return all > 0 ? amount / all * seconds : 0;
}

} // namespace

Balance measure_balance(const Communicator& ranks, const Model& model, std::span<const double> contact_work,
                        const BusyTime& busy) {
  std::vector<double> busy_of_rank;
  const double own_busy = busy.total();
  for (const Bytes& message : ranks.all_of(bytes_of(std::span<const double>(&own_busy, 1))))
    busy_of_rank.push_back(MessageReader(message).take<double>());

  double all_tets = 0, all_work = 0;
  for (const std::int32_t g : model.own()) {
    all_tets += tets_of(model, g);
    all_work += contact_work[at(g)];
  }
  const double by_tets = all_work > 0 ? busy.tets : own_busy; // grains without any near them
  Balance balance{.imbalance = imbalance_of(busy_of_rank), .cost = std::vector<double>(at(model.grains))};
  for (const std::int32_t g : model.own())
    balance.cost[at(g)] =
        share(tets_of(model, g), all_tets, by_tets) + share(contact_work[at(g)], all_work, busy.contact);
  share_of_grains(ranks, model.ownership, std::span(balance.cost));
  return balance;
}

std::vector<std::int32_t> redistribute(const Communicator& ranks, const Model& model, const Balance& balance) {
  std::vector<std::array<double, 3>> centre(at(model.grains));
  for (const std::int32_t grain : model.own()) {
    const std::size_t first = model.first_node(grain), end = first + at(model.surface_node_count[at(grain)]);
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis)
        centre[at(grain)][axis] += model.position[4 * n + axis] / static_cast<double>(end - first);
  }
  share_of_grains(ranks, model.ownership, std::span<std::array<double, 3>>(centre));
  return divide_among_ranks(centre, balance.cost, ranks.size());
}

double expected_imbalance(const Balance& balance, std::span<const std::int32_t> owner, int ranks) {
  std::vector<double> busy(at(ranks), 0.0);
  for (std::size_t g = 0; g < owner.size(); ++g) busy[at(owner[g])] += balance.cost[g];
  return imbalance_of(busy);
}

bool pays(const Balance& balance, double expected, double remaining, double reload) {
  const double saved_share = 1 - expected / balance.imbalance;
  return balance.imbalance > least_gain * expected && remaining * saved_share > 2 * reload;
}

} // namespace mpfem
