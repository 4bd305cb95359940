#include "solver/run/run_pace.hpp"

namespace mpfem {

RunPace::RunPace(const Simulation& simulation, std::optional<PaceOrigin>& origin)
    : simulation_(simulation), origin_(origin), start_(Profile::Clock::now()), first_step_(simulation.state().step) {
  if (origin_) return;
  const std::int64_t stage = simulation.state().stage;
  origin_ = {.time = start_,
             .stage = stage,
             .expected =
                 forecast(simulation.scenario(), stage, simulation.stage_run().state().start, simulation.model())};
  origin_->done = fraction_done();
}

double RunPace::fraction_done() const {
  const std::int64_t present = simulation_.state().stage;
  const double of_present = simulation_.stage_run().fraction_done(simulation_.box().mean_stress());
  double done = 0, all = 0;
  for (std::size_t i = 0; i < origin_->expected.size(); ++i) {
    const std::int64_t stage = origin_->stage + static_cast<std::int64_t>(i);
    const double duration = origin_->expected[i].duration;
    all += duration;
    done += duration * (stage < present ? 1.0 : stage == present ? of_present : 0.0);
  }
  return all > 0 ? done / all : 0.0;
}

double RunPace::remaining() const {
  const double done = fraction_done();
  return done > origin_->done ? Profile::since(origin_->time) * (1 - done) / (done - origin_->done) : 0;
}

double RunPace::nanoseconds_per_tet_step() const {
  const auto steps = static_cast<double>(simulation_.state().step - first_step_);
  return steps > 0 ? 1e9 * Profile::since(start_) / (steps * static_cast<double>(simulation_.model().tets())) : 0.0;
}

} // namespace mpfem
