#pragma once
// Shared parts of postproc's subcommands: options, input and output files, and where results are written.

#include <memory>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/subcommand.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

/// What an output holds, and the endings that name it.
struct OutputFormat {
  OutputKind kind = OutputKind::text;
  std::vector<std::string> endings;
};
inline const OutputFormat json_file{OutputKind::text, {".json"}}, csv_file{OutputKind::text, {".csv"}},
    csv_or_json_file{OutputKind::text, {".csv", ".json"}}, csv_or_png_file{OutputKind::text, {".csv", ".png"}},
    html_file{OutputKind::text, {".html"}}, vtu_file{OutputKind::text, {".vtu"}},
    png_file{OutputKind::binary, {".png"}};

/// A subcommand of postproc. One class for each.
class Command : public Subcommand {
protected:
  Command(CLI::App& app, const std::string& name, const std::string& help) : Subcommand(app, name, help) {}

  /// An option that names a file to write. A binary one must have an ending of its format, a text none of another.
  CLI::Option* add_output(const std::string& name, std::string& path, const std::string& help,
                          const OutputFormat& format);
};

/// A subcommand whose result is written to -o.
class ResultCommand : public Command {
protected:
  ResultCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
                OutputFormat format);

  const std::string& output() const { return output_; }
  CLI::Option* output_option() { return output_option_; }
  bool quiet() const { return quiet_; }
  /// Writes to the file that -o names, or to standard output.
  void deliver(const std::string& text) const;

private:
  std::string output_;
  bool quiet_ = false;
  CLI::Option* output_option_;
};

/// A subcommand whose result is read from a run file.
class RunCommand : public ResultCommand {
protected:
  RunCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
             OutputFormat format);
  schema::FileReader open_run() const { return {run_, schema::FileKind::run}; }
  const std::string& path_of_run() const { return run_; }

private:
  std::string run_;
};

/// A subcommand whose result is read from a state of the grains: a snapshot of a run, or a meshed packing.
class StateCommand : public ResultCommand {
protected:
  StateCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
               OutputFormat format);
  bool of_packing() const { return !packing_.empty(); }
  const std::string& path_of_run() const { return run_; }
  const std::string& path_of_packing() const { return packing_; }
  /// Throws InputError where both of them are given, or neither.
  void require_run_or_packing() const;
  /// The same check, then the state.
  Snapshot read_state(int snapshot) const;

private:
  std::string run_, packing_;
};

/// --snapshot; -1 is the last.
void add_snapshot(CLI::App& command, int& snapshot);
/// --axis, one of x, y, z.
void add_axis(CLI::App& command, std::string& axis, const std::string& help);
/// 0, 1 or 2 of "x", "y" or "z".
int axis_number(const std::string& axis);

/// Adds --mesh, --title and --pixels of a picture. `when` begins their help; `patches` names the shapes with edges.
template <class PictureRequest>
void add_drawing(CLI::App& command, PictureRequest& request, const std::string& when, const std::string& default_title,
                 const std::string& patches) {
  command.add_flag("--mesh", request.mesh_lines, when + "Draw the edges of " + patches);
  command.add_option("--title", request.title, when + "Title (default: " + default_title + ")");
  add_number(command, "--pixels", request.pixels, Range::between(50, 4000), "", when + "Pixels along the longer side")
      ->capture_default_str();
}

} // namespace mpfem
