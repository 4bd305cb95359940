// postproc: numbers, tables and pictures from run files.

#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/version.hpp"
#include "postproc/contact.hpp"
#include "postproc/contact_history.hpp"
#include "postproc/contact_picture.hpp"
#include "postproc/damage_section.hpp"
#include "postproc/figure/figure_commands.hpp"
#include "postproc/metric_commands.hpp"
#include "postproc/section_picture.hpp"
#include "postproc/summary.hpp"
#include "postproc/text_file.hpp"
#include "postproc/validate.hpp"
#include "postproc/vtk.hpp"

namespace {

using namespace mpfem;

struct Arguments {
  std::string input, output, packing, data, contact_picture;
  std::vector<std::string> files, columns;
  int snapshot = -1;
  std::string axis = "z";
  double position = 0.5;
  bool relative = false, quiet = false, history = false;
  std::optional<int> stage;
  bool field_given = false;
  std::vector<double> range, view;
  std::vector<int> pair;
  PictureRequest picture;
};

schema::FileReader open_run(const Arguments& arguments) {
  return {arguments.input, schema::FileKind::run};
}

/// Of `vtk`, which makes the folder where there is none.
void check_output_folder(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("--output {}: found a file, allowed: a folder", one_line(path)));
}

/// To the file that -o names, or to standard output.
void deliver(const Arguments& arguments, const std::string& text) {
  if (arguments.output.empty())
    fmt::print("{}", text);
  else
    write_file(arguments.output, text);
}

void summary(const Arguments& arguments) {
  const Summary result = summarise(open_run(arguments));
  if (!arguments.output.empty())
    write_file(arguments.output, arguments.output.ends_with(".csv") ? to_csv(result) : to_json(result).dump(2) + "\n");
  if (!arguments.quiet) fmt::print("{}", to_text(result));
}

void curve(const Arguments& arguments) {
  const schema::FileReader file = open_run(arguments);
  const HistoryTable history(file);
  std::vector<const Column*> columns;
  if (arguments.columns.empty())
    for (const Column& column : history.columns()) columns.push_back(&column);
  else
    columns = history.select(arguments.columns);
  deliver(arguments, csv_text(columns));
}

void contact_of_pair(const Arguments& arguments) {
  if (arguments.output.ends_with(".csv"))
    throw InputError("-o with --pair: found a .csv file, allowed: .json; --data writes the points as CSV");
  const schema::FileReader file = open_run(arguments);
  const ContactMap map = contact_map(file, arguments.snapshot, {arguments.pair[0], arguments.pair[1]});
  const std::string points = contact_points_csv(map);
  if (!arguments.contact_picture.empty()) // first, since it alone can still be refused
    write_contact_picture(arguments.contact_picture, read_snapshot(file, arguments.snapshot), map,
                          {arguments.picture.title, arguments.picture.pixels, arguments.picture.mesh_lines});
  if (!arguments.data.empty()) write_file(arguments.data, points);
  deliver(arguments, to_json(map).dump(2) + "\n");
}

void contact_through_run(const Arguments& arguments) {
  if (!arguments.pair.empty()) throw InputError("found both of --pair and --history, allowed: one of them");
  const schema::FileReader file = open_run(arguments);
  Measurement end = measure_contact(file, arguments.stage); // also refuses a stage that is not there
  note_unfinished(end, file);
  const bool as_json = arguments.output.ends_with(".json");
  deliver(arguments, as_json ? to_json(end).dump(2) + "\n" : csv_text(contact_history(HistoryTable(file))));
  if (arguments.quiet) return;
  fmt::print(arguments.output.empty() ? stderr : stdout, "{}", to_text(end));
  for (const std::string& note : end.notes) fmt::print(stderr, "postproc: note: {}\n", note);
}

void contact(const Arguments& arguments) {
  if (arguments.history) {
    contact_through_run(arguments);
    return;
  }
  if (arguments.stage) throw InputError("--stage: found without --history, allowed: with it");
  if (!arguments.pair.empty()) {
    contact_of_pair(arguments);
    return;
  }
  if (!arguments.data.empty() || !arguments.contact_picture.empty())
    throw InputError("--data and --view belong to one contact: found no --pair, allowed: --pair FIRST,SECOND");
  const ContactTable table = contact_table(open_run(arguments), arguments.snapshot);
  deliver(arguments, arguments.output.ends_with(".json") ? to_json(table).dump(1) + "\n" : csv_text(table.columns));
  if (!arguments.quiet)
    fmt::print(stderr,
               "D_r {:.4f}, p {:.4g} MPa: {} pairs, coordination number {:.2f}, contact area over surface {:.4f}\n",
               table.relative_density, table.mean_stress, table.columns.front().values.size(),
               table.coordination_number, table.contact_area_ratio);
}

