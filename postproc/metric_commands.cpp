#include "postproc/metric_commands.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/compaction_curve.hpp"
#include "postproc/contact_history.hpp"
#include "postproc/csv_file.hpp"
#include "postproc/damage_statistics.hpp"
#include "postproc/elastic_recovery.hpp"
#include "postproc/energy.hpp"
#include "postproc/energy_release.hpp"
#include "postproc/fit.hpp"
#include "postproc/hysteresis.hpp"
#include "postproc/mean_radius.hpp"
#include "postproc/modulus.hpp"
#include "postproc/quasi_static.hpp"
#include "postproc/section_statistics.hpp"
#include "postproc/strength.hpp"
#include "postproc/stress_path.hpp"
#include "postproc/text_file.hpp"
#include "postproc/triaxial_test.hpp"
#include "postproc/yield_point.hpp"

namespace mpfem {

namespace {

constexpr Range share = Range::between(0, 1);
constexpr Range strains = Range::between(1e-12, 1e3);

} // namespace

struct MetricCommands::State {
  std::string input, output, table, packing; ///< files
  bool quiet = false;
  std::optional<int> stage;
  int snapshot = -1;
  std::optional<double> youngs_modulus, mean_radius;
  ModulusRule modulus;
  std::vector<double> strain_range;
  StrengthRule strength;
  bool need_window = false;
  double yield_ratio = 1.003, lateral_stress = 0, threshold = 0, from_density = 0;
  std::vector<double> relative_densities;
  std::string axis = "z";
  std::string x, y, z, curve;
  std::vector<std::string> models;
  bool x_is_relative_density = false;
  std::vector<std::pair<CLI::App*, std::function<void()>>> commands;

  schema::FileReader open_run() const { return {input, schema::FileKind::run}; }

  CLI::App& add(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
                std::function<void()> action) {
    CLI::App* command = app.add_subcommand(name, help);
    command->add_option("-o,--output", output, output_help);
    command->add_flag("--quiet", quiet, "Nothing but the result");
    commands.emplace_back(command, std::move(action));
    return *command;
  }

  /// A command on one stage of a run.
  CLI::App& add_metric(CLI::App& app, const std::string& name, const std::string& help,
                       const std::string& default_stage, std::function<void()> action,
                       const std::string& output_help = "JSON file to write") {
    CLI::App& command = add(app, name, help, output_help, std::move(action));
    command.add_option("run", input, "Run file (HDF5)")->required();
    add_number(command, "--stage", stage, whole_numbers, "",
               "Stage as in the scenario, from 0; negative from the end (default: " + default_stage + ")");
    return command;
  }

  void deliver(Measurement m) const {
    note_unfinished(m, open_run());
    if (!output.empty()) write_file(output, to_json(m).dump(2) + "\n");
    if (quiet) return;
    fmt::print("{}", to_text(m));
    for (const std::string& note : m.notes) fmt::print(stderr, "postproc: note: {}\n", note);
  }

