// pack-gen: random packings of spheres of a given size distribution, and their meshes.

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "common/available_cores.hpp"
#include "common/available_memory.hpp"
#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/progress.hpp"
#include "common/table_reader.hpp"
#include "common/version.hpp"
#include "pack-gen/container.hpp"
#include "pack-gen/hemispheres.hpp"
#include "pack-gen/mesh_report.hpp"
#include "pack-gen/packing_description.hpp"
#include "pack-gen/packing_quality.hpp"
#include "pack-gen/settle.hpp"
#include "pack-gen/sphere_file.hpp"
#include "pack-gen/sphere_import.hpp"
#include "pack-gen/sphere_order.hpp"
#include "results-schema/file.hpp"

namespace {

using namespace mpfem;

struct Arguments {
  std::string input, output, description, sizes, target;
  std::vector<std::string> assignments;
  std::optional<std::int64_t> seed;
  std::vector<double> box, bottom_center;
  std::string container, surface;
  std::optional<double> scale;
  std::optional<double> diameter, height, gap;
  bool fit_height = false;
  double size = 0;
  HemisphereRequest hemispheres;
  StepMaterial material;
  int threads = 1;
  bool optimise = true;
  bool quiet = false;
};

std::vector<NamedOutput> outputs_of(const Arguments& arguments) {
  return {{"--output", arguments.output}, {"--sizes", arguments.sizes}, {"--target", arguments.target}};
}

/// Refuses each output that would replace one of these inputs. What is not given is empty.
void refuse_overwriting_any(const Arguments& arguments, const std::vector<std::string>& inputs) {
  for (const NamedOutput& output : outputs_of(arguments))
    for (const std::string& input : inputs) refuse_overwriting(output.option, output.path, input);
}

/// Refuses to replace a run, a checkpoint or what is no HDF5 file. A damaged packing may be replaced.
void refuse_other_file(const std::string& output) {
  if (!schema::is_other_file(output, schema::FileKind::packing)) return;
  throw InputError(fmt::format("--output {}: would replace {}, allowed: another name", one_line(output),
                               is_hdf5(output) ? "a run or a checkpoint" : "a file that is no packing"));
}

/// Checked before hours of work, not after them. `kind`: of --output, which only `quality` may lack.
void check_outputs(const Arguments& arguments, OutputKind kind, bool of_quality) {
  refuse_overwriting_any(arguments, {arguments.input, arguments.description, arguments.surface});
  if (!of_quality || !arguments.output.empty()) check_output_path("--output", arguments.output, kind);
  if (!arguments.sizes.empty()) check_output_path("--sizes", arguments.sizes, OutputKind::text);
  if (!arguments.target.empty()) check_output_path("--target", arguments.target, OutputKind::text);
  refuse_shared_names(outputs_of(arguments));
  if (kind == OutputKind::binary) refuse_other_file(arguments.output), try_output(arguments.output);
}

/// The description, overridden by the command line.
PackingDescription description_of(const Arguments& arguments) {
  TomlDocument document = TomlDocument::from_file(arguments.input);
  for (const std::string& assignment : arguments.assignments) document.set(assignment);
  if (arguments.seed) document.set(fmt::format("seed={}", *arguments.seed));
  if (!arguments.container.empty()) document.set(fmt::format("container={}", arguments.container));
  if (arguments.diameter) document.set(fmt::format("diameter={}", *arguments.diameter));
  if (arguments.height) document.set(fmt::format("height={}", *arguments.height));
  if (!arguments.surface.empty())
    document.set(fmt::format("surface_file={}", std::filesystem::absolute(arguments.surface).string()));
  if (arguments.scale) document.set(fmt::format("surface_scale={}", *arguments.scale));
  return read_packing_description(document, !arguments.container.empty() && arguments.container != "box");
}

/// What `make` returns. Its InputErrors, which know no file, name this one.
template <class Make>
auto naming_file(const std::string& path, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", shown_path(path), error.what()));
  }
}

