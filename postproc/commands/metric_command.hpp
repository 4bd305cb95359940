#pragma once
// Shared parts of the subcommands that read one number from a run.

#include <optional>
#include <string>

#include "postproc/commands/command.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// A derived class adds its options and measures in measure(); one that also writes a table does so there too.
class MetricCommand : public RunCommand {
protected:
  MetricCommand(CLI::App& app, const std::string& name, const std::string& help,
                const std::string& output_help = "JSON file to write", const OutputFormat& format = json_file)
      : RunCommand(app, name, help, output_help, format) {}

  virtual Measurement measure(const schema::FileReader& run) const = 0;

  void execute() const override;
  /// Writes JSON to -o and, without --quiet, a line to standard output.
  void deliver_measurement(Measurement measurement, const schema::FileReader& run) const;
};

/// A metric of one stage; adds --stage.
class StageMetricCommand : public MetricCommand {
protected:
  StageMetricCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& default_stage,
                     const std::string& output_help = "JSON file to write", const OutputFormat& format = json_file);
  std::optional<int> stage() const { return stage_; }

private:
  std::optional<int> stage_;
};

} // namespace mpfem
