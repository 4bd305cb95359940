// One number that the paper does not have: loops and offsets of stress and strain, coordination, stress and damage of a
// snapshot.

#include <chrono>

#include <fmt/format.h>

#include "common/progress.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/commands/metric_command.hpp"
#include "postproc/metrics/coordination.hpp"
#include "postproc/metrics/damage_band.hpp"
#include "postproc/metrics/damage_of_test.hpp"
#include "postproc/metrics/inner_stress.hpp"
#include "postproc/metrics/offset_yield.hpp"
#include "postproc/metrics/unload_reload.hpp"

namespace mpfem {

namespace {

class UnloadReloadModulusCommand : public StageMetricCommand {
public:
  explicit UnloadReloadModulusCommand(CLI::App& app)
      : StageMetricCommand(app, "unload-reload-modulus",
                           "Young's modulus of a compact from a loop of unloading and reloading: the mean slope of its "
                           "two branches.\n"
                           "Example: postproc unload-reload-modulus run.h5 -o modulus.json",
                           "the last unconfined_compression; adjacent stages of its type belong to the curve") {
    add_number(options(), "--loop", loop_, whole_numbers, "", "Number of the loop, from 0; -1 is the last")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_unload_reload_modulus(run, stage(), loop_);
  }

  int loop_ = -1;
};

class OffsetYieldCommand : public StageMetricCommand {
public:
  explicit OffsetYieldCommand(CLI::App& app)
      : StageMetricCommand(
            app, "offset-yield",
            "Yield by plastic strain: where a loading curve lies a given strain away from its elastic line.\n"
            "Example: postproc offset-yield run.h5 --offset 0.002 -o yield.json",
            "the last probe, unconfined or triaxial compression, else the last") {
    add_number(options(), "--offset", rule_.offset, Range::between(1e-9, 1), "", "Plastic strain at yield")
        ->capture_default_str();
    add_number(options(), "--slope", rule_.slope, Range::between(1e-9, 1e12), "MPa",
               "Elastic slope (default: measured by the rule of modulus)");
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_offset_yield(run, stage(), rule_);
  }

  OffsetYieldRule rule_;
};

class CoordinationCommand : public MetricCommand {
public:
  explicit CoordinationCommand(CLI::App& app)
      : MetricCommand(app, "coordination",
                      "Coordination numbers of a snapshot: with and without rattlers, with and without walls.\n"
                      "Example: postproc coordination run.h5 --snapshot -1 -o coordination.json") {
    add_snapshot(options(), snapshot_);
    add_number(options(), "--fewest-contacts", fewest_contacts_, whole_numbers, "",
               "Grains without bonds and with fewer contacts than this, walls included, are rattlers")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_coordination(run, snapshot_, fewest_contacts_);
  }

  int snapshot_ = -1, fewest_contacts_ = 4;
};

class InnerStressCommand : public MetricCommand {
public:
  explicit InnerStressCommand(CLI::App& app)
      : MetricCommand(app, "inner-stress",
                      "Mean stress in the inner part of the box, from the forces between grains (Love and Weber), and "
                      "at the walls.\n"
                      "Example: postproc inner-stress run.h5 --share 0.5 -o inner.json") {
    add_snapshot(options(), snapshot_);
    add_number(options(), "--share", share_, Range::between(1e-3, 1), "",
               "Length of the inner part, as a fraction of the box's")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run) const override {
    return measure_inner_stress(run, snapshot_, share_);
  }

  int snapshot_ = -1;
  double share_ = 0.5;
};

/// A metric of what a test did to bonds, between a snapshot before it and one of the run.
class BondsOfTestCommand : public MetricCommand {
protected:
  BondsOfTestCommand(CLI::App& app, const char* name, const char* description) : MetricCommand(app, name, description) {
    add_snapshot(options(), snapshot_);
    add_input("--before", before_,
              "Run file with the state in which the test began (default: the run's own snapshot 0)");
    add_number(options(), "--snapshot-before", snapshot_before_, whole_numbers, "",
               "Number of the snapshot of that state (default: 0 for the run itself, -1 with --before)");
  }

