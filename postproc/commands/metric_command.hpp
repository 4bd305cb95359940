#pragma once
// What the subcommands share that read one number off a run.

#include <optional>
#include <string>

#include "postproc/commands/command.hpp"
#include "postproc/measurement.hpp"

namespace mpfem {

/// A derived class adds its options and says what it measures; one that also writes a table does so in measure().
class MetricCommand : public RunCommand {
protected:
  MetricCommand(CLI::App& app, const std::string& name, const std::string& help,
                const std::string& output_help = "JSON file to write")
      : RunCommand(app, name, help, output_help) {}

  virtual Measurement measure(const schema::FileReader& run) const = 0;

  void execute() const override;
  /// JSON to -o, and unless --quiet is given a line for the reader.
  void deliver_measurement(Measurement measurement, const schema::FileReader& run) const;
};

/// Of one stage: with --stage.
class StageMetricCommand : public MetricCommand {
protected:
  StageMetricCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& default_stage,
                     const std::string& output_help = "JSON file to write");
  std::optional<int> stage() const { return stage_; }

private:
  std::optional<int> stage_;
};

} // namespace mpfem
