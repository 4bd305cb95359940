#include "solver/run/checkpoint_writer.hpp"

#include "common/run_stem.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/interrupt.hpp"

namespace mpfem {

CheckpointWriter::CheckpointWriter(Simulation& simulation, RunRecords& records, const RunOptions& options)
    : simulation_(simulation), records_(records), options_(options), start_(Profile::Clock::now()), last_(start_) {}

/// Collective. Clocks and signals of the ranks differ: the largest reason of all counts.
CheckpointReason CheckpointWriter::reason() const {
  CheckpointReason own = CheckpointReason::none;
  if (interrupt_requested())
    own = CheckpointReason::interrupted;
  else if (options_.time_limit > 0 && Profile::since(start_) > options_.time_limit)
    own = CheckpointReason::out_of_time;
  else if (Profile::since(last_) >= simulation_.scenario().output.checkpoint_interval)
    own = CheckpointReason::interval;
  return static_cast<CheckpointReason>(static_cast<int>(simulation_.ranks().largest(static_cast<int>(own))));
}

void CheckpointWriter::save_stage_checkpoint() const {
  records_.save_checkpoint(name_of_kept_checkpoint(options_.output, simulation_.stage().name));
}

CheckpointReason CheckpointWriter::write_due() {
  const bool stage_end = simulation_.stage_complete();
  const CheckpointReason due = reason();
  const std::vector<double> passed = records_.pass_checkpoint_densities();
  if (!stage_end && due == CheckpointReason::none && passed.empty()) return due;
  const auto start = Profile::Clock::now();
  for (const double density : passed) records_.save_checkpoint(density_checkpoint_path(options_.output, density));
  if (stage_end) save_stage_checkpoint();
  // Last: it counts as done the stages and densities whose checkpoints are on disk by now.
  replace_rolling_checkpoint(simulation_.ranks(), options_.output,
                             [this](const std::string& path) { records_.save_checkpoint(path); });
  last_ = Profile::Clock::now();
  simulation_.profile().add_serial(Part::output, Profile::since(start));
  return due;
}

} // namespace mpfem
