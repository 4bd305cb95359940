#include "solver/run/redistribution.hpp"

#include <fmt/format.h>

#include "common/index.hpp"
#include "solver/parallel/root.hpp"

namespace mpfem {

namespace {

/// Times of fewer steps are mostly those of other programs.
constexpr std::int64_t steps_worth_measuring = 200;

/// What this rank has worked so far.
BusyTime busy_time(const Profile& profile) {
  BusyTime busy{.contact = profile.seconds(Part::contact)};
  for (const Part part : {Part::elements, Part::integration, Part::surface}) busy.tets += profile.seconds(part);
  return busy;
}

/// Work on contact of each grain ([grains]), in units of a point that carries a force: one for each point of its nodes
/// that touches, one for each whose bond pulls, and a little for each candidate.
std::vector<double> work_of_contact(const Contact& contact, std::size_t grains) {
  constexpr double of_candidate = 0.03; // 8 of 280 ns, measured with `mpfem bench` on loose and dense grains
  const ContactCandidates& candidates = contact.candidates;
  std::vector<double> work(grains, 0.0);
  for (std::size_t pair = 0; pair < contact.active.size(); ++pair) {
    const std::int32_t points = candidates.pair_point_offset[pair + 1] - candidates.pair_point_offset[pair];
    const std::int32_t pulling = contact.pulling.empty() ? 0 : contact.pulling[pair];
    work[at(candidates.pair_first[pair])] += contact.active[pair] + pulling + of_candidate * points;
  }
  return work;
}

} // namespace

Redistribution::Redistribution(const Simulation& simulation, const RunReport& report, Redistribute redistribute,
                               double reload)
    : simulation_(simulation), report_(report), redistribute_(redistribute), reload_(reload),
      measured_from_step_(simulation.state().step) {}

Owners Redistribution::new_owners(double remaining) {
  const std::int64_t step = simulation_.state().step;
  if (simulation_.ranks().alone() || redistribute_ == Redistribute::never ||
      step - measured_from_step_ < steps_worth_measuring)
    return std::nullopt;
  measured_from_step_ = step;
  return redistribute_ == Redistribute::always ? owners_in_turn() : owners_by_work(remaining);
}

Owners Redistribution::owners_by_work(double remaining) {
  const Communicator& ranks = simulation_.ranks();
  const Model& model = simulation_.model();
  const BusyTime busy = busy_time(simulation_.profile());
  const BusyTime since{busy.tets - busy_before_.tets, busy.contact - busy_before_.contact};
  busy_before_ = busy;
  const Balance balance =
      measure_balance(ranks, model, work_of_contact(simulation_.contact(), at(model.grains)), since);
  Owners owners = redistribute(ranks, model, balance);
  const double expected = expected_imbalance(balance, *owners, ranks.size());
  if (!root_finds(ranks, [&] { return pays(balance, expected, remaining, reload_); })) return std::nullopt;
  report_.note(fmt::format("the busiest rank has {:.0f} % more work than the mean: redistributing grains",
                           100 * (balance.imbalance - 1)));
  return owners;
}

/// Every grain goes to the rank after its own.
Owners Redistribution::owners_in_turn() const {
  std::vector<std::int32_t> owners = simulation_.model().ownership.owner;
  for (std::int32_t& owner : owners) owner = (owner + 1) % simulation_.ranks().size();
  report_.note("redistributing grains: each goes to the next rank");
  return owners;
}

} // namespace mpfem