void spheres(const Arguments& arguments) {
  const PackingDescription description = description_of(arguments);
  refuse_overwriting_any(arguments, description.files);
  const DrawnSizes sizes = draw_sizes(description);
  Progress progress("pack-gen", arguments.quiet);
  const SpherePacking packing = numbered(naming_file(arguments.input, [&] {
    return pack_spheres({.box = description.container.lengths,
                         .shape = description.container.shape,
                         .surface = description.container.surface,
                         .radius = sizes.radius,
                         .smallest_gap = description.smallest_gap,
                         .seed = description.seed,
                         .progress = [&](const std::string& state) { progress.update(state); }});
  }));
  PackingOrigin origin{static_cast<std::int64_t>(description.seed), description.text, {}, {}};
  tabulate_target(*description.distribution, sizes.scale, origin);
  write_packing_file(arguments.output, packing, origin);
  progress.finish(fmt::format("{} spheres, relative density {:.6f}, smallest gap {:.4g} mm, sizes scaled by {:.5f}, {}",
                              packing.radius.size(), relative_density(packing), smallest_gap(packing).gap, sizes.scale,
                              arguments.output));
}

/// Meshes the spheres and writes the packing. Throws SimulationError if a gap between facets cannot be proven.
void write_meshed(const Arguments& arguments, const SpherePacking& packing, const PackingOrigin& origin) {
  Progress progress("pack-gen", arguments.quiet);
  const PackingMesh mesh = naming_file(arguments.input, [&] {
    return mesh_packing(
        packing, {.nominal_size = arguments.size,
                  .seed = static_cast<std::uint64_t>(arguments.seed.value_or(1)),
                  .threads = arguments.threads,
                  .optimise = arguments.optimise,
                  .memory = available_memory(),
                  .progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); }});
  });
  const MeshReport report = report_mesh(packing, mesh, arguments.size, arguments.material, arguments.threads);
  if (!(report.facet_gap.gap > 0))
    throw SimulationError(fmt::format("{}: no positive gap could be proven between the facets of grain {} and {}",
                                      arguments.input, report.facet_gap.first,
                                      neighbour_name(report.facet_gap.second)));
  write_packing_file(arguments.output, packing, origin,
                     MeshForFile{&mesh, arguments.size, report.facet_gap.gap, report.smallest_quality});
  progress.finish(fmt::format("{} tetrahedra, {}", report.tets, arguments.output));
  if (arguments.quiet) return;
  for (const std::string& note : mesh.notes) fmt::print(stderr, "pack-gen: note: {}\n", note);
  fmt::print("{}", report_text(report));
}

void mesh(const Arguments& arguments) {
  const SphereFile file = read_spheres(arguments.input);
  refuse_overlap(file.packing, arguments.input);
  write_meshed(arguments, file.packing, file.origin);
}

void settle_spheres(const Arguments& arguments) {
  const SphereFile file = read_spheres(arguments.input);
  refuse_overlap(file.packing, arguments.input);
  Progress progress("pack-gen", arguments.quiet);
  const double gap = arguments.gap.value_or(std::max(smallest_gap(file.packing).gap, 0.0));
  const auto settled = naming_file(arguments.input, [&] {
    return settle(file.packing, {.smallest_gap = gap,
                                 .fit_height = arguments.fit_height,
                                 .progress = [&](const std::string& state) { progress.update(state); }});
  });
  write_packing_file(arguments.output, settled.packing, file.origin);
  SpherePacking bed = settled.packing;
  bed.box[2] = settled.bed_height + gap;
  progress.finish(fmt::format(
      "{} spheres at rest, height of the bed {:.4g} mm, relative density {:.6f}, smallest gap {:.4g} mm, {}",
      bed.radius.size(), settled.bed_height, relative_density(bed), smallest_gap(settled.packing).gap,
      arguments.output));
}

