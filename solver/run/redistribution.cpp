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

Redistribution::Redistribution(const Simulation& simulation, const RunReport& report, double reload)
    : simulation_(simulation), report_(report), reload_(reload), measured_from_step_(simulation.state().step) {}

Owners Redistribution::new_owners(double remaining) {
  const Communicator& ranks = simulation_.ranks();
  const std::int64_t step = simulation_.state().step;
  if (ranks.alone() || step - measured_from_step_ < steps_worth_measuring) return std::nullopt;
  measured_from_step_ = step;
  const double busy = busy_time(simulation_.profile());
  const Balance balance = measure_balance(ranks, simulation_.model(), busy - busy_before_);
  busy_before_ = busy;
  if (!root_finds(ranks, [&] { return pays(balance, remaining, reload_); })) return std::nullopt;
  Owners owners = redistribute(ranks, simulation_.model(), balance);
  report_.note(fmt::format("the busiest rank has {:.0f} % more work than the mean: redistributing grains",
                           100 * (balance.imbalance - 1)));
  return owners;
}

} // namespace mpfem