Snapshot read_state(const Arguments& arguments) {
  if (arguments.packing.empty() == arguments.input.empty())
    throw InputError("found " + std::string(arguments.input.empty() ? "neither" : "both") +
                     " of RUN.h5 and --packing, allowed: one of them");
  return arguments.packing.empty() ? read_snapshot(open_run(arguments), arguments.snapshot)
                                   : read_packing_snapshot(arguments.packing);
}

void vtk(const Arguments& arguments) {
  if (!arguments.packing.empty()) {
    const Snapshot state = read_state(arguments);
    write_file(arguments.output, vtu_text(state));
    return;
  }
  if (arguments.input.empty())
    throw InputError("found neither of RUN.h5 and --packing, allowed: one of them; postproc --help says more");
  write_run_as_vtk(open_run(arguments), arguments.output, arguments.quiet);
}

void section(Arguments arguments) {
  if (arguments.output.empty() && arguments.data.empty())
    throw InputError("found neither of -o and --data, allowed: one of them, or both; postproc --help says more");
  const Snapshot state = read_state(arguments);
  PictureRequest& request = arguments.picture;
  request.plane.axis = arguments.axis == "x" ? 0 : arguments.axis == "y" ? 1 : 2;
  const auto axis = static_cast<std::size_t>(request.plane.axis);
  request.plane.position = arguments.relative
                               ? state.box_low[axis] + arguments.position * (state.box_high[axis] - state.box_low[axis])
                               : arguments.position;
  if (!arguments.range.empty()) {
    if (!(arguments.range[1] > arguments.range[0] && std::isfinite(arguments.range[1] - arguments.range[0])))
      throw InputError(fmt::format("--range: found {},{}; allowed: low,high with low < high", arguments.range[0],
                                   arguments.range[1]));
    request.range = {arguments.range[0], arguments.range[1]};
  }
  if (!arguments.view.empty()) {
    const auto& v = arguments.view;
    if (!(v[1] > v[0] && v[3] > v[2] && std::isfinite(v[1] - v[0]) && std::isfinite(v[3] - v[2])))
      throw InputError(fmt::format("--view: found {}; allowed: low,high,low,high with low < high", fmt::join(v, ",")));
    request.view = View{{v[0], v[2]}, {v[1], v[3]}};
  }
  if (!arguments.packing.empty() && !arguments.field_given) request.field = "grain";
  if (!arguments.data.empty())
    write_file(arguments.data, request.field == "damage"
                                   ? damage_section_csv(cut_boundaries(state, request.plane))
                                   : section_csv(state, cut(state, request.plane), request.field));
  if (!arguments.output.empty()) write_section_picture(arguments.output, state, request);
}

void cost(const Arguments& arguments) {
  std::vector<Summary> runs;
  for (const std::string& path : arguments.files) runs.push_back(summarise({path, schema::FileKind::run}));
  deliver(arguments, cost_of_runs(runs));
}

void validate_files(const Arguments& arguments) {
  std::size_t bad = 0;
  for (const std::string& path : arguments.files) {
    const Verdict verdict = verdict_on(path);
    if (!verdict.valid || !arguments.quiet) fmt::print("{}", verdict.text);
    bad += !verdict.valid;
  }
  if (bad > 0) throw InputError(fmt::format("{} of {} files do not hold to the schema", bad, arguments.files.size()));
}