  void run_energy() const;
  void run_fit() const;
};

void MetricCommands::State::run_energy() const {
  const schema::FileReader file = open_run();
  if (!output.ends_with(".json")) {
    const std::string ledger = csv_text(energy_ledger(HistoryTable(file)));
    if (output.empty())
      fmt::print("{}", ledger);
    else
      write_file(output, ledger);
    return;
  }
  EnergyScale scale{youngs_modulus, mean_radius};
  if (!scale.youngs_modulus) scale.youngs_modulus = scenario_facts(file).youngs_modulus;
  if (!scale.mean_radius)
    scale.mean_radius = packing.empty() ? mean_radius_of_run(file) : mean_radius_of_packing(packing);
  deliver(measure_energy(file, stage, scale));
}

void MetricCommands::State::run_fit() const {
  const auto columns = read_csv(input);
  FitPoints points;
  points.path = input;
  points.x = csv_column(columns, x, input).values;
  points.y = csv_column(columns, y, input).values;
  if (!z.empty()) points.z = csv_column(columns, z, input).values;
  std::vector<Fit> fits;
  for (const std::string& model : models) fits.push_back(fit(model, points, x_is_relative_density));

  const auto range = [](const std::vector<double>& values) { return range_of(values, 0, values.size() - 1); };
  const auto with_unit = [&](const std::string& name) {
    return nlohmann::ordered_json{{"column", name}, {"unit", csv_column(columns, name, input).unit}};
  };
  if (!curve.empty()) {
    if (!z.empty()) throw InputError("--curve: found a surface, allowed: a model of x alone");
    constexpr int intervals = 200;
    std::vector<Column> table_of_curve = {csv_column(columns, x, input)};
    table_of_curve[0].values.clear();
    const auto [low, high] = range(points.x);
    for (int i = 0; i <= intervals; ++i) table_of_curve[0].values.push_back(low + (high - low) * i / intervals);
    for (const Fit& f : fits) {
      table_of_curve.push_back({f.model, csv_column(columns, y, input).unit, {}});
      for (const double at : table_of_curve[0].values) table_of_curve.back().values.push_back(f.at(at, 0));
    }
    write_file(curve, csv_text(table_of_curve));
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Fit& f : fits) {
    nlohmann::ordered_json one = to_json(f);
    one["x"] = with_unit(x);
    one["x"]["range"] = range(points.x);
    one["x"]["porosity_is_1_minus_x"] = x_is_relative_density;
    one["y"] = with_unit(y);
    one["y"]["range"] = range(points.y);
    if (!z.empty()) {
      one["z"] = with_unit(z);
      one["z"]["range"] = range(points.z);
    }
    json.push_back(one);
  }
  if (!output.empty()) write_file(output, json.dump(2) + "\n");
  if (quiet) return;
  for (const Fit& f : fits) {
    std::string text;
    for (const Coefficient& c : f.coefficients)
      text += fmt::format("{} = {:.5g} [{:.4g}, {:.4g}], ", c.name, c.value, c.low, c.high);
    fmt::print("{}: {}; {}R^2 = {:.4f} of {}, {} points\n", f.model, f.formula, text, f.r_squared, f.fitted_in,
               f.points);
    for (const std::string& note : f.notes) fmt::print(stderr, "postproc: note: {}: {}\n", f.model, note);
  }
}

MetricCommands::MetricCommands(CLI::App& app) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.add_metric(app, "elastic-recovery",
               "How far a compact springs back: (D_max - D_min) / D_max (paper, Eq. 9).\n"
               "Example: postproc elastic-recovery run.h5 -o recovery.json",
               "the last isotropic_unloading, else the first after the densest row that unloads",
               [&s] { s.deliver(measure_elastic_recovery(s.open_run(), s.stage)); });

  CLI::App& modulus = s.add_metric(
      app, "modulus",
      "Young's modulus of a compact: slope of axial stress at the beginning of an axial reloading.\n"
      "Example: postproc modulus run.h5 --stage -1 -o modulus.json\n"
      "Example: postproc modulus run.h5 --strain-range 0,0.002",
      "the last unconfined_compression, else the last", [&s] {
        if (!s.strain_range.empty()) {
          if (!(s.strain_range[1] > s.strain_range[0]))
            throw InputError(fmt::format("--strain-range: found {:g},{:g}, allowed: low,high with low < high",
                                         s.strain_range[0], s.strain_range[1]));
          s.modulus.strain_range = {s.strain_range[0], s.strain_range[1]};
        }
        const Measurement m = measure_modulus(s.open_run(), s.stage, s.modulus, s.youngs_modulus);
        if (s.need_window && !m.details["window_meets_rule"].get<bool>())
          throw InputError(fmt::format("{}: {}", one_line(s.input), m.notes.front()));
        s.deliver(m);
      });
  add_number(modulus, "--slope-change", s.modulus.slope_change, share, "",
             "Largest change of slope between the window's halves, share")
      ->capture_default_str();
  add_number(modulus, "--damage-share", s.modulus.damage_share, share, "",
             "Largest damage dissipation over axial work in the window")
      ->capture_default_str();
  add_number(modulus, "--stress-fraction", s.modulus.stress_fraction, share, "",
             "The window ends at this share of the rise to the peak")
      ->capture_default_str();
  add_number(modulus, "--strain-range", s.strain_range, Range::between(-1e3, 1e3), "",
             "low,high: axial strain since the stage began, in place of the rule")
      ->delimiter(',')
      ->expected(2);
  modulus.add_flag("--need-window", s.need_window, "Refuse a stage in which no window meets the rule");
  add_number(modulus, "--youngs-modulus", s.youngs_modulus, moduli, "MPa", "Of the grains (default: the scenario's)");

