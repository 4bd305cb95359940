// mesh: every sphere becomes a mesh of tetrahedra.

#include "common/physical_ranges.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/commands/write_meshed.hpp"
#include "pack-gen/sphere_import.hpp"

namespace mpfem {

namespace {

class MeshCommand : public FileCommand {
public:
  explicit MeshCommand(CLI::App& app)
      : FileCommand(app, "mesh", "Mesh every sphere.\nExample: pack-gen mesh spheres.h5 --size 0.03 -o packing.h5",
                    "Spheres (HDF5)") {
    add_required_output(OutputKind::binary);
    add_number(options(), "--size", meshing_.size, positive_length, "mm", "Nominal element size")->required();
    add_number(options(), "--seed", meshing_.seed, seed_numbers, "", "Seed of the meshes' orientations (default: 1)");
    options().add_flag("!--no-optimise", meshing_.optimise, "Do not optimise meshes for a larger time step");
    add_threads(meshing_.threads);
    add_material(meshing_.material);
  }

private:
  void execute() const override {
    const SphereFile file = read_spheres(input());
    refuse_overlap(file.packing, input());
    MeshingOptions meshing = meshing_;
    meshing.input = input(), meshing.output = output(), meshing.quiet = quiet();
    write_meshed(meshing, file.packing, file.origin);
  }

  MeshingOptions meshing_; ///< without files and quiet, which are set in execute()
};

} // namespace

std::unique_ptr<Command> mesh_command(CLI::App& app) {
  return std::make_unique<MeshCommand>(app);
}

} // namespace mpfem