void hemispheres(const Arguments& arguments) {
  HemisphereRequest request = arguments.hemispheres;
  if (request.bulk_size == 0) request.bulk_size = std::min(3 * request.contact_size, request.size);
  Progress progress("pack-gen", arguments.quiet);
  progress.update(0, "meshing a hemisphere");
  const Hemispheres pair = mesh_hemispheres(request);
  progress.update(0.8, "measuring");
  const MeshReport report = report_mesh(pair.packing, pair.mesh, request.size, arguments.material, arguments.threads);
  const Refinement detail = refinement(request, pair);
  write_packing_file(
      arguments.output, pair.packing,
      {{},
       fmt::format("hemispheres of radius {:g} mm, {:g} mm at the contact", request.radius, request.contact_size),
       {},
       {}},
      MeshForFile{&pair.mesh, request.size, report.facet_gap.gap, report.smallest_quality, true});
  progress.finish(fmt::format("{} tetrahedra, {}", report.tets, arguments.output));
  if (!arguments.quiet)
    fmt::print("{} nodes, {} tetrahedra, {} of them in the lower hemisphere, {} near the contact in both; smallest "
               "edge {:.4g} mm; gap {:.4g} mm; smallest quality {:.3f}; critical step {:.4g} s = {:.3f} contact "
               "size/wave speed, median {:.4g} s\n",
               report.nodes, report.tets, pair.mesh.grain_tet_offset[1], detail.tets_near, detail.smallest_edge,
               pair.tip_gap, report.smallest_quality, report.smallest_step,
               report.smallest_step * arguments.material.wave_speed() / request.contact_size, report.median_step);
}

/// Throws InputError if options of different containers are mixed, or those of one are incomplete.
void check_container(const Arguments& arguments) {
  const bool cylinder = arguments.container == "cylinder";
  const auto refuse = [](const char* option, const char* allowed) {
    throw InputError(fmt::format("{}, allowed: {}", option, allowed));
  };
  if (cylinder && !arguments.box.empty())
    refuse("--box: cannot be used with --container cylinder", "--diameter and --height");
  if (cylinder && !(arguments.diameter && arguments.height))
    refuse("--container cylinder: found no diameter or no height", "--diameter D --height H");
  if (!cylinder && (arguments.diameter || arguments.height || !arguments.bottom_center.empty()))
    refuse("--diameter, --height, --bottom-center: found without a cylinder", "--container cylinder");
  const bool surface = arguments.container == "surface";
  if (surface && !arguments.box.empty())
    refuse("--box: cannot be used with --container surface", "--surface and --scale");
  if (surface && (arguments.surface.empty() || !arguments.scale))
    refuse("--container surface: found no file or no scale", "--surface FILE.stl --scale MM");
  if (!surface && (!arguments.surface.empty() || arguments.scale))
    refuse("--surface, --scale: found without a surface", "--container surface");
}

ImportedSpheres imported(const Arguments& arguments) {
  check_container(arguments);
  const auto point = [](const std::vector<double>& v) { return Point{v[0], v[1], v[2]}; };
  std::optional<Point> box;
  if (!arguments.box.empty()) box = point(arguments.box);
  if (arguments.container == "surface")
    return import_spheres(arguments.input, read_surface(arguments.surface, "--scale", *arguments.scale));
  if (arguments.container != "cylinder") return import_spheres(arguments.input, box);
  CylinderInTable cylinder{*arguments.diameter, *arguments.height, {}};
  cylinder.bottom_center = arguments.bottom_center.empty() ? Point{0.5 * cylinder.diameter, 0.5 * cylinder.diameter, 0}
                                                           : point(arguments.bottom_center);
  return import_spheres(arguments.input, cylinder);
}

void import(const Arguments& arguments) {
  const ImportedSpheres spheres = imported(arguments);
  const SpherePacking& packing = spheres.packing;
  refuse_overlap(spheres, arguments.input);
  if (const std::string remark = implausible_surface(spheres); !remark.empty() && !arguments.quiet)
    fmt::print(stderr, "pack-gen: warning: {}\n", remark);
  const PackingOrigin origin{{}, "imported from " + arguments.input, {}, {}};
  if (arguments.size > 0) return write_meshed(arguments, packing, origin);
  write_packing_file(arguments.output, packing, origin);
  if (!arguments.quiet)
    fmt::print(stderr, "pack-gen: {} spheres, relative density {:.6f}, smallest gap {:.4g} mm, {}\n",
               packing.radius.size(), relative_density(packing), smallest_gap(packing).gap, arguments.output);
}

