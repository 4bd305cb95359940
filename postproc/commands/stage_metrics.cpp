// One number from a stage of a run: elastic recovery, modulus, strength, yield, cycles, quality of loading, energies.

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/commands/metric_command.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/metrics/elastic_recovery.hpp"
#include "postproc/metrics/energy.hpp"
#include "postproc/metrics/energy_release.hpp"
#include "postproc/metrics/hysteresis.hpp"
#include "postproc/metrics/modulus.hpp"
#include "postproc/metrics/quasi_static.hpp"
#include "postproc/metrics/strength.hpp"
#include "postproc/metrics/triaxial_test.hpp"
#include "postproc/metrics/yield_point.hpp"
#include "postproc/run_data/mean_radius.hpp"

namespace mpfem {

namespace {

constexpr Range share = Range::between(0, 1);
constexpr Range strains = Range::between(1e-12, 1e3);

class ElasticRecoveryCommand : public StageMetricCommand {
public:
  explicit ElasticRecoveryCommand(CLI::App& app)
      : StageMetricCommand(app, "elastic-recovery",
                           "Elastic recovery of a compact: (D_max - D_min) / D_max (paper, Eq. 9).\n"
                           "Example: postproc elastic-recovery run.h5 -o recovery.json",
                           "the last isotropic_unloading, else the first after the densest row that unloads") {}

private:
  Measurement measure(const schema::FileReader& run) const override { return measure_elastic_recovery(run, stage()); }
};

class ModulusCommand : public StageMetricCommand {
public:
  explicit ModulusCommand(CLI::App& app)
      : StageMetricCommand(
            app, "modulus",
            "Young's modulus of a compact: slope of the axial stress at the start of an axial reloading.\n"
            "Example: postproc modulus run.h5 --stage -1 -o modulus.json\n"
            "Example: postproc modulus run.h5 --strain-range 0,0.002",
            "the last unconfined_compression, else the last") {
    add_share("--slope-change", rule_.slope_change,
              "Largest relative change of slope between the halves of the window");
    add_share("--damage-share", rule_.damage_share, "Largest ratio of damage dissipation to axial work in the window");
    add_share("--stress-fraction", rule_.stress_fraction, "The window ends at this share of the rise to the peak");
    add_numbers(options(), "--strain-range", strain_range_, 2, Range::between(-1e3, 1e3), "",
                "low,high: axial strain since the stage began, instead of the rule");
    options().add_flag("--need-window", need_window_, "Fail if no window meets the rule");
    add_number(options(), "--youngs-modulus", youngs_modulus_, positive_modulus, "MPa",
               "Young's modulus of the grains (default: the scenario's)");
  }

private:
  void add_share(const std::string& name, double& variable, const std::string& help) {
    add_number(options(), name, variable, share, "", help)->capture_default_str();
  }

  void execute() const override {
    if (!strain_range_.empty() && !(strain_range_[1] > strain_range_[0]))
      throw InputError(fmt::format("--strain-range: found {:g},{:g}, allowed: low,high with low < high",
                                   strain_range_[0], strain_range_[1]));
    if (!strain_range_.empty())
      refuse_given({"--slope-change", "--damage-share", "--stress-fraction", "--need-window"},
                   "together with --strain-range, which replaces the rule", "one of them");
    StageMetricCommand::execute();
  }

  Measurement measure(const schema::FileReader& run) const override {
    ModulusRule rule = rule_;
    if (!strain_range_.empty()) rule.strain_range = {strain_range_[0], strain_range_[1]};
    const Measurement m = measure_modulus(run, stage(), rule, youngs_modulus_);
    if (need_window_ && !m.details["window_meets_rule"].get<bool>())
      throw InputError(fmt::format("{}: {}", one_line(path_of_run()), m.notes.front()));
    return m;
  }

  ModulusRule rule_;
  std::vector<double> strain_range_;
  bool need_window_ = false;
  std::optional<double> youngs_modulus_; ///< MPa
};

class StrengthCommand : public StageMetricCommand {
public:
  explicit StrengthCommand(CLI::App& app)
      : StageMetricCommand(
            app, "strength",
            "Strength: unconfined, the peak of the axial stress; triaxial, the peak of q, else q at an axial strain.\n"
            "Example: postproc strength run.h5 -o strength.json\n"
            "Example: postproc strength run.h5 --test triaxial --at-strain 0.1",
            "the last unconfined_compression or triaxial_compression, else the last") {
    add_choice(options(), "--test", rule_.test,
               {{"unconfined", StrengthTest::unconfined}, {"triaxial", StrengthTest::triaxial}},
               "unconfined or triaxial (default: as the stage is)");
    add_choice(options(), "--criterion", rule_.criterion,
               {{"peak", StrengthCriterion::peak}, {"damage-onset", StrengthCriterion::damage_onset}},
               "peak, or damage-onset: the stress where damage begins to grow (default: peak)");
    add_number(options(), "--drop", rule_.drop, share, "",
               "Relative fall after the largest stress that makes it a peak")
        ->capture_default_str();
    add_number(options(), "--at-strain", rule_.at_strain, strains, "",
               "Axial strain since the stage began at which q is read if it has no peak before")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    if (rule_.criterion == StrengthCriterion::damage_onset)
      refuse_given({"--drop", "--at-strain"}, "together with --criterion damage-onset", "with --criterion peak");
    const Measurement m = measure_strength(run, stage(), rule_);
    if (m.details["test"] == "unconfined")
      refuse_given({"--at-strain"}, fmt::format("for stage {}, an unconfined test", m.window.stage),
                   "for a triaxial test");
    return m;
  }

