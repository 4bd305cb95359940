#include "postproc/figure/figure_commands.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "postproc/figure/depends.hpp"
#include "postproc/figure/figure_plot.hpp"
#include "postproc/figure/filter_notes.hpp"
#include "postproc/figure/other_studies.hpp"
#include "postproc/figure/powder_text.hpp"
#include "postproc/figure/report.hpp"
#include "postproc/figure/verdict_pages.hpp"
#include "postproc/files/gnuplot.hpp"
#include "postproc/files/notes.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/view/view_page.hpp"

namespace mpfem {

struct FigureCommands::State {
  std::string figure, name, output, results = "out/coarse", mesh = "coarse", programmes = "studies/branches", packing,
                                    description;
  std::string title, run, beside;
  std::vector<std::string> files, settings, known_meshes;
  int packings = 0;
  bool quiet = false;
  const CLI::App* program = nullptr;
  std::function<void(const std::vector<std::string>&)> check_words;

  struct FigureCommand {
    CLI::App* options;
    std::function<void()> execute;
    std::vector<std::string> endings; ///< of what it writes; empty: any. If several, the ending chooses the format
  };
  std::vector<FigureCommand> commands;

  CLI::App& add(CLI::App& app, const char* command_name, const std::string& help, std::function<void()> action,
                const std::vector<std::string>& endings = {}) {
    CLI::App* command = app.add_subcommand(command_name, help);
    command->add_option("-o,--output", output, "File to write (default: standard output)");
    command->add_option("--results", results, "Folder of the mesh's results")->capture_default_str();
    commands.push_back({command, std::move(action), endings});
    return *command;
  }

  CLI::App& add_on_figure(CLI::App& app, const char* command_name, const std::string& help,
                          std::function<void()> action, const std::vector<std::string>& endings = {}) {
    CLI::App& command = add(app, command_name, help, std::move(action), endings);
    command.add_option("figure", figure, "The figure's file (TOML)")->required()->check(existing_file());
    add_common(command);
    return command;
  }

  void add_common(CLI::App& command) {
    command.add_option("--mesh", mesh, "Name of the mesh, which selects the cases")->capture_default_str();
    command.add_option("--programmes", programmes, "Folder of the scenarios named without a path")
        ->capture_default_str();
  }

  void add_depends(CLI::App& app) {
    CLI::App& command = add(app, "depends",
                            "Write the rules by which make produces figures: files, their inputs, settings of runs.\n"
                            "Example: postproc depends studies/fig12/figure.toml --results out/smoke --mesh smoke",
                            [this] { depends(); });
    command.add_option("figures", files, "Figures' files (TOML)")->required()->check(existing_file());
    add_common(command);
    command.add_option("--packing", packing, "The meshed packing")->required();
    separated_by_commas(command.add_option("--meshes", known_meshes,
                                           "All names of meshes; others in the files are refused (default: any)"));
    command.add_option("--description", description, "The file that the packing was made from, for metrics");
    command.add_flag("--quiet", quiet, "No notes on settings that replace those of a scenario");
    add_assignments(command, settings, "Setting of every run, unless it has common_settings = false: KEY=VALUE");
  }

  void add_table(CLI::App& app) {
    CLI::App& command =
        add_on_figure(app, "table",
                      "Make a table of a figure from its runs.\nColumns of curves in addition to those of the "
                      "history:\n" +
                          curve_help() +
                          "Example: postproc table studies/fig12/figure.toml modulus --results out/smoke --mesh smoke "
                          "-o modulus.csv",
                      [this] { table(); }, {".csv"});
    command.add_option("name", name, "Name of the table")->required();
    command
        .add_option(
            "--spread", files,
            "Write mean and deviation over these tables of several packings instead, the table of this packing first")
        ->check(existing_file());
  }

  void add_plot(CLI::App& app) {
    CLI::App& command =
        add_on_figure(app, "plot",
                      "Draw a plot of a figure from its tables and fits; the ending of -o chooses PNG or SVG.\n"
                      "Example: postproc plot studies/fig12/figure.toml modulus --results out/smoke -o "
                      "modulus.png",
                      [this] { plot(); }, {".png", ".svg"});
    command.add_option("name", name, "Name of the plot")->required();
    add_number(command, "--packings", packings, Range::between(0, 1e6), "",
               "Draw the spread over this number of packings");
    command.add_option(
        "--beside", beside,
        "NAME=FOLDER: draw results of the same figure with other settings as well, dashed, and call them "
        "NAME; FOLDER as for --results (default: those that the figure's file names)");
    command.get_option("--output")->required()->description("Picture to write (PNG or SVG)");
  }

  void add_verdicts(CLI::App& app) {
    add(app, "verdicts",
        "Write verdicts as Markdown: one mesh figure by figure, or several meshes side by side.\n"
        "Example: postproc verdicts coarse=studies/results/coarse smoke=studies/results/smoke -o verdicts.md",
        [this] { verdicts(); }, {".md"})
        .add_option("folders", files, "MESH=FOLDER: name of a mesh and the folder with a verdict.json for each figure")
        ->required();
  }

