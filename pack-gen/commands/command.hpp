#pragma once
// Shared parts of pack-gen's subcommands: options, input and output files.

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/subcommand.hpp"

namespace mpfem {

struct StepMaterial;

/// --container and the options of each container. What is not given is empty.
struct ContainerOptions {
  std::string container;                         ///< box, cylinder or surface
  std::string surface;                           ///< STL file
  std::optional<double> diameter, height, scale; ///< mm; scale: length of one unit of the STL file
};

/// A subcommand of pack-gen. One class for each.
class Command : public Subcommand {
protected:
  Command(CLI::App& app, const std::string& name, const std::string& help) : Subcommand(app, name, help) {}

  const std::string& output() const { return output_; }
  bool quiet() const { return quiet_; }

  void add_quiet(const std::string& help) { options().add_flag("--quiet", quiet_, help); }
  /// -o, which must be given. A binary one replaces a packing, and nothing else.
  void add_required_output(OutputKind kind);
  /// -o of a text, which may be missing.
  void add_optional_output(const std::string& help);
  /// --container and the options of each; `otherwise`: the default without them.
  void add_container(ContainerOptions& container, const std::string& otherwise);
  /// --threads; `threads` becomes the number of all cores available.
  void add_threads(int& threads);
  /// Options of the grains' material.
  void add_material(StepMaterial& material);

private:
  std::string output_;
  bool quiet_ = false;
};

/// A subcommand that reads a file, described by `input_help`.
class FileCommand : public Command {
protected:
  FileCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& input_help);
  const std::string& input() const { return input_; }

private:
  std::string input_;
};

/// What `make` returns. Its InputErrors, which know no file, name this one.
template <class Make>
auto naming_file(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", shown_path(path), error.what()));
  }
}

} // namespace mpfem
