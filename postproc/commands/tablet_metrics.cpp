// Measurements of tablets: pressing and ejection, yield pressure, strength of a disc.

#include <fmt/format.h>

#include "postproc/commands/commands.hpp"
#include "postproc/commands/metric_command.hpp"
#include "postproc/metrics/diametral.hpp"
#include "postproc/metrics/heckel.hpp"
#include "postproc/metrics/tablet.hpp"

namespace mpfem {

namespace {

class TabletCommand : public MetricCommand {
public:
  explicit TabletCommand(CLI::App& app)
      : MetricCommand(app, "tablet",
                      "Tablet: forces at the peak, die wall, ejection, thickness, diameter and recovery.\n"
                      "Example: postproc tablet run.h5 -o tablet.json\n"
                      "Example: postproc tablet run.h5 --press compaction --eject push-out --snapshot -1") {
    options().add_option("--press", rule_.stages.press, "Name of the stage that presses")->capture_default_str();
    options().add_option("--hold", rule_.stages.hold, "Name of the stage that holds (default: hold, if there is one)");
    options().add_option("--unload", rule_.stages.unload,
                         "Name of the stage in which the upper punch leaves (default: unload)");
    options().add_option("--eject", rule_.stages.eject, "Name of the stage that ejects (default: eject)");
    options().add_option("--upper", rule_.tools.upper, "Name of the upper punch")->capture_default_str();
    options().add_option("--lower", rule_.tools.lower, "Name of the lower punch")->capture_default_str();
    options().add_option("--die", rule_.tools.die, "Name of the die")->capture_default_str();
    add_snapshot(options(), rule_.snapshot);
    add_number(
        options(), "--face-distance", rule_.face_distance, positive_length, "mm",
        "Nodes within this distance of punches and die count as the tablet's faces and band (default: a twentieth "
        "of the mean grain's diameter)");
  }

private:
  void execute() const override {
    const schema::FileReader run = open_run();
    if (given("--snapshot")) snapshot_name(run, rule_.snapshot); // refuses a wrong number, also without an ejection
    const TabletMeasurement tablet = measure_tablet(run, rule_);
    deliver_measurement(tablet.measurement, run);
    if (!quiet()) fmt::print("{}", to_table(tablet.numbers));
  }

  Measurement measure(const schema::FileReader& run) const override { return measure_tablet(run, rule_).measurement; }

  TabletRule rule_;
};

class HeckelCommand : public StageMetricCommand {
public:
  explicit HeckelCommand(CLI::App& app)
      : StageMetricCommand(
            app, "heckel",
            "Mean yield pressure by Heckel, in-die: ln 1/(1 - D) = P/P_y + A over the longest straight window.\n"
            "Example: postproc heckel run.h5 --bulk-modulus 8000 -o heckel.json\n"
            "For densities measured out of the die, in a table with pressures: postproc fit --model heckel",
            "the stage named press, else the first") {
    add_number(options(), "--r-squared", rule_.r_squared, Range::between(0, 1), "", "Smallest R^2 of the window")
        ->capture_default_str();
    add_number(options(), "--bulk-modulus", bulk_modulus_, positive_modulus, "MPa",
               "Bulk modulus K of the solid; P_y is then also given without elastic compression, from D / (1 + P/K)");
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    const HistoryTable history(run);
    const auto stages = stages_of(history, scenario_facts(run));
    const StageRows pressed = stage() ? stage_by_number(stages, *stage(), path_of_run())
                                      : stage_by_name(stages, "press").value_or(stages.front());
    return measure_heckel(run, pressed, history, rule_, bulk_modulus_);
  }

  HeckelRule rule_;
  std::optional<double> bulk_modulus_; ///< MPa
};

class DiametralCommand : public StageMetricCommand {
public:
  explicit DiametralCommand(CLI::App& app)
      : StageMetricCommand(app, "diametral",
                           "Tensile strength of a disc between two plates (Brazilian test): 2 F / (pi D t), and the "
                           "same corrected for flats.\n"
                           "Example: postproc diametral run.h5 --plates left,right -o strength.json --data crack.csv\n"
                           "Example: postproc diametral run.h5 --diameter 2 --thickness 1 --flat-angle 10",
                           "the last") {
    separated_by_commas(options().add_option(
        "--plates", rule_.plates, "Names of both plates, separated by a comma (default: the run's only two tools)"));
    add_number(options(), "--drop", rule_.drop, Range::between(1e-6, 1), "",
               "Relative fall after the largest force that makes it a peak")
        ->capture_default_str();
    add_number(options(), "--smallest-peak", rule_.smallest_peak, Range::between(0, 1e12), "N",
               "Smaller peaks of the force do not count: while the disc settles, a plate may bounce off")
        ->capture_default_str();
    add_number(options(), "--crack-in-centre", rule_.crack_in_centre, Range::between(0, 1), "",
               "A fall of the force counts only with a crack through the centre, where this share of the bonds, by "
               "area, is broken (0: every fall counts)")
        ->capture_default_str();
    options()
        .add_option("--disc-axis", disc_axis_, "Axis of the disc, along its thickness")
        ->check(one_of({"x", "y", "z"}))
        ->capture_default_str();
    add_number(options(), "--diameter", rule_.diameter, positive_length, "mm",
               "Diameter of the disc (default: extent of the grains along the load before the test)");
    add_number(options(), "--thickness", rule_.thickness, positive_length, "mm",
               "Thickness of the disc (default: median of its local thickness before the test)");
    add_number(options(), "--flat-angle", rule_.flat_angle, Range::between(0, largest_flat_angle), "degrees",
               "Angle 2 alpha that a flat spans at the axis (default: from the snapshot nearest to the peak)");
    add_number(options(), "--face-distance", rule_.face_distance, positive_length, "mm",
               "Pressed nodes within this distance of the outermost one count as a flat (default: a hundredth of the "
               "diameter)");
    add_output("--data", data_, "CSV file to write: where bonds have broken up to each snapshot of the stage",
               csv_file);
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    if (rule_.flat_angle)
      refuse_given({"--face-distance"}, "together with --flat-angle, which it would measure", "one of them");
    DiametralRule rule = rule_;
    rule.stage = stage();
    rule.disc_axis = axis_number(disc_axis_);
    const HistoryTable history(run);
    if (!data_.empty()) write_file(data_, disc_crack_csv(run, history, rule));
    return measure_diametral(run, history, rule);
  }

  DiametralRule rule_;
  std::string disc_axis_ = "z", data_;
};

} // namespace

std::unique_ptr<Command> tablet_command(CLI::App& app) {
  return std::make_unique<TabletCommand>(app);
}

std::unique_ptr<Command> heckel_command(CLI::App& app) {
  return std::make_unique<HeckelCommand>(app);
}

std::unique_ptr<Command> diametral_command(CLI::App& app) {
  return std::make_unique<DiametralCommand>(app);
}

} // namespace mpfem
