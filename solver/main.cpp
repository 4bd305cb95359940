// mpfem: explicit finite-strain elasto-plastic finite elements of every grain of a packing.

#include <algorithm>
#include <filesystem>

#include <malloc.h>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/table_reader.hpp"
#include "common/version.hpp"
#include "solver/bench/bench.hpp"
#include "solver/hand_over.hpp"
#include "solver/parallel/on_all_ranks.hpp"
#include "solver/parallel/root.hpp"
#include "solver/parallel/same_on_all_ranks.hpp"
#include "solver/parallel/share_of_cores.hpp"
#include "solver/run/bond_programme.hpp"
#include "solver/run/build_text.hpp"
#include "solver/run/check_scenario.hpp"
#include "solver/run/interrupt.hpp"
#include "solver/run/run_scenario.hpp"
#include "solver/scenario/read_scenario.hpp"

namespace {

using namespace mpfem;

struct Arguments {
  std::string scenario;
  std::vector<std::string> assignments;
  std::string from; ///< checkpoint; empty: none
  RunOptions run;
};

/// The text of a TOML string; other text as it is.
std::string without_quotes(const std::string& value) {
  if (value.empty() || (value.front() != '"' && value.front() != '\'')) return value;
  TomlDocument document = TomlDocument::from_text("", "");
  document.set("packing=" + value);
  return TableReader(document).string("packing");
}

/// A packing on the command line is relative to the working folder, one in the scenario to the scenario's folder: the
/// former is rewritten to be like the latter.
std::string relative_to_scenario(const std::string& assignment, const std::string& scenario) {
  constexpr std::string_view key = "packing=";
  if (!assignment.starts_with(key)) return assignment;
  const std::filesystem::path path = without_quotes(assignment.substr(key.size()));
  if (path.empty() || path.is_absolute()) return assignment;
  const auto folder = std::filesystem::absolute(scenario).lexically_normal().parent_path();
  return std::string(key) + std::filesystem::absolute(path).lexically_normal().lexically_proximate(folder).string();
}

Scenario load_scenario(const Arguments& arguments) {
  TomlDocument document = TomlDocument::from_file(arguments.scenario);
  for (const std::string& assignment : arguments.assignments)
    document.set(relative_to_scenario(assignment, arguments.scenario));
  return read_scenario(document);
}

void add_threads(CLI::App& command, Arguments& arguments) {
  add_number(command, "--threads", arguments.run.threads, thread_numbers, "",
             "Threads of each process (default: all cores available to it)");
}

void add_common(CLI::App& command, Arguments& arguments, const std::string& quiet) {
  command.add_option("scenario", arguments.scenario, "Scenario file (TOML)")->required()->check(existing_file());
  add_assignments(command, arguments.assignments, "Override a value: KEY=VALUE, e.g. stages.0.wall_speed=2000");
  add_threads(command, arguments);
  command.add_flag("--quiet", arguments.run.quiet, quiet);
}

CLI::App* add_bond(CLI::App& app, BondProgrammeOptions& options) {
  CLI::App* bond = app.add_subcommand(
      "bond",
      "Drive one bonded contact point along a sequence of separations.\n"
      "Example: mpfem bond law.toml programme.csv -o result.csv --set bond.softening=energy\n"
      "  law.toml         stiffness = 3.68e6   # MPa/mm, normal and tangential penalty\n"
      "                   [bond]               # the table of a scenario\n"
      "                   tensile_strength = 25.0\n"
      "                   shear_strength = 18.0\n"
      "                   fracture_energy = 0.5\n"
      "  programme.csv    opening,shear1,shear2,increments\n"
      "                   2e-5,0,0,1000        # separations (mm) to reach in turn, from 0,0,0\n"
      "                   -1e-6,0,0,           # closed: the undamaged penalty; increments as --increments\n"
      "Tractions in the result are positive in tension and along the shear separation; negative normal traction is\n"
      "compression.");
  bond->add_option("law", options.law, "Law (TOML): stiffness and [bond]")->required()->check(existing_file());
  bond->add_option("programme", options.programme,
                   "Separations to reach in turn (CSV): opening,shear1,shear2[,increments], mm")
      ->required()
      ->check(existing_file());
  bond->add_option("-o,--output", options.output, "Table to write (CSV)")->required();
  add_assignments(*bond, options.assignments, "Override a value of the law: KEY=VALUE");
  add_number(*bond, "--increments", options.increments, Range::between(1, 1e7), "",
             "Increments for rows that give no number of their own")
      ->capture_default_str();
  bond->add_flag("--quiet", options.quiet, "No summary");
  return bond;
}

CLI::App* add_bench(CLI::App& app, Arguments& arguments, BenchOptions& options) {
  CLI::App* bench = app.add_subcommand(
      "bench",
      "Measure the cost of each part of a time step on this machine, and compare it with the limits of the machine.\n"
      "Examples:\n"
      "  mpfem bench                                    # 329 dense, bonded grains of 600 tetrahedra each\n"
      "  mpfem bench --tets 1600000 --threads 1 --json\n"
      "  mpfem bench --no-bonds --friction 0.3\n"
      "  mpfem bench compaction.toml --from run.compaction.checkpoint.h5 --set stages.0.relative_density=0.95");
  CLI::Option* scenario =
      bench->add_option("scenario", arguments.scenario, "Scenario to measure instead of the built-in packing (TOML)")
          ->check(existing_file());
  bench->add_option("--from", arguments.from, "Checkpoint whose state is measured")->check(existing_file());
  add_assignments(*bench, arguments.assignments, "Override a value of the scenario: KEY=VALUE");
  add_threads(*bench, arguments);
  add_number(*bench, "--tets", options.tets, Range::between(8, 4e8), "",
             "Approximate number of tetrahedra of the built-in packing")
      ->capture_default_str()
      ->excludes(scenario);
  add_number(*bench, "--grains", options.grains, Range::between(1, 1e7), "",
             "Approximate number of grains of the built-in packing")
      ->capture_default_str()
      ->excludes(scenario);
  add_choice(
      *bench, "--element", options.element,
      {{"tet4", ElementType::tet4}, {"tet4-anp", ElementType::tet4_anp}, {"tet4-patch", ElementType::tet4_patch}},
      "Element of the built-in packing")
      ->excludes(scenario);
  add_choice(*bench, "--precision", options.precision, {{"double", Precision::full}, {"mixed", Precision::mixed}},
             "Precision of its tetrahedra: double, or mixed with strains and stresses in single precision")
      ->excludes(scenario);
  bench->add_flag("!--no-bonds", options.bonds, "Built-in packing without bonds")->excludes(scenario);
  add_number(*bench, "--friction", options.friction, Range::between(0, 2), "",
             "Friction of the built-in packing, between grains and at walls")
      ->capture_default_str()
      ->excludes(scenario);
  add_number(*bench, "--steps", options.steps, Range::between(5, 1e6), "", "Steps to measure")->capture_default_str();
  bench->add_flag("--json", options.json, "Print one JSON object");
  bench->add_flag("--quiet", options.quiet, "No progress");
  return bench;
}

constexpr const char* help_text =
    "mpfem: compacts and tests a meshed packing of deformable grains by explicit finite elements.\n"
    "Examples:\n"
    "  mpfem check compaction.toml\n"
    "  mpfem run compaction.toml -o run.h5\n"
    "  mpfem run compaction.toml -o run.h5 --set stages.0.wall_speed=2000 --threads 2\n"
    "  mpfem run compaction.toml -o run.h5 --resume\n"
    "  mpirun -n 4 mpfem run compaction.toml -o run.h5   # in a build with MPI (docs/cluster.md)\n"
    "  mpfem bond law.toml programme.csv -o result.csv\n"
    "  mpfem bench\n"
    "Exit codes: 0 done, 2 bad usage or input, 3 simulation failed (state saved), 4 storage failed, "
    "5 interrupted (resumable).";

const std::vector<std::pair<std::string, Redistribute>> redistribute_words = {
    {"when-it-pays", Redistribute::when_it_pays}, {"never", Redistribute::never}, {"always", Redistribute::always}};

CLI::App* add_run(CLI::App& app, Arguments& arguments) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario.\n"
                                            "Without --resume, a run file that is already there is kept as RUN.h5~.\n"
                                            "Examples:\n"
                                            "  mpfem run compaction.toml -o run.h5 --resume\n"
                                            "  mpfem run compaction.toml -o rough.h5 --set contact.friction=0.3");
  add_common(*run, arguments, "Warnings only, no progress");
  run->add_option("-o,--output", arguments.run.output, "Run file to write (HDF5)")->required();
  run->add_flag("--resume", arguments.run.resume, "Continue from the run's checkpoint if there is one");
  run->add_option("--from", arguments.from, "Start from the state in this checkpoint")->check(existing_file());
  add_choice(*run, "--redistribute", arguments.run.redistribute, redistribute_words,
             "Whether grains change ranks at checkpoints: by measured work; never; all of them, as a trial");
  add_number(*run, "--time-limit", arguments.run.time_limit, Range::between(1e-9, 1e9), "s",
             "Stop after this wall-clock time of steps; reading the packing comes before. --resume continues");
  return run;
}