  StrengthRule rule_;
};

class YieldCommand : public StageMetricCommand {
public:
  explicit YieldCommand(CLI::App& app)
      : StageMetricCommand(app, "yield",
                           "Yield point of a probe: where plastic and damage dissipation reach 1.003 times their value "
                           "at its beginning.\n"
                           "Example: postproc yield probe.h5 -o yield.json",
                           "the last probe, else the last") {
    add_number(options(), "--ratio", ratio_, Range::between(1.0 + 1e-9, 100.0), "",
               "Ratio of the dissipation at yield to that at the beginning of the stage")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run) const override { return measure_yield(run, stage(), ratio_); }

  double ratio_ = 1.003;
};

class HysteresisCommand : public StageMetricCommand {
public:
  explicit HysteresisCommand(CLI::App& app)
      : StageMetricCommand(app, "hysteresis",
                           "Isotropic load cycles: loop area, drift of the density and dissipation of each.\n"
                           "Example: postproc hysteresis run.h5 -o hysteresis.json --cycles cycles.csv",
                           "the last stress_cycles, else the whole run") {
    add_output("--cycles", cycles_, "CSV file to write, one row per cycle", csv_file);
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    const HysteresisMeasurement result = measure_hysteresis(run, stage());
    if (!cycles_.empty()) write_file(cycles_, csv_text(result.cycles));
    return result.measurement;
  }

  std::string cycles_;
};

class QuasiStaticCommand : public StageMetricCommand {
public:
  explicit QuasiStaticCommand(CLI::App& app)
      : StageMetricCommand(
            app, "quasi-static",
            "Check how quasi-static a loading was: kinetic over internal energy, opposite walls, energy balance.\n"
            "Example: postproc quasi-static run.h5 -o quality.json",
            "the last") {}

private:
  Measurement measure(const schema::FileReader& run) const override { return measure_quasi_static(run, stage()); }
};

class TriaxialCommand : public StageMetricCommand {
public:
  explicit TriaxialCommand(CLI::App& app)
      : StageMetricCommand(
            app, "triaxial",
            "A triaxial compression: stresses and strains at its end and where q is largest, dissipation, and how well "
            "the lateral force was kept.\n"
            "Example: postproc triaxial run.h5 --lateral-stress 8 -o triaxial.json",
            "the last triaxial_compression") {
    add_number(options(), "--lateral-stress", lateral_stress_, positive_modulus, "MPa",
               "Lateral stress at the beginning of the stage")
        ->required();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_triaxial_test(run, stage(), lateral_stress_);
  }

  double lateral_stress_ = 0; ///< MPa
};

class EnergyCommand : public StageMetricCommand {
public:
  explicit EnergyCommand(CLI::App& app)
      : StageMetricCommand(app, "energy",
                           "Energies: the energy balance over time as CSV, or with -o FILE.json what an unloading "
                           "releases and dissipates,\n"
                           "also divided by E R^3 of the grains.\n"
                           "Example: postproc energy run.h5 -o energy.csv\n"
                           "Example: postproc energy run.h5 --packing packing.h5 -o energy.json",
                           "as for elastic-recovery",
                           "File to write, .json, or CSV with any other ending (default: CSV on standard output)",
                           csv_or_json_file) {
    add_number(options(), "--youngs-modulus", scale_.youngs_modulus, positive_modulus, "MPa",
               "Young's modulus of the grains (default: the scenario's)");
    add_number(options(), "--mean-radius", scale_.mean_radius, positive_length, "mm",
               "Mean radius of the grains (default: from --packing, else from a snapshot)");
    add_input("--packing", packing_, "Packing file (HDF5) of the run, to take the mean radius from");
  }

private:
  void execute() const override {
    if (output().ends_with(".json")) return StageMetricCommand::execute();
    refuse_given({"--stage", "--youngs-modulus", "--mean-radius", "--packing"},
                 "with CSV, which has the energies of all rows", "with -o FILE.json");
    deliver(csv_text(energy_ledger(HistoryTable(open_run()))));
  }

  Measurement measure(const schema::FileReader& run) const override {
    if (scale_.mean_radius && !packing_.empty())
      throw InputError("--mean-radius: found together with --packing, allowed: one of them");
    EnergyScale scale = scale_;
    if (!scale.youngs_modulus) scale.youngs_modulus = scenario_facts(run).youngs_modulus;
    if (!scale.mean_radius)
      scale.mean_radius = packing_.empty() ? mean_radius_of_run(run) : mean_radius_of_packing(packing_, run);
    return measure_energy(run, stage(), scale);
  }

  EnergyScale scale_; ///< as far as given
  std::string packing_;
};

} // namespace

std::unique_ptr<Command> elastic_recovery_command(CLI::App& app) {
  return std::make_unique<ElasticRecoveryCommand>(app);
}

std::unique_ptr<Command> modulus_command(CLI::App& app) {
  return std::make_unique<ModulusCommand>(app);
}

std::unique_ptr<Command> strength_command(CLI::App& app) {
  return std::make_unique<StrengthCommand>(app);
}

std::unique_ptr<Command> yield_command(CLI::App& app) {
  return std::make_unique<YieldCommand>(app);
}

std::unique_ptr<Command> hysteresis_command(CLI::App& app) {
  return std::make_unique<HysteresisCommand>(app);
}

std::unique_ptr<Command> quasi_static_command(CLI::App& app) {
  return std::make_unique<QuasiStaticCommand>(app);
}

std::unique_ptr<Command> triaxial_command(CLI::App& app) {
  return std::make_unique<TriaxialCommand>(app);
}

std::unique_ptr<Command> energy_command(CLI::App& app) {
  return std::make_unique<EnergyCommand>(app);
}

} // namespace mpfem
