#pragma once
// Shared parts of pack-gen's subcommands: options, input and output files.

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"

namespace mpfem {

struct StepMaterial;

/// --container and the options of each container. What is not given is empty.
struct ContainerOptions {
  std::string container;                         ///< box, cylinder or surface
  std::string surface;                           ///< STL file
  std::optional<double> diameter, height, scale; ///< mm; scale: length of one unit of the STL file
};

/// One class for each subcommand. Its constructor adds the options; execute() does the work once they are parsed.
class Command {
public:
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Does nothing if the command line has another subcommand. Otherwise refuses outputs that would overwrite an input
  /// or cannot be written, then executes. Throws InputError, StorageError, SimulationError.
  void run_if_given() const;

protected:
  Command(CLI::App& app, const std::string& name, const std::string& help) : options_(app.add_subcommand(name, help)) {}

  CLI::App& options() { return *options_; }
  const std::string& output() const { return output_; }
  bool quiet() const { return quiet_; }

  void add_quiet(const std::string& help) { options_->add_flag("--quiet", quiet_, help); }
  /// An option with an input file, which must exist; no output of this subcommand may overwrite it.
  CLI::Option* add_input(const std::string& name, std::string& path, const std::string& help);
  /// -o, which must be given.
  void add_required_output(OutputKind kind);
  /// -o of a text, which may be missing.
  void add_optional_output(const std::string& help);
  /// An option that names another text to write.
  CLI::Option* add_text_output(const std::string& name, std::string& path, const std::string& help);
  /// --container and the options of each; `otherwise`: the default without them.
  void add_container(ContainerOptions& container, const std::string& otherwise);
  /// --threads; `threads` becomes the number of all cores available.
  void add_threads(int& threads);
  /// Options of the grains' material.
  void add_material(StepMaterial& material);

  /// Refuses each output that would replace one of these inputs. Throws InputError.
  void refuse_overwriting_any(const std::vector<std::string>& inputs) const;

  virtual void execute() const = 0;

private:
  struct OutputFile {
    std::string option; ///< its long name, for messages
    const std::string* path;
    OutputKind kind;
    bool required;
  };
  void check_outputs() const;
  std::vector<NamedOutput> named_outputs() const;

  CLI::App* options_;
  std::string output_;
  bool quiet_ = false;
  std::vector<const std::string*> inputs_;
  std::vector<OutputFile> outputs_;
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