CLI::App* add_check(CLI::App& app, Arguments& arguments) {
  CLI::App* check =
      app.add_subcommand("check", "Validate a scenario; print its plan and an estimate of its time on this machine.\n"
                                  "Examples:\n"
                                  "  mpfem check compaction.toml\n"
                                  "  mpfem check unloading.toml --from run.D0.850.checkpoint.h5");
  add_common(*check, arguments,
             "Print warnings only, and try no step; the exit code tells whether the run would start");
  check->add_option("--from", arguments.from, "Check a branch that starts from this checkpoint")
      ->check(existing_file());
  return check;
}

/// What all ranks of a run have to agree on, line by line; each may have its own number of threads.
std::string orders(const Arguments& arguments, const Scenario& scenario) {
  const auto redistribute =
      std::ranges::find(redistribute_words, arguments.run.redistribute, &std::pair<std::string, Redistribute>::second);
  return fmt::format("--output '{}'\n--from '{}'\n--resume {}\n--time-limit {}\n--redistribute {}\n{}",
                     arguments.run.output, arguments.from, arguments.run.resume, arguments.run.time_limit,
                     redistribute->first, scenario.text);
}

void measure_steps(const Arguments& arguments, BenchOptions options, const Communicator& ranks) {
  if (!arguments.scenario.empty()) options.scenario = load_scenario(arguments);
  if (!arguments.from.empty()) options.from = arguments.from;
  if (arguments.scenario.empty() && (!arguments.from.empty() || !arguments.assignments.empty()))
    throw InputError("mpfem bench: found --from or --set without a scenario, allowed: with a scenario only");
  options.threads = arguments.run.threads;
  run_bench(options, ranks);
}