  CLI::App& strength = s.add_metric(
      app, "strength",
      "Strength: unconfined, the peak of the axial stress; triaxial, the peak of q, else q at an axial strain.\n"
      "Example: postproc strength run.h5 -o strength.json\n"
      "Example: postproc strength run.h5 --test triaxial --at-strain 0.1",
      "the last unconfined_compression or triaxial_compression, else the last",
      [&s] { s.deliver(measure_strength(s.open_run(), s.stage, s.strength)); });
  static const std::map<std::string, StrengthTest> tests = {{"unconfined", StrengthTest::unconfined},
                                                            {"triaxial", StrengthTest::triaxial}};
  static const std::map<std::string, StrengthCriterion> criteria = {{"peak", StrengthCriterion::peak},
                                                                    {"damage-onset", StrengthCriterion::damage_onset}};
  strength
      .add_option_function<std::string>(
          "--test", [&s](const std::string& name) { s.strength.test = tests.at(name); },
          "unconfined or triaxial (default: as the stage is)")
      ->check(CLI::IsMember({"unconfined", "triaxial"}));
  strength
      .add_option_function<std::string>(
          "--criterion", [&s](const std::string& name) { s.strength.criterion = criteria.at(name); },
          "peak, or damage-onset: the stress where damage begins to grow (default: peak)")
      ->check(CLI::IsMember({"peak", "damage-onset"}));
  add_number(strength, "--drop", s.strength.drop, share, "",
             "Fall after the largest stress that makes it a peak, share")
      ->capture_default_str();
  add_number(strength, "--at-strain", s.strength.at_strain, strains, "",
             "Axial strain since the stage began, where q has no peak by then")
      ->capture_default_str();

  CLI::App& yield = s.add_metric(
      app, "yield",
      "Yield point of a probe: where plastic and damage dissipation reach 1.003 times their value at its beginning.\n"
      "Example: postproc yield probe.h5 -o yield.json",
      "the last probe, else the last", [&s] { s.deliver(measure_yield(s.open_run(), s.stage, s.yield_ratio)); });
  add_number(yield, "--ratio", s.yield_ratio, Range::between(1.0 + 1e-9, 100.0), "",
             "Of the dissipation at yield to that at the stage's beginning")
      ->capture_default_str();

  CLI::App& hysteresis =
      s.add_metric(app, "hysteresis",
                   "Isotropic load cycles: loop area, drift of the density and dissipation of each.\n"
                   "Example: postproc hysteresis run.h5 -o hysteresis.json --cycles cycles.csv",
                   "the last stress_cycles, else the whole run", [&s] {
                     const HysteresisMeasurement result = measure_hysteresis(s.open_run(), s.stage);
                     if (!s.table.empty()) write_file(s.table, csv_text(result.cycles));
                     s.deliver(result.measurement);
                   });
  hysteresis.add_option("--cycles", s.table, "CSV file to write, a row a cycle");