/// A defect that would be a failure of the mesher is here a mistake in the file.
MeshReport report_of_file(const Arguments& arguments, const SpherePacking& packing) {
  const MeshFromFile mesh = read_mesh(arguments.input);
  try {
    return report_mesh(packing, mesh.mesh, mesh.nominal_size, arguments.material, arguments.threads);
  } catch (const SimulationError& error) {
    throw InputError(fmt::format("{}: {}, allowed: closed grains of tetrahedra with positive volume",
                                 one_line(arguments.input), error.what()));
  }
}

void quality(const Arguments& arguments) {
  const SphereFile file = read_spheres(arguments.input);
  const MeshReport report = report_of_file(arguments, file.packing);
  std::optional<PackingDescription> description;
  if (!arguments.description.empty()) {
    description = read_packing_description(TomlDocument::from_file(arguments.description));
    refuse_overwriting_any(arguments, description->files);
    if (!arguments.target.empty()) write_file(arguments.target, target_csv(*description));
  }
  if (!arguments.sizes.empty()) write_file(arguments.sizes, sizes_csv(file.packing));
  if (!arguments.output.empty())
    write_file(arguments.output, quality_json(file.packing, report, description ? &*description : nullptr));
  if (!arguments.quiet) fmt::print("{}", report_text(report));
}

void add_quality_outputs(CLI::App& command, Arguments& arguments) {
  command.add_option("-o,--output", arguments.output, "JSON file to write: the report's numbers by name");
  command
      .add_option("--description", arguments.description,
                  "Description of the packing (TOML); the report then compares the sizes of the grains with it")
      ->check(existing_file());
  command.add_option("--sizes", arguments.sizes, "CSV file to write: diameters with their cumulative fraction");
  command.add_option("--target", arguments.target, "CSV file to write: the size table of --description")
      ->needs("--description");
}

void add_material(CLI::App& command, StepMaterial& material) {
  add_number(command, "--youngs-modulus", material.youngs_modulus, positive_modulus, "MPa",
             "Of the grains' material, for the critical time step")
      ->capture_default_str();
  add_number(command, "--poissons-ratio", material.poissons_ratio, Range::between(-0.99, 0.499), "",
             "Of the grains' material, for the critical time step")
      ->capture_default_str();
  add_number(command, "--density", material.density, positive_density, "tonne/mm^3",
             "Of the grains' material, for the critical time step")
      ->capture_default_str();
}

constexpr const char* help_text =
    "pack-gen: packs spheres of a size distribution in a box, a cylinder or a closed surface, and meshes them with "
    "tetrahedra.\n"
    "Examples:\n"
    "  pack-gen spheres powder.toml -o spheres.h5 --seed 2\n"
    "  pack-gen spheres powder.toml --container cylinder --diameter 1 --height 1.2 -o spheres.h5\n"
    "  pack-gen import spheres.csv --box 1,1,1 -o spheres.h5\n"
    "  pack-gen settle spheres.h5 --fit-height -o settled.h5\n"
    "  pack-gen mesh spheres.h5 --size 0.03 -o packing.h5\n"
    "  pack-gen quality packing.h5\n"
    "  pack-gen hemispheres --radius 0.1 --size 0.012 --contact-size 0.0005 --contact-radius 0.01 -o pair.h5\n"
    "  pack-gen export spheres.h5 -o spheres.csv\n"
    "Lengths in mm. Exit codes: 0 done, 2 bad usage or input, or a packing that cannot be made, 3 gmsh failed, 4 "
    "storage failed.";

void add_threads(CLI::App& command, Arguments& arguments) {
  add_number(command, "--threads", arguments.threads, thread_numbers, "",
             "Threads (default: all cores available to it); the result does not depend on them");
}

