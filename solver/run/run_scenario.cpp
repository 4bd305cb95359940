#include "solver/run/run_scenario.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/run_stem.hpp"
#include "solver/model/bond_resolution.hpp"
#include "solver/output/earlier_run.hpp"
#include "solver/output/run_lock.hpp"
#include "solver/parallel/root.hpp"
#include "solver/run/check_output.hpp"
#include "solver/run/checkpoints.hpp"
#include "solver/run/continuation.hpp"
#include "solver/run/interrupt.hpp"
#include "solver/run/make_tools.hpp"
#include "solver/run/needs.hpp"
#include "solver/run/plan_text.hpp"
#include "solver/run/plausibility.hpp"
#include "solver/run/run_records.hpp"
#include "solver/run/run_report.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_forecast.hpp"
#include "solver/run/time_loop.hpp"

namespace mpfem {

namespace {

/// Reads the packing and makes the model. Both may take a while, so a request to stop is checked in between.
Model load_model(const Scenario& scenario, const RunOptions& options, const Communicator& ranks, const Owners& owners) {
  const std::string checkpoint = name_of_checkpoint(options.output);
  stop_before_first_step(ranks, checkpoint);
  const MeshedPacking packing = read_packing(scenario.packing_file, ranks, owners);
  stop_before_first_step(ranks, checkpoint);
  Model model = build_model(packing, scenario, scenario.packing_file, ranks);
  stop_before_first_step(ranks, checkpoint);
  return model;
}

/// How run_once() ends.
enum class RunEnd {
  complete,
  must_start_again, ///< nothing that could be resumed is usable: without --resume
  redistributed     ///< the checkpoint just written goes on with other owners of grains
};

struct Outcome {
  RunEnd end;
  Owners owners{}; ///< if `redistributed`
};

/// What a reader of the results should know beforehand.
void report_beginning(const RunReport& report, const std::vector<std::string>& warnings, const Simulation& simulation) {
  for (const std::string& warning : warnings) report.warning(warning);
  for (const std::string& text :
       {mass_scaling_text(simulation.scenario(), simulation.model()), earlier_bonds_text(simulation.contact())})
    if (!text.empty()) report.note(text);
  for (const std::string& text : simulation.tools().moved_back()) report.note(text);
}

/// A warning, if there is one. Space that earlier files of the same run take is free for it, unless they are kept.
void check_disk_space(const Scenario& scenario, const RunOptions& options, double needed, const RunReport& report) {
  const double kept = options.keeps_earlier_run ? space_of_kept_run(options.output) : 0;
  const double available = available_disk_space(options.output) + size_on_disk(scenario, options.output) - kept;
  if (const std::string scarce = check_needs(options.output, {.disk = needed}, {.disk = available}); !scarce.empty())
    report.warning(scarce);
}

/// What an earlier run of this name has left: the run file is kept, unless --resume makes a complete run again whose
/// checkpoints were lost; its rolling checkpoints go.
void clear_way(const Continuation& continuation, const RunOptions& options, const RunReport& report) {
  if (options.keeps_earlier_run || is_unfinished(options.output))
    if (const std::string kept = keep_earlier_run(options.output, !options.keeps_earlier_run); !kept.empty())
      report.note_despite_quiet(kept);
  continuation.discard_unfinished_run();
}

/// What goes on while the grains of a run change their owners.
struct Whole {
  RunReport report;
  std::optional<PaceOrigin> origin{};
  Needs needs{}; ///< of the first rank
};

/// Prepares a simulation where the run begins, and runs it.
Outcome run_once(const Scenario& scenario, const RunOptions& options, const Communicator& ranks, const Owners& owners,
                 Whole& whole) {
  const auto begun = Profile::Clock::now();
  ThreadTeam team(options.threads);
  Simulation simulation(load_model(scenario, options, ranks, owners), scenario, team, options.from.has_value(), ranks);
  RunReport& report = whole.report;
  RunRecord record;
  Continuation continuation(simulation, record, options, report);
  auto warnings = implausible_values(scenario);
  std::ranges::copy(implausible_sizes(scenario, simulation.model(), simulation.tools()), std::back_inserter(warnings));
  std::ranges::copy(check_bonds(simulation.model(), scenario, ranks), std::back_inserter(warnings));
  const Beginning beginning = continuation.begin();
  if (beginning == Beginning::must_start_again) return {RunEnd::must_start_again};
  stop_before_first_step(ranks, name_of_checkpoint(options.output));
  if (beginning == Beginning::complete) return {RunEnd::complete};
  check_stages(scenario, simulation.state().stage, simulation.stage_run().state().start, simulation.model(),
               simulation.step_estimate().stable_step());
  if (!owners) {
    root_does(ranks, [&] { check_disk_space(scenario, options, whole.needs.disk, report); });
    report_beginning(report, warnings, simulation);
  }
  if (beginning == Beginning::fresh) root_does(ranks, [&] { clear_way(continuation, options, report); });
  RunRecords records(simulation, record, options);
  if (beginning == Beginning::fresh) records.pass_checkpoint_densities(); // those that the packing has from the start
  TimeLoop loop(simulation, records, continuation, report, options, Profile::since(begun), whole.origin);
  const Owners new_owners = loop.run();
  return {new_owners ? RunEnd::redistributed : RunEnd::complete, new_owners};
}

} // namespace

void run_scenario(const Scenario& scenario, const RunOptions& given, const Communicator& ranks) {
  RunOptions options = given;
  if (!ranks.is_root()) options.quiet = true;
  options.keeps_earlier_run = !given.resume;
  std::optional<RunLock> lock;
  Whole whole{.report = RunReport(ranks.is_root(), options.quiet)};
  root_does(ranks, [&] {
    check_output(scenario, options);
    whole.needs = needs_of(scenario, ranks.size());
    if (options.keeps_earlier_run) refuse_other_files(options.output);
  });
  if (const std::string scarce = check_memory(options.output, whole.needs.memory, ranks); !scarce.empty())
    whole.report.warning(scarce);
  root_does(ranks, [&] {
    lock.emplace(options.output);
    remove_partial_files(scenario, options.output);
  });
  for (Owners owners;;) {
    const auto begun = Profile::Clock::now();
    const Outcome outcome = run_once(scenario, options, ranks, owners, whole);
    if (outcome.end == RunEnd::complete) return;
    options.resume = options.redistributed = outcome.end == RunEnd::redistributed;
    owners = outcome.owners;
    if (options.time_limit > 0) options.time_limit = std::max(options.time_limit - Profile::since(begun), 1e-9);
  }
}

} // namespace mpfem