  CLI::App& damage = s.add(app, "damage",
                           "Damage of the bonds of a snapshot: its area-weighted mean, shares broken and undamaged, "
                           "percentiles, spread between\n"
                           "contacts.\n"
                           "Example: postproc damage run.h5 --snapshot -1 -o damage.json --data distribution.csv",
                           "JSON file to write", [&s] {
                             const schema::FileReader file = s.open_run();
                             const Measurement measurement = measure_damage(file, s.snapshot);
                             if (!s.table.empty())
                               write_file(s.table, csv_text(damage_distribution(read_bonds(file, s.snapshot))));
                             s.deliver(measurement);
                           });
  damage.add_option("run", s.input, "Run file (HDF5)")->required();
  add_number(damage, "--snapshot", s.snapshot, whole_numbers, "", "Number of the snapshot; -1 is the last")
      ->capture_default_str();
  damage.add_option("--data", s.table, "CSV file to write: the share of the area whose damage is not above each value");

  s.add_metric(
      app, "quasi-static",
      "How quasi-static a loading was: kinetic over internal energy, balance of opposite walls and of energy.\n"
      "Example: postproc quasi-static run.h5 -o quality.json",
      "the last", [&s] { s.deliver(measure_quasi_static(s.open_run(), s.stage)); });
  s.add(app, "stress-path",
        "Where a run ends in the plane of p and q, its largest stresses and what it dissipates.\n"
        "Example: postproc stress-path run.h5 -o path.json",
        "JSON file to write", [&s] { s.deliver(measure_stress_path(s.open_run())); })
      .add_option("run", s.input, "Run file (HDF5)")
      ->required();
  CLI::App& triaxial = s.add_metric(
      app, "triaxial",
      "A triaxial compression: stresses and strains at its end and where q is largest, dissipation, and how well "
      "the lateral force was kept.\n"
      "Example: postproc triaxial run.h5 --lateral-stress 8 -o triaxial.json",
      "the last triaxial_compression",
      [&s] { s.deliver(measure_triaxial_test(s.open_run(), s.stage, s.lateral_stress)); });
  add_number(triaxial, "--lateral-stress", s.lateral_stress, moduli, "MPa", "At the beginning")->required();
  const auto add_section = [&](const char* name, const char* help, const char* threshold_help,
                               Measurement (*measure)(const schema::FileReader&, int, int, double)) {
    CLI::App& section = s.add(app, name, help, "JSON file to write", [&s, measure] {
      s.deliver(measure(s.open_run(), s.snapshot, s.axis == "x" ? 0 : s.axis == "y" ? 1 : 2, s.threshold));
    });
    section.add_option("run", s.input, "Run file (HDF5)")->required();
    add_number(section, "--snapshot", s.snapshot, whole_numbers, "", "Number of the snapshot; -1 is the last")
        ->capture_default_str();
    section.add_option("--axis", s.axis, "Axis that the middle plane is normal to")
        ->check(CLI::IsMember({"x", "y", "z"}))
        ->capture_default_str();
    add_number(section, "--threshold", s.threshold, Range::between(0, 1e12), "", threshold_help)->required();
  };
  add_section("section-stress",
              "Von Mises stress on the middle plane: mean, percentiles, share above a threshold.\n"
              "Example: postproc section-stress run.h5 --threshold 25 -o stress.json",
              "MPa", measure_section_stress);
  add_section("section-damage",
              "Damage along the grains' boundaries on the middle plane: mean, share above a threshold.\n"
              "Example: postproc section-damage run.h5 --axis x --threshold 0.99 -o damage.json",
              "Damage from which on a bond counts as opened", measure_section_damage);

