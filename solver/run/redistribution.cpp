#include "solver/run/redistribution.hpp"

#include <fmt/format.h>

#include "solver/parallel/root.hpp"
#include "solver/run/balance.hpp"

namespace mpfem {

namespace {

/// Times of fewer steps are mostly those of other programs.
constexpr std::int64_t steps_worth_measuring = 200;

/// s that this rank has worked so far, without waiting for others.
double busy_time(const Profile& profile) {
  double busy = 0;
  for (const Part part : {Part::elements, Part::contact, Part::integration, Part::surface})
    busy += profile.seconds(part);
  return busy;
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
  const double busy = busy_time(simulation_.profile());
  const Balance balance = measure_balance(ranks, simulation_.model(), busy - busy_before_);
  busy_before_ = busy;
  Owners owners = redistribute(ranks, simulation_.model(), balance);
  const double expected = expected_imbalance(simulation_.model(), balance, *owners);
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
