// summary, curve and vtk: the content of a run in other forms.

#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/drawing/vtk.hpp"
#include "postproc/files/notes.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/metrics/summary.hpp"

namespace mpfem {

namespace {

class SummaryCommand : public RunCommand {
public:
  explicit SummaryCommand(CLI::App& app)
      : RunCommand(app, "summary", "Summarise a run.\nExample: postproc summary run.h5 -o summary.json",
                   "JSON file to write, or CSV of its numbers (.csv)", csv_or_json_file) {}

private:
  void execute() const override {
    const Summary result = summarise(open_run());
    if (!output().empty())
      write_file(output(), output().ends_with(".csv") ? to_csv(result) : to_json(result).dump(2) + "\n");
    if (!quiet()) fmt::print("{}", to_text(result));
  }
};

class CurveCommand : public RunCommand {
public:
  explicit CurveCommand(CLI::App& app)
      : RunCommand(
            app, "curve",
            "Write history columns as CSV.\nExample: postproc curve run.h5 --columns relative_density,mean_stress -o "
            "curve.csv",
            "CSV file to write (default: standard output)", csv_file) {
    separated_by_commas(options().add_option("--columns", columns_,
                                             "Columns, separated by commas (default: all); wall_stress means its six"));
  }

private:
  void execute() const override {
    const schema::FileReader file = open_run();
    const HistoryTable history(file, NotFinite::kept);
    if (!history.not_finite().empty()) print_notes({history.not_finite()});
    deliver(columns_.empty() ? csv_text(history.columns()) : csv_text(history.select(columns_)));
  }

  std::vector<std::string> columns_;
};

class VtkCommand : public StateCommand {
public:
  explicit VtkCommand(CLI::App& app)
      : StateCommand(app, "vtk",
                     "Write snapshots for ParaView.\nExample: postproc vtk run.h5 -o vtk\nExample: postproc vtk "
                     "--packing packing.h5 -o packing.vtu",
                     "Folder to write, or with --packing a .vtu file", vtu_file) {
    output_option()->required();
  }

private:
  /// The snapshots of a run are written to a folder, which is made where it does not exist.
  void check_outputs() const override {
    if (of_packing()) {
      StateCommand::check_outputs();
      return;
    }
    std::error_code ignored;
    if (std::filesystem::exists(output(), ignored) && !std::filesystem::is_directory(output(), ignored))
      throw InputError(fmt::format("--output {}: found a file, allowed: a folder", one_line(output())));
  }

  void execute() const override {
    if (of_packing()) {
      write_file(output(), vtu_text(read_state(-1)));
      return;
    }
    if (path_of_run().empty()) throw InputError("found neither of RUN.h5 and --packing, allowed: exactly one");
    write_run_as_vtk({path_of_run(), schema::FileKind::run}, output(), quiet());
  }
};

} // namespace

std::unique_ptr<Command> summary_command(CLI::App& app) {
  return std::make_unique<SummaryCommand>(app);
}

std::unique_ptr<Command> curve_command(CLI::App& app) {
  return std::make_unique<CurveCommand>(app);
}

std::unique_ptr<Command> vtk_command(CLI::App& app) {
  return std::make_unique<VtkCommand>(app);
}

} // namespace mpfem
