#include "postproc/commands/metric_command.hpp"

#include <fmt/format.h>

#include "postproc/files/notes.hpp"

namespace mpfem {

void MetricCommand::execute() const {
  const schema::FileReader run = open_run();
  deliver_measurement(measure(run), run);
}

void MetricCommand::deliver_measurement(Measurement measurement, const schema::FileReader& run) const {
  note_unfinished(measurement, run);
  if (!output().empty()) write_file(output(), to_json(measurement).dump(2) + "\n");
  if (quiet()) return;
  fmt::print("{}", to_text(measurement));
  print_notes(measurement.notes);
}

StageMetricCommand::StageMetricCommand(CLI::App& app, const std::string& name, const std::string& help,
                                       const std::string& default_stage, const std::string& output_help,
                                       const OutputFormat& format)
    : MetricCommand(app, name, help, output_help, format) {
  add_number(options(), "--stage", stage_, whole_numbers, "",
             "Stage as in the scenario, from 0; negative from the end (default: " + default_stage + ")");
}

} // namespace mpfem
