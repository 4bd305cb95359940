#include "common/subcommand.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"

namespace mpfem {

void Subcommand::run_if_given() const {
  if (!options_->parsed()) return;
  for (const std::string* input : inputs_) refuse_overwriting_any({*input});
  refuse_shared_names(named_outputs());
  check_outputs();
  execute();
}

void Subcommand::refuse_given(const std::vector<std::string>& options, const std::string& found,
                              const std::string& allowed) const {
  for (const std::string& option : options)
    if (given(option)) throw InputError(fmt::format("{}: found {}, allowed: {}", option, found, allowed));
}

CLI::Option* Subcommand::add_input(const std::string& name, std::string& path, const std::string& help) {
  return add_later_input(name, path, help)->check(existing_file());
}

CLI::Option* Subcommand::add_later_input(const std::string& name, std::string& path, const std::string& help) {
  inputs_.push_back(&path);
  return options_->add_option(name, path, help);
}

CLI::Option* Subcommand::add_output(const std::string& name, std::string& path, const std::string& help,
                                    OutputKind kind, OutputCheck check) {
  CLI::Option* const added = options_->add_option(name, path, help);
  outputs_.push_back({name.substr(name.find("--")), &path, kind, std::move(check), added});
  return added;
}

std::vector<NamedOutput> Subcommand::named_outputs() const {
  std::vector<NamedOutput> outputs;
  for (const OutputFile& output : outputs_) outputs.push_back({output.option, *output.path});
  return outputs;
}

void Subcommand::refuse_overwriting_any(const std::vector<std::string>& inputs) const {
  for (const NamedOutput& output : named_outputs())
    for (const std::string& input : inputs) refuse_overwriting(output.option, output.path, input);
}

/// Checked before hours of work, not after them.
void Subcommand::check_outputs() const {
  for (const OutputFile& output : outputs_) {
    const std::string& path = *output.path;
    if (path.empty() && !output.added->get_required()) continue;
    check_output_path(output.option, path, output.kind);
    if (output.check) output.check(output.option, path);
    try_output(path);
  }
}

} // namespace mpfem
