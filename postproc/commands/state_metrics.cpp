// One number from a snapshot or a whole run: damage, sections, the end of a stress path, a compaction.

#include "common/errors.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/commands/metric_command.hpp"
#include "postproc/drawing/section_statistics.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/metrics/compaction_curve.hpp"
#include "postproc/metrics/damage_statistics.hpp"
#include "postproc/metrics/stress_path.hpp"

namespace mpfem {

namespace {

constexpr Range relative_densities = Range::between(0, 2);

class DamageCommand : public MetricCommand {
public:
  explicit DamageCommand(CLI::App& app)
      : MetricCommand(app, "damage",
                      "Damage of the bonds of a snapshot: its area-weighted mean, shares broken and undamaged, "
                      "percentiles, spread between\n"
                      "contacts.\n"
                      "Example: postproc damage run.h5 --snapshot -1 -o damage.json --data distribution.csv") {
    add_snapshot(options(), snapshot_);
    add_output("--data", data_, "CSV file to write: the share of the area whose damage is not above each value",
               csv_file);
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    const Measurement measurement = measure_damage(run, snapshot_);
    if (!data_.empty()) write_file(data_, csv_text(damage_distribution(read_bonds(run, snapshot_))));
    return measurement;
  }

  int snapshot_ = -1;
  std::string data_;
};

class StressPathCommand : public MetricCommand {
public:
  explicit StressPathCommand(CLI::App& app)
      : MetricCommand(app, "stress-path",
                      "End point of a run in the plane of p and q, largest stresses and dissipation.\n"
                      "Example: postproc stress-path run.h5 -o path.json") {}

private:
  Measurement measure(const schema::FileReader& run) const override { return measure_stress_path(run); }
};

/// A metric of the middle plane of a snapshot.
class SectionMetricCommand : public MetricCommand {
public:
  using Measure = Measurement(const schema::FileReader& run, int snapshot, int axis, double threshold);

  SectionMetricCommand(CLI::App& app, const std::string& name, const std::string& help,
                       const std::string& threshold_help, Measure& measure)
      : MetricCommand(app, name, help), measure_(measure) {
    add_snapshot(options(), snapshot_);
    add_axis(options(), axis_, "Axis that the middle plane is normal to");
    add_number(options(), "--threshold", threshold_, Range::between(0, 1e12), "", threshold_help)->required();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_(run, snapshot_, axis_number(axis_), threshold_);
  }

  Measure& measure_;
  int snapshot_ = -1;
  std::string axis_ = "z";
  double threshold_ = 0;
};

class StressAtDensitiesCommand : public MetricCommand {
public:
  explicit StressAtDensitiesCommand(CLI::App& app)
      : MetricCommand(
            app, "stress-at-densities",
            "Mean stress of a compaction at given relative densities, interpolated between rows.\n"
            "Example: postproc stress-at-densities run.h5 --densities 0.8,0.92 -o stress.json --data stress.csv") {
    add_numbers(options(), "--densities", densities_, 0, relative_densities, "",
                "Relative densities, separated by commas, ascending")
        ->required();
    add_output("--data", data_, "CSV file to write: one row per density, with the contact area", csv_file);
    add_input("--reference", reference_,
              "CSV file with relative_density, mean_stress_MPa: the run is compared with it in --data");
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    if (!reference_.empty() && data_.empty())
      throw InputError("--reference: found no --data, allowed: with --data, where it is compared");
    std::optional<CompactionCurve> reference;
    if (!reference_.empty()) reference = read_compaction_curve(reference_);
    if (!data_.empty()) write_file(data_, stress_at_densities_csv(run, densities_, reference));
    return measure_stress_at_densities(run, densities_);
  }

  std::vector<double> densities_;
  std::string data_, reference_;
};

class CompactionQualityCommand : public MetricCommand {
public:
  explicit CompactionQualityCommand(CLI::App& app)
      : MetricCommand(
            app, "compaction-quality",
            "Quality of a compaction from a relative density on: kinetic over internal energy, energy balance, "
            "penetration.\n"
            "Example: postproc compaction-quality run.h5 --from-density 0.7 -o quality.json") {
    add_number(options(), "--from-density", from_density_, relative_densities, "",
               "Relative density of the first row that counts")
        ->required();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_compaction_quality(run, from_density_);
  }

  double from_density_ = 0;
};

} // namespace

std::unique_ptr<Command> damage_command(CLI::App& app) {
  return std::make_unique<DamageCommand>(app);
}

std::unique_ptr<Command> stress_path_command(CLI::App& app) {
  return std::make_unique<StressPathCommand>(app);
}

std::unique_ptr<Command> section_stress_command(CLI::App& app) {
  return std::make_unique<SectionMetricCommand>(
      app, "section-stress",
      "Von Mises stress on the middle plane: mean, percentiles, share above a threshold.\n"
      "Example: postproc section-stress run.h5 --threshold 25 -o stress.json",
      "Stress above which the area counts, MPa", measure_section_stress);
}

std::unique_ptr<Command> section_damage_command(CLI::App& app) {
  return std::make_unique<SectionMetricCommand>(
      app, "section-damage",
      "Damage along the grains' boundaries on the middle plane: mean, share above a threshold.\n"
      "Example: postproc section-damage run.h5 --axis x --threshold 0.99 -o damage.json",
      "Smallest damage at which a bond counts as opened", measure_section_damage);
}

std::unique_ptr<Command> stress_at_densities_command(CLI::App& app) {
  return std::make_unique<StressAtDensitiesCommand>(app);
}

std::unique_ptr<Command> compaction_quality_command(CLI::App& app) {
  return std::make_unique<CompactionQualityCommand>(app);
}

} // namespace mpfem
