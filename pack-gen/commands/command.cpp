#include "pack-gen/commands/command.hpp"

#include "common/available_cores.hpp"
#include "common/physical_ranges.hpp"
#include "pack-gen/mesh_checks.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

namespace {

/// Refuses to replace a run, a checkpoint or what is no HDF5 file. A damaged packing may be replaced.
void refuse_other_file(const std::string& output) {
  if (!schema::is_other_file(output, schema::FileKind::packing)) return;
  throw InputError(fmt::format("--output {}: would replace {}, allowed: another name", one_line(output),
                               is_hdf5(output) ? "a run or a checkpoint" : "a file that is no packing"));
}

} // namespace

void Command::run_if_given() const {
  if (!options_->parsed()) return;
  check_outputs();
  execute();
}

CLI::Option* Command::add_input(const std::string& name, std::string& path, const std::string& help) {
  inputs_.push_back(&path);
  return options_->add_option(name, path, help)->check(existing_file());
}

void Command::add_required_output(OutputKind kind) {
  outputs_.push_back({"--output", &output_, kind, true});
  options_->add_option("-o,--output", output_, "File to write")->required();
}

void Command::add_optional_output(const std::string& help) {
  outputs_.push_back({"--output", &output_, OutputKind::text, false});
  options_->add_option("-o,--output", output_, help);
}

CLI::Option* Command::add_text_output(const std::string& name, std::string& path, const std::string& help) {
  outputs_.push_back({name, &path, OutputKind::text, false});
  return options_->add_option(name, path, help);
}

void Command::add_container(ContainerOptions& container, const std::string& otherwise) {
  options()
      .add_option("--container", container.container,
                  "box, cylinder (along z) or surface (a closed one from an STL file) (default: " + otherwise + ")")
      ->check(one_of({"box", "cylinder", "surface"}));
  add_number(options(), "--diameter", container.diameter, positive_length, "mm", "Diameter of the cylinder");
  add_number(options(), "--height", container.height, positive_length, "mm", "Height of the cylinder");
  add_input("--surface", container.surface, "STL file of the surface; its lowest corner becomes the origin");
  add_number(options(), "--scale", container.scale, length_of_unit, "mm", "Length of one unit of the STL file");
}

void Command::add_threads(int& threads) {
  threads = available_cores();
  add_number(options(), "--threads", threads, thread_numbers, "",
             "Threads (default: all cores available to it); the result does not depend on them");
}

void Command::add_material(StepMaterial& material) {
  const char* help = "Of the grains' material, for the critical time step";
  add_number(options(), "--youngs-modulus", material.youngs_modulus, positive_modulus, "MPa", help)
      ->capture_default_str();
  add_number(options(), "--poissons-ratio", material.poissons_ratio, Range::between(-0.99, 0.499), "", help)
      ->capture_default_str();
  add_number(options(), "--density", material.density, positive_density, "tonne/mm^3", help)->capture_default_str();
}

std::vector<NamedOutput> Command::named_outputs() const {
  std::vector<NamedOutput> outputs;
  for (const OutputFile& output : outputs_) outputs.push_back({output.option, *output.path});
  return outputs;
}

void Command::refuse_overwriting_any(const std::vector<std::string>& inputs) const {
  for (const NamedOutput& output : named_outputs())
    for (const std::string& input : inputs) refuse_overwriting(output.option, output.path, input);
}

/// Checked before hours of work, not after them.
void Command::check_outputs() const {
  for (const std::string* input : inputs_) refuse_overwriting_any({*input});
  for (const OutputFile& output : outputs_)
    if (output.required || !output.path->empty()) check_output_path(output.option, *output.path, output.kind);
  refuse_shared_names(named_outputs());
  for (const OutputFile& output : outputs_) {
    if (output.kind == OutputKind::binary) refuse_other_file(*output.path);
    if (!output.path->empty()) try_output(*output.path);
  }
}

FileCommand::FileCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& input_help)
    : Command(app, name, help) {
  add_input("input", input_, input_help)->required();
  add_quiet("No progress, notes or report");
}

} // namespace mpfem