  void add_report(CLI::App& app) {
    CLI::App& command =
        add(app, "report",
            "Write pictures, verdicts and runs of figures as one HTML page; links are relative to its folder.\n"
            "Example: postproc report studies/fig12/figure.toml --results out/smoke --mesh smoke --title Moduli "
            "-o out/smoke/report/index.html",
            [this] { report(); }, {".html"});
    command.add_option("figures", files, "Figures' files (TOML)")->required()->check(existing_file());
    add_common(command);
    command.add_option("--title", title, "Title of the page")->required();
    command.add_option("--beside", beside, "Markdown page whose first table is shown next to the verdicts")
        ->check(existing_file());
    command.add_option("--view", run, "Run shown in three dimensions on the page (HDF5)")->check(existing_file());
  }

  void deliver(const std::string& text) const {
    if (output.empty())
      fmt::print("{}", text);
    else
      write_file(output, text);
  }

  /// Refuses an output that would overwrite one of these.
  void refuse_overwriting_any(const std::vector<std::string>& inputs) const {
    for (const std::string& input : inputs) refuse_overwriting("--output", output, input);
  }

  /// Refuses outputs that cannot be written, that would overwrite what an option names, or that end as another format
  /// does. Where several endings are given, all others are refused (see FigureCommand).
  void check_output(const std::vector<std::string>& endings) const {
    if (output.empty() && endings.size() < 2) return; // standard output
    refuse_overwriting_any({figure, packing, description, run, beside});
    refuse_overwriting_any(files);
    check_output_path("--output", output, OutputKind::text);
    if (endings.size() == 1) refuse_ending_of_other_format("--output", output, endings);
    if (endings.size() > 1) refuse_other_endings("--output", output, endings);
    try_output(output);
  }

  /// Refuses an output that would overwrite the figure's file or what it names: included files and scenarios.
  Figure read(const std::string& file) const {
    Figure f = read_figure(file, programmes);
    refuse_overwriting_any(f.files);
    for (const RunTemplate& r : f.runs) refuse_overwriting_any({r.programme});
    return f;
  }

  std::string folder(const Figure& f) const { return fmt::format("{}/{}", results, f.name); }

  /// Refuses an output that would overwrite a table of the figure.
  void refuse_overwriting_tables(const Figure& f) const {
    for (const TableSpec& spec : f.tables)
      refuse_overwriting_any({path_of_table(spec, folder(f)), fmt::format("{}/{}.spread.csv", folder(f), spec.name)});
  }

  /// Refuses an output that would overwrite a table or the fits of the figure.
  void refuse_overwriting_data(const Figure& f) const {
    refuse_overwriting_tables(f);
    refuse_overwriting_any({folder(f) + "/fits.json"});
  }

  void depends() const {
    std::vector<Figure> figures;
    for (const std::string& file : files) figures.push_back(read(file));
    DependsRequest request{{results, mesh}, packing, description, {}, {}, known_meshes, check_words, programmes};
    if (!quiet) request.note = [](const std::string& text) { print_notes({text}); };
    for (const CLI::App* command : program->get_subcommands({})) request.commands.push_back(command->get_name());
    for (const std::string& setting : settings) {
      const std::size_t equals = setting.find('=');
      if (equals == std::string::npos)
        throw InputError(fmt::format("--set: found '{}', allowed: KEY=VALUE", one_line(setting)));
      request.common_settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
    }
    if (figures.size() == 1) refuse_runs_of_other_studies(figures.front(), request);
    const std::string text = make_rules(figures, request);
    std::ifstream old(output);
    if (std::string(std::istreambuf_iterator<char>(old), {}) == text) return; // unchanged: make need not read it again
    deliver(text);
  }

  void powder() const {
    const Figure f = read(figure);
    refuse_overwriting_any({f.powder_files.begin(), f.powder_files.end()});
    deliver(powder_text(f, folder(f)));
  }

  void table() const {
    const Figure f = read(figure);
    const TableSpec& spec = f.table(name, {});
    if (!files.empty() && spec.spread.empty())
      throw InputError(fmt::format("--spread: found the table '{}', whose 'spread' names no columns, allowed: a table "
                                   "with columns in 'spread'",
                                   one_line(name)));
    const TextTable result = files.empty() ? make_table(f, spec, {results, mesh}) : spread_of(spec, files);
    refuse_overwriting_any(result.sources);
    print_notes(result.notes);
    deliver(csv_text(result));
  }

  void fits() const {
    const Figure f = read(figure);
    refuse_overwriting_tables(f);
    FigureData data(f, folder(f));
    print_notes(notes_on_fits(data));
    const auto list = make_fits(f, folder(f));
    for (const auto& fit : list)
      if (fit.contains("refused"))
        print_notes(
            {fmt::format("fit '{}': {}", fit.at("name").get<std::string>(), fit.at("refused").get<std::string>())});
    deliver(list.dump(2) + "\n");
  }