int body(int argc, char** argv) {
  CLI::App app(
      "postproc: numbers, tables and pictures from the runs of mpfem.\n"
      "Examples:\n"
      "  postproc summary run.h5 -o summary.json\n"
      "  postproc curve run.h5 --columns relative_density,mean_stress -o curve.csv\n"
      "  postproc section run.h5 --snapshot -1 --axis z --position 0.5 --relative --field von_mises -o section.png\n"
      "  postproc section run.h5 --field damage -o damage.png\n"
      "  postproc contact run.h5 --pair 3,17 --view contact.png\n"
      "  postproc elastic-recovery run.h5 -o recovery.json   (and modulus, strength, yield, hysteresis, energy)\n"
      "  postproc damage run.h5 --snapshot -1 -o damage.json\n"
      "  postproc fit points.csv --x relative_density --y strength --model exponential -o fits.json\n"
      "  postproc vtk run.h5 -o vtk        (open vtk/run.pvd in ParaView)\n"
      "  postproc validate run.h5\n"
      "  postproc table, fits, plot, verdict, report: of a figure or study declared in one file (docs/figure-file.md)\n"
      "Exit codes: 0 done, 2 bad usage or input, 3 a picture could not be drawn, 4 storage failed.");
  app.set_version_flag("--version", version_and_commit());
  app.require_subcommand(1);

  Arguments arguments;
  const auto add = [&](const char* name, const char* help, bool output_required, const char* output_help) {
    CLI::App* command = app.add_subcommand(name, help);
    CLI::Option* output = command->add_option("-o,--output", arguments.output, output_help);
    if (output_required) output->required();
    command->add_flag("--quiet", arguments.quiet, "Nothing but the result");
    return command;
  };
  const auto add_run = [&](CLI::App& command, bool required) {
    CLI::Option* option = command.add_option("run", arguments.input, "Run file (HDF5)");
    if (required) option->required();
  };
  const auto add_snapshot = [&](CLI::App& command) {
    add_number(command, "--snapshot", arguments.snapshot, whole_numbers, "", "Number of the snapshot; -1 is the last")
        ->capture_default_str();
  };
  const auto add_drawing = [&](CLI::App& command, const std::string& when, const std::string& title,
                               const std::string& patches) {
    command.add_flag("--mesh", arguments.picture.mesh_lines, when + "Draw the edges of " + patches);
    command.add_option("--title", arguments.picture.title, when + "Title (default: " + title + ")");
    add_number(command, "--pixels", arguments.picture.pixels, Range::between(50, 4000), "",
               when + "Pixels along the longer side")
        ->capture_default_str();
  };
  const auto add_packing = [&](CLI::App& command) {
    command.add_option("--packing", arguments.packing, "A meshed packing in place of a run (HDF5)");
  };

  CLI::App* summary_command = add("summary", "What a run came to.\nExample: postproc summary run.h5 -o summary.json",
                                  false, "JSON file to write, or CSV of its numbers (.csv)");
  add_run(*summary_command, true);
  CLI::App* curve_command =
      add("curve",
          "History columns as CSV.\nExample: postproc curve run.h5 --columns relative_density,mean_stress -o curve.csv",
          false, "CSV file to write (default: standard output)");
  add_run(*curve_command, true);
  curve_command
      ->add_option("--columns", arguments.columns, "Columns, by comma (default: all); wall_stress stands for its six")
      ->delimiter(',');
  CLI::App* contact_command = add(
      "contact",
      "Contacts between grains at a snapshot: force and area of every pair, with bonds also their area, damage and\n"
      "energies. With --pair one contact in detail: its force, areas, damage and bonds.\n"
      "Example: postproc contact run.h5 --snapshot -1 -o contacts.csv\n"
      "Example: postproc contact run.h5 --pair 3,17 -o contact.json --data bonds.csv --view damage.png\n"
      "Example: postproc contact run.h5 --history -o contacts.csv",
      false, "File to write, .json or .csv (default: CSV on standard output); with --pair JSON");
  add_run(*contact_command, true);
  add_snapshot(*contact_command);
  add_number(*contact_command, "--pair", arguments.pair, whole_numbers, "",
             "Two grains, by comma: their contact in detail")
      ->delimiter(',')
      ->expected(2);
  contact_command->add_flag(
      "--history", arguments.history,
      "All contacts together through the run: areas, coordination, damage, a row a history row; with "
      "-o FILE.json at the end of a stage");
  add_number(*contact_command, "--stage", arguments.stage, whole_numbers, "",
             "With --history: stage as in the scenario, from 0; negative from the end (default: the last)");
  contact_command->add_option("--data", arguments.data, "With --pair: CSV file to write, a row a bond");
  contact_command->add_option("--view", arguments.contact_picture,
                              "With --pair: PNG file to write, damage in the contact's plane");
  add_drawing(*contact_command, "With --view: ", "the grains and the relative density", "the nodes' patches");
  CLI::App* vtk_command = add("vtk",
                              "Snapshots for ParaView.\nExample: postproc vtk run.h5 -o vtk\nExample: postproc vtk "
                              "--packing packing.h5 -o packing.vtu",
                              true, "Folder to write, or with --packing a .vtu file");
  add_run(*vtk_command, false);
  add_packing(*vtk_command);
  CLI::App* section_command =
      add("section",
          "A plane cut through the grains, as a picture.\n"
          "Example: postproc section run.h5 --axis z --position 0.5 --relative --field von_mises -o section.png\n"
          "Example: postproc section run.h5 --axis x --field damage -o damage.png --data boundaries.csv",
          false, "PNG file to write");
  add_run(*section_command, false);
  add_packing(*section_command);
  add_snapshot(*section_command);
  section_command->add_option("--axis", arguments.axis, "Axis that the plane is normal to")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->capture_default_str();
  add_number(*section_command, "--position", arguments.position, coordinates, "",
             "Where on the axis, mm, or with --relative as a fraction of the box")
      ->capture_default_str();
  section_command->add_flag("--relative", arguments.relative, "Take --position as a fraction of the box (0 … 1)");
  section_command
      ->add_option("--field", arguments.picture.field,
                   "von_mises, pressure, plastic_strain, grain (for --packing: grain) or, for runs with bonds, damage: "
                   "along the cut boundaries")
      ->capture_default_str();
  add_number(*section_command, "--range", arguments.range, Range::between(-1e12, 1e12), "",
             "low,high of the colour scale (default: from the data; of damage 0,1)")
      ->delimiter(',')
      ->expected(2);
  add_number(*section_command, "--view", arguments.view, coordinates, "mm",
             "Part of the plane to show: low,high of its first and of its second coordinate (default: the box)")
      ->delimiter(',')
      ->expected(4);
  add_drawing(*section_command, "", "the relative density", "the elements");
  section_command->add_option(
      "--data", arguments.data,
      "Also write the section's polygons as CSV; of damage the cut boundaries, a row a segment");
  const MetricCommands metrics(app);
  const FigureCommands figures(app);
  CLI::App* validate_command =
      app.add_subcommand("validate", "Hold files to the results schema.\nExample: postproc validate run.h5 packing.h5");
  validate_command->add_option("files", arguments.files, "Files of any kind (HDF5)")->required();
  validate_command->add_flag("--quiet", arguments.quiet, "Nothing but findings");

  CLI::App* cost_command = app.add_subcommand(
      "cost", "What runs took together: runs,tet_steps,wall_time_s,core_time_s.\nExample: postproc cost a.h5 b.h5");
  cost_command->add_option("files", arguments.files, "Run files (HDF5); none: zeros");

  if (const auto done = parse_command_line(app, "postproc", argc, argv)) return *done;
  if (section_command->parsed() && !arguments.relative && section_command->count("--position") == 0)
    arguments.relative = true;
  arguments.field_given = section_command->count("--field") > 0;
  for (const std::string& input : {arguments.input, arguments.packing})
    for (const std::string& output : {arguments.output, arguments.data, arguments.contact_picture})
      refuse_overwriting(output, input);
  const bool folder = vtk_command->parsed() && arguments.packing.empty();
  if (folder)
    check_output_folder(arguments.output);
  else if (!arguments.output.empty())
    check_output_path("--output", arguments.output, section_command->parsed() ? OutputKind::binary : OutputKind::text);
  if (!arguments.data.empty()) check_output_path("--data", arguments.data, OutputKind::text);
  if (!arguments.contact_picture.empty()) check_output_path("--view", arguments.contact_picture, OutputKind::binary);
  if (summary_command->parsed()) summary(arguments);
  if (curve_command->parsed()) curve(arguments);
  if (contact_command->parsed()) contact(arguments);
  if (vtk_command->parsed()) vtk(arguments);
  if (section_command->parsed()) section(arguments);
  metrics.run();
  figures.run();
  if (cost_command->parsed()) cost(arguments);
  if (validate_command->parsed()) validate_files(arguments);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("postproc", body, argc, argv);
}
