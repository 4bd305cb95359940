// pack-gen: random packings of spheres of a given size distribution, and their meshes.

#include <vector>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/version.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"

namespace {

using namespace mpfem;

constexpr const char* help =
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

/// In the order of the help text.
constexpr MakeCommand* all_commands[] = {spheres_command, settle_command,  mesh_command,       import_command,
                                         export_command,  quality_command, hemispheres_command};

int body(int argc, char** argv) {
  CLI::App app(help);
  app.set_version_flag("--version", "pack-gen " + version_and_commit());
  app.require_subcommand(1);
  std::vector<std::unique_ptr<Command>> commands;
  for (MakeCommand* make : all_commands) commands.push_back(make(app));
  if (const auto done = parse_command_line(app, "pack-gen", argc, argv)) return *done;
  for (const auto& command : commands) command->run_if_given();
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("pack-gen", body, argc, argv);
}