  CLI::App& at_densities =
      s.add(app, "stress-at-densities",
            "Mean stress where a compaction passes given relative densities, between the rows beside each.\n"
            "Example: postproc stress-at-densities run.h5 --densities 0.8,0.92 -o stress.json --data stress.csv",
            "JSON file to write", [&s] {
              if (!s.table.empty()) write_file(s.table, stress_at_densities_csv(s.open_run(), s.relative_densities));
              s.deliver(measure_stress_at_densities(s.open_run(), s.relative_densities));
            });
  at_densities.add_option("run", s.input, "Run file (HDF5)")->required();
  add_number(at_densities, "--densities", s.relative_densities, Range::between(0, 2), "",
             "Relative densities, by comma, ascending")
      ->required()
      ->delimiter(',');
  at_densities.add_option("--data", s.table, "CSV file to write: a row a density");
  CLI::App& compaction_quality =
      s.add(app, "compaction-quality",
            "How sound a compaction is from a relative density on: kinetic over internal energy, balance of energy, "
            "penetration.\n"
            "Example: postproc compaction-quality run.h5 --from-density 0.7 -o quality.json",
            "JSON file to write", [&s] { s.deliver(measure_compaction_quality(s.open_run(), s.from_density)); });
  compaction_quality.add_option("run", s.input, "Run file (HDF5)")->required();
  add_number(compaction_quality, "--from-density", s.from_density, Range::between(0, 2), "",
             "Relative density of the first row that counts")
      ->required();

  CLI::App& energy = s.add_metric(
      app, "energy",
      "Energies: the ledger over time as CSV, or with -o FILE.json what an unloading releases and dissipates, also "
      "over\n"
      "E R^3 of the grains.\n"
      "Example: postproc energy run.h5 -o energy.csv\n"
      "Example: postproc energy run.h5 --packing packing.h5 -o energy.json",
      "as for elastic-recovery", [&s] { s.run_energy(); },
      "File to write, .json, or CSV with any other ending (default: CSV on standard output)");
  add_number(energy, "--youngs-modulus", s.youngs_modulus, moduli, "MPa", "Of the grains (default: the scenario's)");
  add_number(energy, "--mean-radius", s.mean_radius, lengths, "mm",
             "Of the grains (default: from --packing, else from a snapshot)");
  energy.add_option("--packing", s.packing, "Packing file (HDF5) to take the mean radius from");

  CLI::App& fit = s.add(
      app, "fit",
      "Fits models to points of a CSV file: coefficients with their 95 % intervals and R^2.\nModels:\n" + fit_help() +
          "Example: postproc fit strength.csv --x porosity --y strength --model "
          "ryshkewitch-duckworth,rumpf -o fits.json\n"
          "Example: postproc fit q.csv --x p_c --z G_c --y q --model pc-gc-surface",
      "JSON file to write, a list of fits", [&s] { s.run_fit(); });
  fit.add_option("points", s.input, "CSV file with a heading, \"name [unit],…\"")->required();
  fit.add_option("--x", s.x, "Column, without its unit")->required();
  fit.add_option("--y", s.y, "Column")->required();
  fit.add_option("--z", s.z, "Column: G^c of pc-gc-surface");
  fit.add_option("--model", s.models, "Models, by comma")->required()->delimiter(',');
  fit.add_flag("--relative-density", s.x_is_relative_density, "x holds relative densities: the porosity P is 1 - x");
  fit.add_option("--curve", s.curve, "CSV file to write: the fitted curves at 201 values of x");
}

MetricCommands::~MetricCommands() = default;

void MetricCommands::run() const {
  for (const auto& [command, action] : state_->commands) {
    if (!command->parsed()) continue;
    for (const std::string& out : {state_->output, state_->table, state_->curve})
      for (const std::string& in : {state_->input, state_->packing}) refuse_overwriting(out, in);
    for (const auto& [option, out] : {std::pair<const char*, const std::string&>{"--output", state_->output},
                                      {command->get_name() == "hysteresis" ? "--cycles" : "--data", state_->table},
                                      {"--curve", state_->curve}})
      if (!out.empty()) check_output_path(option, out, OutputKind::text);
    action();
  }
}

} // namespace mpfem
