// import: spheres of a table, meshed or not.

#include <cstdio>

#include "common/physical_ranges.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/commands/write_meshed.hpp"
#include "pack-gen/container.hpp"
#include "pack-gen/sphere_import.hpp"

namespace mpfem {

namespace {

Point point(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

class ImportCommand : public FileCommand {
public:
  explicit ImportCommand(CLI::App& app)
      : FileCommand(app, "import",
                    "Read spheres from a table x,y,z,radius (mm), e.g. from a discrete-element program.\n"
                    "Example: pack-gen import spheres.csv --box 1,1,1 -o spheres.h5\n"
                    "         pack-gen import spheres.csv --size 0.03 -o packing.h5\n"
                    "         pack-gen import spheres.csv --container cylinder --diameter 1 --height "
                    "1.2 -o spheres.h5",
                    "Spheres (CSV)") {
    add_required_output(OutputKind::binary);
    add_number(options(), "--size", meshing_.size, positive_length, "mm", "Nominal element size (default: not meshed)");
    add_threads(meshing_.threads);
    add_numbers(
        options(), "--box", box_, 3, positive_length, "mm",
        "Edge lengths X,Y,Z of the box, which begins at the origin (default: the smallest box around the spheres)");
    add_container(container_, "box");
    add_numbers(options(), "--bottom-center", bottom_center_, 3, any_length, "mm",
                "X,Y,Z of the centre of the cylinder's bottom in the table's coordinates (default: D/2,D/2,0)");
  }

private:
  /// Throws InputError if options of different containers are mixed, or those of one are incomplete.
  void check_container() const {
    const bool cylinder = container_.container == "cylinder";
    const auto refuse = [](const char* option, const char* allowed) {
      throw InputError(fmt::format("{}, allowed: {}", option, allowed));
    };
    if (cylinder && !box_.empty()) refuse("--box: cannot be used with --container cylinder", "--diameter and --height");
    if (cylinder && !(container_.diameter && container_.height))
      refuse("--container cylinder: found no diameter or no height", "--diameter D --height H");
    if (!cylinder && (container_.diameter || container_.height || !bottom_center_.empty()))
      refuse("--diameter, --height, --bottom-center: found without a cylinder", "--container cylinder");
    const bool surface = container_.container == "surface";
    if (surface && !box_.empty()) refuse("--box: cannot be used with --container surface", "--surface and --scale");
    if (surface && (container_.surface.empty() || !container_.scale))
      refuse("--container surface: found no file or no scale", "--surface FILE.stl --scale MM");
    if (!surface && (!container_.surface.empty() || container_.scale))
      refuse("--surface, --scale: found without a surface", "--container surface");
  }

  ImportedSpheres imported() const {
    check_container();
    std::optional<Point> box;
    if (!box_.empty()) box = point(box_);
    if (container_.container == "surface")
      return import_spheres(input(), read_surface(container_.surface, "--scale", *container_.scale));
    if (container_.container != "cylinder") return import_spheres(input(), box);
    CylinderInTable cylinder{*container_.diameter, *container_.height, {}};
    cylinder.bottom_center =
        bottom_center_.empty() ? Point{0.5 * cylinder.diameter, 0.5 * cylinder.diameter, 0} : point(bottom_center_);
    return import_spheres(input(), cylinder);
  }

  void execute() const override {
    const ImportedSpheres spheres = imported();
    const SpherePacking& packing = spheres.packing;
    refuse_overlap(spheres, input());
    if (const std::string remark = implausible_surface(spheres); !remark.empty() && !quiet())
      fmt::print(stderr, "pack-gen: warning: {}\n", remark);
    const PackingOrigin origin{{}, "imported from " + input(), {}, {}};
    if (meshing_.size > 0) {
      MeshingOptions meshing = meshing_;
      meshing.input = input(), meshing.output = output(), meshing.quiet = quiet();
      return write_meshed(meshing, packing, origin);
    }
    write_packing_file(output(), packing, origin);
    if (!quiet())
      fmt::print(stderr, "pack-gen: {} spheres, relative density {:.6f}, smallest gap {:.4g} mm, {}\n",
                 packing.radius.size(), relative_density(packing), smallest_gap(packing).gap, output());
  }

  std::vector<double> box_, bottom_center_; ///< mm
  ContainerOptions container_;
  MeshingOptions meshing_; ///< size 0: not meshed; without files and quiet, which are set in execute()
};

} // namespace

std::unique_ptr<Command> import_command(CLI::App& app) {
  return std::make_unique<ImportCommand>(app);
}

} // namespace mpfem