  virtual Measurement measure(const schema::FileReader& run, int snapshot, const schema::FileReader& before,
                              int snapshot_before) const = 0;

private:
  Measurement measure(const schema::FileReader& run) const final {
    const bool of_itself = before_.empty();
    return measure(run, snapshot_, {of_itself ? path_of_run() : before_, schema::FileKind::run},
                   snapshot_before_.value_or(of_itself ? 0 : -1));
  }

  int snapshot_ = -1;
  std::string before_;
  std::optional<int> snapshot_before_;
};

class DamageOfTestCommand : public BondsOfTestCommand {
public:
  explicit DamageOfTestCommand(CLI::App& app)
      : BondsOfTestCommand(app, "damage-of-test",
                           "Damage that a test did to existing bonds, apart from bonds formed during the test.\n"
                           "Example: postproc damage-of-test test.h5 --before compact.h5 -o damage.json\n"
                           "Example: postproc damage-of-test run.h5 --snapshot-before 1") {}

private:
  Measurement measure(const schema::FileReader& run, int snapshot, const schema::FileReader& before,
                      int snapshot_before) const override {
    return measure_damage_of_test(run, snapshot, before, snapshot_before);
  }
};

class DamageBandCommand : public BondsOfTestCommand {
public:
  explicit DamageBandCommand(CLI::App& app)
      : BondsOfTestCommand(app, "damage-band",
                           "Whether the bonds that a test opens lie in an inclined band: how much more often they open "
                           "there, and how often chance gives as much.\n"
                           "Example: postproc damage-band test.h5 --threshold 0.5 -o band.json\n"
                           "Example: postproc damage-band test.h5 --threshold 0.998 --before compact.h5") {
    add_number(options(), "--threshold", rule_.threshold, Range::between(1e-9, 1), "",
               "Smallest damage at which a bond counts as opened")
        ->capture_default_str();
    add_axis(options(), axis_, "Axis of compression; bands are inclined to it");
    add_number(options(), "--trials", rule_.trials, Range::between(1, 1e5), "",
               "How often the opened shares are dealt out anew among the pairs of grains")
        ->capture_default_str();
  }

private:
  Measurement measure(const schema::FileReader& run, int snapshot, const schema::FileReader& before,
                      int snapshot_before) const override {
    BandRule rule = rule_;
    rule.axis = axis_number(axis_);
    Progress progress("postproc", quiet());
    const auto begin = std::chrono::steady_clock::now();
    bool shown = false; // nothing is written of a quick measurement
    const auto done = [&](double fraction) {
      shown = shown || std::chrono::steady_clock::now() - begin > std::chrono::seconds(1);
      if (shown) progress.update(fraction, "trials of what chance gives");
    };
    Measurement result = measure_damage_band(run, snapshot, before, snapshot_before, rule, done);
    if (shown) progress.finish(fmt::format("{} trials", rule.trials));
    return result;
  }

  BandRule rule_;
  std::string axis_ = "z";
};

} // namespace

std::unique_ptr<Command> unload_reload_modulus_command(CLI::App& app) {
  return std::make_unique<UnloadReloadModulusCommand>(app);
}

std::unique_ptr<Command> offset_yield_command(CLI::App& app) {
  return std::make_unique<OffsetYieldCommand>(app);
}

std::unique_ptr<Command> coordination_command(CLI::App& app) {
  return std::make_unique<CoordinationCommand>(app);
}

std::unique_ptr<Command> inner_stress_command(CLI::App& app) {
  return std::make_unique<InnerStressCommand>(app);
}

std::unique_ptr<Command> damage_of_test_command(CLI::App& app) {
  return std::make_unique<DamageOfTestCommand>(app);
}

std::unique_ptr<Command> damage_band_command(CLI::App& app) {
  return std::make_unique<DamageBandCommand>(app);
}

} // namespace mpfem