int run_command(int argc, char** argv, const Communicator& ranks) {
  refuse_different_builds(ranks, build_text());
  CLI::App app(help_text);
  app.set_version_flag("--version", "mpfem " + version_and_commit());
  app.require_subcommand(1);
  Arguments arguments;
  arguments.run.threads = share_of_cores(ranks);
  BondProgrammeOptions bond_options;
  BenchOptions bench_options;
  const CLI::App* run = add_run(app, arguments);
  const CLI::App* check = add_check(app, arguments);
  const CLI::App* bond = add_bond(app, bond_options);
  const CLI::App* bench = add_bench(app, arguments, bench_options);

  if (const auto done = parse_command_line(app, "mpfem", argc, argv)) return *done;

  if (bond->parsed()) root_does(ranks, [&] { run_bond_programme(bond_options); });
  if (bench->parsed()) measure_steps(arguments, bench_options, ranks);
  if (!run->parsed() && !check->parsed()) return 0;
  const Scenario scenario = load_scenario(arguments);
  refuse_differences(ranks, orders(arguments, scenario), "one scenario and one command on all ranks");
  if (!arguments.from.empty()) arguments.run.from = arguments.from;
  arguments.run.scenario_file = arguments.scenario;
  if (run->parsed()) run_scenario(scenario, arguments.run, ranks);
  if (check->parsed())
    check_scenario(scenario, {arguments.run.from, arguments.run.threads, arguments.run.quiet}, ranks);
  return 0;
}

int body(int argc, char** argv) {
#ifdef MPFEM_HANDS_OVER
  hand_over_to_best_build(argv);
#endif
  const Communicator ranks = Communicator::of_launcher(argc, argv);
  return on_all_ranks("mpfem", ranks, [&] { return run_command(argc, argv, ranks); });
}

} // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "run") mpfem::catch_interrupts(); // before anything that takes time
#ifdef __GLIBC__
  // Arrays go back to the system when they are freed. By default the C library keeps arrays of up to 32 MB once one of
  // that size has been freed: a tenth of the memory of a coarse packing.
  mallopt(M_MMAP_THRESHOLD, 1 << 18);
#endif
  return mpfem::run_program("mpfem", body, argc, argv);
}
