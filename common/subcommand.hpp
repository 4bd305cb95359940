#pragma once
// Subcommands of pack-gen and postproc: their options, and input and output files that are checked before any work.

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/output_file.hpp"

namespace mpfem {

/// One class for each subcommand. Its constructor adds the options; execute() does the work once they are parsed.
class Subcommand {
public:
  virtual ~Subcommand() = default;
  Subcommand(const Subcommand&) = delete;
  Subcommand& operator=(const Subcommand&) = delete;

  /// Does nothing if the command line has another subcommand. Otherwise refuses outputs that would overwrite an input
  /// or each other, or cannot be written, then executes. Throws InputError, StorageError, SimulationError.
  void run_if_given() const;

protected:
  /// Refuses an output that is not empty, given its option's long name and its path. Throws InputError.
  using OutputCheck = std::function<void(const std::string& option, const std::string& path)>;

  Subcommand(CLI::App& app, const std::string& name, const std::string& help)
      : options_(app.add_subcommand(name, help)) {}

  CLI::App& options() { return *options_; }
  bool given(const std::string& option) const { return options_->count(option) > 0; }
  /// Refuses those of these options that are given: they have no effect. The message is "OPTION: found FOUND, allowed:
  /// ALLOWED". Throws InputError.
  void refuse_given(const std::vector<std::string>& options, const std::string& found,
                    const std::string& allowed) const;

  /// An option with an input file, which must exist; no output of this subcommand may overwrite it.
  CLI::Option* add_input(const std::string& name, std::string& path, const std::string& help);
  /// The same for a file that may be written later.
  CLI::Option* add_later_input(const std::string& name, std::string& path, const std::string& help);
  /// An option that names a file to write. Without ->required() an empty path is an output that is not wanted.
  CLI::Option* add_output(const std::string& name, std::string& path, const std::string& help, OutputKind kind,
                          OutputCheck check = {});

  /// Refuses each output that would replace one of these inputs, which only the work itself finds. Throws InputError.
  void refuse_overwriting_any(const std::vector<std::string>& inputs) const;

  /// Refuses outputs that are none by their place, their kind or their own check, then tries to write each.
  virtual void check_outputs() const;
  virtual void execute() const = 0;

private:
  struct OutputFile {
    std::string option; ///< its long name, for messages
    const std::string* path;
    OutputKind kind;
    OutputCheck check;
    CLI::Option* added;
  };
  std::vector<NamedOutput> named_outputs() const;

  CLI::App* options_;
  std::vector<const std::string*> inputs_;
  std::vector<OutputFile> outputs_;
};

} // namespace mpfem
