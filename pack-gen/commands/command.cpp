#include "pack-gen/commands/command.hpp"

#include "common/available_cores.hpp"
#include "common/physical_ranges.hpp"
#include "pack-gen/mesh_checks.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

namespace {

/// Refuses to replace a run, a checkpoint or what is no HDF5 file. A damaged packing may be replaced.
void refuse_other_file(const std::string& option, const std::string& path) {
  if (!schema::is_other_file(path, schema::FileKind::packing)) return;
  throw InputError(fmt::format("{} {}: would replace {}, allowed: another name", option, one_line(path),
                               is_hdf5(path) ? "a run or a checkpoint" : "a file that is no packing"));
}

} // namespace

void Command::add_required_output(OutputKind kind) {
  add_output("-o,--output", output_, "File to write", kind,
             kind == OutputKind::binary ? OutputCheck(refuse_other_file) : OutputCheck())
      ->required();
}

void Command::add_optional_output(const std::string& help) {
  add_output("-o,--output", output_, help, OutputKind::text);
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

FileCommand::FileCommand(CLI::App& app, const std::string& name, const std::string& help, const std::string& input_help)
    : Command(app, name, help) {
  add_input("input", input_, input_help)->required();
  add_quiet("No progress, notes or report");
}

} // namespace mpfem