/// --container and the options of each; `otherwise`: the default without them.
void add_container(CLI::App& command, Arguments& arguments, const std::string& otherwise) {
  command
      .add_option("--container", arguments.container,
                  "box, cylinder (along z) or surface (a closed one from an STL file) (default: " + otherwise + ")")
      ->check(one_of({"box", "cylinder", "surface"}));
  add_number(command, "--diameter", arguments.diameter, positive_length, "mm", "Diameter of the cylinder");
  add_number(command, "--height", arguments.height, positive_length, "mm", "Height of the cylinder");
  command.add_option("--surface", arguments.surface, "STL file of the surface; its lowest corner becomes the origin")
      ->check(existing_file());
  add_number(command, "--scale", arguments.scale, length_of_unit, "mm", "Length of one unit of the STL file");
}

/// A command that reads a file, described by `input`.
CLI::App* add_command(CLI::App& app, Arguments& arguments, const char* name, const char* help, const char* input) {
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("input", arguments.input, input)->required()->check(existing_file());
  command->add_flag("--quiet", arguments.quiet, "No progress, notes or report");
  return command;
}

void add_output(CLI::App& command, Arguments& arguments) {
  command.add_option("-o,--output", arguments.output, "File to write")->required();
}

CLI::App* add_spheres(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      add_command(app, arguments, "spheres",
                  "Pack spheres as described in a TOML file.\n"
                  "Example: pack-gen spheres powder.toml -o spheres.h5\n"
                  "         pack-gen spheres powder.toml --container cylinder --diameter 1 --height 1.2 -o spheres.h5",
                  "Description of the packing (TOML)");
  add_output(*command, arguments);
  add_number(*command, "--seed", arguments.seed, seed_numbers, "", "Seed, instead of the one in the description");
  add_container(*command, arguments, "the description's, else a box");
  add_assignments(*command, arguments.assignments, "Override a value: KEY=VALUE, e.g. count=400");
  return command;
}

CLI::App* add_settle(CLI::App& app, Arguments& arguments) {
  CLI::App* command = add_command(app, arguments, "settle",
                                  "Let spheres sink under their weight, along -z and without friction, until they rest "
                                  "on each other, the bottom and the walls. A box or cylinder is open above.\n"
                                  "Example: pack-gen settle spheres.h5 --fit-height -o settled.h5",
                                  "Spheres (HDF5)");
  add_output(*command, arguments);
  add_number(*command, "--gap", arguments.gap, Range::between(0, 1e9), "mm",
             "Smallest gap to keep between spheres and to the walls (default: the gap of the file)");
  command->add_flag("--fit-height", arguments.fit_height,
                    "Lower or raise the box or cylinder to the bed (default: it stays, with free space above)");
  return command;
}

CLI::App* add_mesh(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      add_command(app, arguments, "mesh",
                  "Mesh every sphere.\nExample: pack-gen mesh spheres.h5 --size 0.03 -o packing.h5", "Spheres (HDF5)");
  add_output(*command, arguments);
  add_number(*command, "--size", arguments.size, positive_length, "mm", "Nominal element size")->required();
  add_number(*command, "--seed", arguments.seed, seed_numbers, "", "Seed of the meshes' orientations (default: 1)");
  command->add_flag("!--no-optimise", arguments.optimise, "Do not optimise meshes for a larger time step");
  add_threads(*command, arguments);
  add_material(*command, arguments.material);
  return command;
}

CLI::App* add_import(CLI::App& app, Arguments& arguments) {
  CLI::App* command = add_command(app, arguments, "import",
                                  "Read spheres from a table x,y,z,radius (mm), e.g. from a discrete-element program.\n"
                                  "Example: pack-gen import spheres.csv --box 1,1,1 -o spheres.h5\n"
                                  "         pack-gen import spheres.csv --size 0.03 -o packing.h5\n"
                                  "         pack-gen import spheres.csv --container cylinder --diameter 1 --height "
                                  "1.2 -o spheres.h5",
                                  "Spheres (CSV)");
  add_output(*command, arguments);
  add_number(*command, "--size", arguments.size, positive_length, "mm", "Nominal element size (default: not meshed)");
  add_threads(*command, arguments);
  add_numbers(
      *command, "--box", arguments.box, 3, positive_length, "mm",
      "Edge lengths X,Y,Z of the box, which begins at the origin (default: the smallest box around the spheres)");
  add_container(*command, arguments, "box");
  add_numbers(*command, "--bottom-center", arguments.bottom_center, 3, any_length, "mm",
              "X,Y,Z of the centre of the cylinder's bottom in the table's coordinates (default: D/2,D/2,0)");
  return command;
}

