#include "postproc/commands/command.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/files/text_file.hpp"

namespace mpfem {

CLI::Option* Command::add_output(const std::string& name, std::string& path, const std::string& help,
                                 const OutputFormat& format) {
  const auto refuse = format.kind == OutputKind::binary ? refuse_other_endings : refuse_ending_of_other_format;
  return Subcommand::add_output(name, path, help, format.kind,
                                [refuse, endings = format.endings](const std::string& option, const std::string& file) {
                                  refuse(option, file, endings);
                                });
}

ResultCommand::ResultCommand(CLI::App& app, const std::string& name, const std::string& help,
                             const std::string& output_help, OutputFormat format)
    : Command(app, name, help), output_option_(add_output("-o,--output", output_, output_help, std::move(format))) {
  options().add_flag("--quiet", quiet_, "Print only the result");
}

void ResultCommand::deliver(const std::string& text) const {
  if (output_.empty())
    fmt::print("{}", text);
  else
    write_file(output_, text);
}

RunCommand::RunCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
                       OutputFormat format)
    : ResultCommand(app, name, help, output_help, std::move(format)) {
  add_input("run", run_, "Run file (HDF5)")->required();
}

StateCommand::StateCommand(CLI::App& app, const std::string& name, const std::string& help,
                           const std::string& output_help, OutputFormat format)
    : ResultCommand(app, name, help, output_help, std::move(format)) {
  add_input("run", run_, "Run file (HDF5)");
  add_input("--packing", packing_, "Meshed packing, instead of a run (HDF5)");
}

void StateCommand::require_run_or_packing() const {
  if (packing_.empty() == run_.empty())
    throw InputError(
        fmt::format("found {} of RUN.h5 and --packing, allowed: exactly one", run_.empty() ? "neither" : "both"));
}

Snapshot StateCommand::read_state(int snapshot) const {
  require_run_or_packing();
  return packing_.empty() ? read_snapshot({run_, schema::FileKind::run}, snapshot) : read_packing_snapshot(packing_);
}

void add_snapshot(CLI::App& command, int& snapshot) {
  add_number(command, "--snapshot", snapshot, whole_numbers, "", "Number of the snapshot; -1 is the last")
      ->capture_default_str();
}

void add_axis(CLI::App& command, std::string& axis, const std::string& help) {
  command.add_option("--axis", axis, help)->check(one_of({"x", "y", "z"}))->capture_default_str();
}

int axis_number(const std::string& axis) {
  return axis == "x" ? 0 : axis == "y" ? 1 : 2;
}

} // namespace mpfem