  /// Those of plot's --beside, otherwise those that the figure's file names.
  std::optional<OtherResults> results_beside(const Figure& f) const {
    if (beside.empty()) {
      const std::string kept = folder_beside(f, {results, mesh});
      if (kept.empty()) return std::nullopt;
      return OtherResults{f.beside.title, FigureData(f, kept)};
    }
    const std::size_t sign = beside.find('=');
    if (sign == std::string::npos || sign == 0)
      throw InputError(fmt::format("--beside: found '{}', allowed: NAME=FOLDER", one_line(beside)));
    const std::string other = beside.substr(sign + 1) + "/" + f.name;
    if (!std::filesystem::is_directory(other))
      throw InputError(fmt::format("--beside: the folder {} does not exist, allowed: results of the figure {}",
                                   one_line(other), f.name));
    return OtherResults{beside.substr(0, sign), FigureData(f, other)};
  }

  void plot() const {
    const Figure f = read(figure);
    const auto found = std::find_if(f.plots.begin(), f.plots.end(), [&](const PlotSpec& p) { return p.name == name; });
    if (found == f.plots.end())
      throw InputError(
          fmt::format("{}: found no plot '{}', allowed: the name of one of [[plots]]", f.path, one_line(name)));
    const std::string format = output.ends_with(".svg") ? "svg" : "png";
    refuse_overwriting_data(f);
    FigureData data(f, folder(f));
    print_notes(notes_on_plot(*found, data));
    std::optional<OtherResults> other = results_beside(f);
    const TemporaryFile picture("");
    run_gnuplot(
        plot_script(*found, data, folder(f), format, picture.path(), packings, other ? &other.value() : nullptr));
    write_file(output, format == "svg" ? with_points_as_in_png(picture.content()) : picture.content());
  }

  void verdict() const {
    const Figure f = read(figure);
    refuse_overwriting_data(f);
    FigureData data(f, folder(f));
    print_notes(notes_on_statements(data, mesh));
    deliver(verdict_text(data, mesh));
  }

  void verdicts() const {
    std::vector<MeshVerdicts> meshes;
    for (const std::string& text : files) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw InputError(fmt::format("folders: found '{}', allowed: MESH=FOLDER", one_line(text)));
      meshes.push_back({text.substr(0, equals), text.substr(equals + 1)});
      refuse_overwriting_any(verdict_files(meshes.back().folder));
    }
    deliver(meshes.size() == 1 ? verdicts_of_mesh(meshes.front()) : verdicts_of_meshes(meshes));
  }

  /// Shows at most six snapshots, so that the page stays small.
  static std::string view_of(const std::string& run) {
    return view_page_of_run({run, schema::FileKind::run}, 6, "Compaction in three dimensions");
  }

  void report() const {
    std::vector<ReportEntry> entries;
    for (const std::string& file : files) {
      const Figure f = read(file);
      const std::string question = f.source.empty() ? f.question : fmt::format("{} Source: {}.", f.question, f.source);
      entries.push_back({f.name, f.name == f.title ? f.title : fmt::format("{}: {}", f.name, f.title), question, file,
                         runs_of_figure(f, {results, mesh}), captions_of_figure(f, {results, mesh})});
      refuse_overwriting_any(files_on_page(entries.back(), folder(f)));
      for (const ReportRun& r : entries.back().runs) refuse_overwriting_any({r.file});
    }
    const std::string page_folder = std::filesystem::path(output).parent_path().string();
    ReportRequest request{results, title, {}, beside, page_folder};
    if (!run.empty()) request.view = [this] { return view_of(run); };
    deliver(report_page(entries, request));
  }
};

FigureCommands::FigureCommands(CLI::App& app, std::function<void(const std::vector<std::string>&)> check_words)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.check_words = std::move(check_words);
  s.program = &app;
  s.add_depends(app);
  s.add_on_figure(
      app, "powder",
      "Print the packing of a study as input for pack-gen, with names of files as seen from its results; nothing "
      "if the study has none.",
      [&s] { s.powder(); });
  s.add_table(app);
  s.add_on_figure(app, "fits", "Make all fits of a figure from its tables, as JSON.", [&s] { s.fits(); }, {".json"});
  s.add_plot(app);
  s.add_on_figure(app, "verdict", "Compare the statements of a figure with the results, as JSON.",
                  [&s] { s.verdict(); }, {".json"});
  s.add_verdicts(app);
  s.add_report(app);
}

FigureCommands::~FigureCommands() = default;

void FigureCommands::run() const {
  for (const auto& command : state_->commands) {
    if (!command.options->parsed()) continue;
    state_->check_output(command.endings);
    command.execute();
  }
}

} // namespace mpfem
