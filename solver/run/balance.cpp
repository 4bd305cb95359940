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

/// s that the tets of a grain have cost its owner.
double cost_of(const Model& model, const Balance& balance, std::int32_t grain) {
  return tets_of(model, grain) * balance.busy_of_tet[at(model.ownership.owner[at(grain)])];
}

} // namespace

Balance measure_balance(const Communicator& ranks, const Model& model, double busy) {
  std::vector<double> busy_of_rank, tets(at(ranks.size()), 0.0);
  for (const Bytes& message : ranks.all_of(bytes_of(std::span<const double>(&busy, 1))))
    busy_of_rank.push_back(MessageReader(message).take<double>());
  for (std::int32_t g = 0; g < model.grains; ++g) tets[at(model.ownership.owner[at(g)])] += tets_of(model, g);
  Balance balance{.imbalance = imbalance_of(busy_of_rank), .busy_of_tet = {}};
  for (std::size_t rank = 0; rank < tets.size(); ++rank)
    balance.busy_of_tet.push_back(tets[rank] > 0 ? busy_of_rank[rank] / tets[rank] : 0.0);
  return balance;
}

std::vector<std::int32_t> redistribute(const Communicator& ranks, const Model& model, const Balance& balance) {
  std::vector<std::array<double, 3>> centre(at(model.grains));
  std::vector<double> weight(at(model.grains));
  for (const std::int32_t grain : model.own()) {
    const auto first = at(model.node_offset[at(grain)]), end = first + at(model.surface_node_count[at(grain)]);
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis)
        centre[at(grain)][axis] += model.position[4 * n + axis] / static_cast<double>(end - first);
  }
  share_of_grains(ranks, model.ownership, std::span<std::array<double, 3>>(centre));
  for (std::int32_t g = 0; g < model.grains; ++g) weight[at(g)] = cost_of(model, balance, g);
  return divide_among_ranks(centre, weight, ranks.size());
}

double expected_imbalance(const Model& model, const Balance& balance, std::span<const std::int32_t> owner) {
  std::vector<double> busy(balance.busy_of_tet.size(), 0.0);
  for (std::int32_t g = 0; g < model.grains; ++g) busy[at(owner[at(g)])] += cost_of(model, balance, g);
  return imbalance_of(busy);
}

bool pays(const Balance& balance, double expected, double remaining, double reload) {
  const double saved_share = 1 - expected / balance.imbalance;
  return balance.imbalance > least_gain * expected && remaining * saved_share > 2 * reload;
}

} // namespace mpfem
