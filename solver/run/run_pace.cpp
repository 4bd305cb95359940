#include "solver/run/run_pace.hpp"

namespace mpfem {

RunPace::RunPace(const Simulation& simulation)
    : simulation_(simulation), start_(Profile::Clock::now()), first_step_(simulation.state().step),
      first_stage_(simulation.state().stage),
      expected_(
          forecast(simulation.scenario(), first_stage_, simulation.stage_run().state().start, simulation.model())),
      done_at_start_(fraction_done()) {}

double RunPace::fraction_done() const {
  const std::int64_t present = simulation_.state().stage;
  const double of_present = simulation_.stage_run().fraction_done(simulation_.box().mean_stress());
  double done = 0, all = 0;
  for (std::size_t i = 0; i < expected_.size(); ++i) {
    const std::int64_t stage = first_stage_ + static_cast<std::int64_t>(i);
    all += expected_[i].duration;
    done += expected_[i].duration * (stage < present ? 1.0 : stage == present ? of_present : 0.0);
  }
  return all > 0 ? done / all : 0.0;
}

double RunPace::remaining() const {
  const double done = fraction_done();
  return done > done_at_start_ ? Profile::since(start_) * (1 - done) / (done - done_at_start_) : 0;
}

double RunPace::nanoseconds_per_tet_step() const {
  const auto steps = static_cast<double>(simulation_.state().step - first_step_);
  return steps > 0 ? 1e9 * Profile::since(start_) / (steps * static_cast<double>(simulation_.model().tets())) : 0.0;
}

} // namespace mpfem