CLI::App* add_export(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      add_command(app, arguments, "export",
                  "Write spheres to a table x,y,z,radius (mm).\nExample: pack-gen export spheres.h5 -o spheres.csv",
                  "Packing (HDF5), meshed or not");
  add_output(*command, arguments);
  return command;
}

CLI::App* add_quality(CLI::App& app, Arguments& arguments) {
  CLI::App* command = add_command(app, arguments, "quality",
                                  "Report the quality of a mesh: volumes, shapes, gaps and critical time "
                                  "step.\nExample: pack-gen quality packing.h5",
                                  "Meshed packing (HDF5)");
  add_quality_outputs(*command, arguments);
  add_threads(*command, arguments);
  add_material(*command, arguments.material);
  return command;
}

CLI::App* add_hemispheres(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand(
      "hemispheres",
      "Mesh two hemispheres tip to tip, finely where they will touch.\n"
      "Example: pack-gen hemispheres --radius 0.1 --size 0.012 --contact-size 0.0005 --contact-radius 0.01 -o pair.h5");
  const auto length = [&](const char* name, double& value, const char* help, bool required) {
    CLI::Option* option = add_number(*command, name, value, positive_length, "mm", help);
    if (required) option->required();
  };
  HemisphereRequest& pair = arguments.hemispheres;
  pair.gap = 1e-6;
  length("--radius", pair.radius, "Radius", true);
  length("--size", pair.size, "Element size far from the contact", true);
  length("--contact-size", pair.contact_size, "Element size on the curved face near the tip", true);
  length("--contact-radius", pair.contact_radius, "Distance from the tip over which elements have that size", true);
  length("--bulk-size", pair.bulk_size,
         "Largest element size within 1.5 contact radii under the tip (default: 3 contact sizes)", false);
  add_number(*command, "--growth", pair.growth, Range::between(1e-6, 1e6), "",
             "Increase of the element size per distance (default: 0.3)");
  length("--gap", pair.gap, "Distance of the tips (default: 1e-6)", false);
  length("--box-width", pair.box_width, "Width of the box in x and y (default: 2.4 radii)", false);
  add_number(*command, "--rotate", pair.rotation, Range::between(-360, 360), "degrees",
             "Rotation of the upper hemisphere about the axis")
      ->capture_default_str();
  add_output(*command, arguments);
  command->add_flag("--quiet", arguments.quiet, "No report");
  add_material(*command, arguments.material);
  return command;
}

int body(int argc, char** argv) {
  CLI::App app(help_text);
  app.set_version_flag("--version", "pack-gen " + version_and_commit());
  app.require_subcommand(1);
  Arguments arguments;
  arguments.threads = available_cores();
  const CLI::App* spheres_command = add_spheres(app, arguments);
  const CLI::App* settle_command = add_settle(app, arguments);
  const CLI::App* mesh_command = add_mesh(app, arguments);
  const CLI::App* import_command = add_import(app, arguments);
  const CLI::App* export_command = add_export(app, arguments);
  const CLI::App* quality_command = add_quality(app, arguments);
  const CLI::App* hemispheres_command = add_hemispheres(app, arguments);

  if (const auto done = parse_command_line(app, "pack-gen", argc, argv)) return *done;
  const bool of_quality = quality_command->parsed();
  check_outputs(arguments, export_command->parsed() || of_quality ? OutputKind::text : OutputKind::binary, of_quality);
  if (spheres_command->parsed()) spheres(arguments);
  if (settle_command->parsed()) settle_spheres(arguments);
  if (mesh_command->parsed()) mesh(arguments);
  if (hemispheres_command->parsed()) hemispheres(arguments);
  if (import_command->parsed()) import(arguments);
  if (export_command->parsed()) export_spheres(arguments.output, read_spheres(arguments.input).packing);
  if (quality_command->parsed()) quality(arguments);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("pack-gen", body, argc, argv);
}
