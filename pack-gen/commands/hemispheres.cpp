// hemispheres: two of them tip to tip, meshed.

#include <algorithm>

#include "common/available_cores.hpp"
#include "common/physical_ranges.hpp"
#include "common/progress.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/hemispheres.hpp"
#include "pack-gen/mesh_report.hpp"
#include "pack-gen/sphere_file.hpp"

namespace mpfem {

namespace {

class HemispheresCommand : public Command {
public:
  explicit HemispheresCommand(CLI::App& app)
      : Command(app, "hemispheres",
                "Mesh two hemispheres tip to tip, finely where they will touch.\n"
                "Example: pack-gen hemispheres --radius 0.1 --size 0.012 --contact-size 0.0005 --contact-radius 0.01 "
                "-o pair.h5") {
    request_.gap = 1e-6;
    add_length("--radius", request_.radius, "Radius")->required();
    add_length("--size", request_.size, "Element size far from the contact")->required();
    add_length("--contact-size", request_.contact_size, "Element size on the curved face near the tip")->required();
    add_length("--contact-radius", request_.contact_radius, "Distance from the tip over which elements have that size")
        ->required();
    add_length("--bulk-size", request_.bulk_size,
               "Largest element size within 1.5 contact radii under the tip (default: 3 contact sizes)");
    add_number(options(), "--growth", request_.growth, Range::between(1e-6, 1e6), "",
               "Increase of the element size per distance (default: 0.3)");
    add_length("--gap", request_.gap, "Distance of the tips (default: 1e-6)");
    add_length("--box-width", request_.box_width, "Width of the box in x and y (default: 2.4 radii)");
    add_number(options(), "--rotate", request_.rotation, Range::between(-360, 360), "degrees",
               "Rotation of the upper hemisphere about the axis")
        ->capture_default_str();
    add_required_output(OutputKind::binary);
    add_quiet("No report");
    add_material(material_);
  }

private:
  CLI::Option* add_length(const char* name, double& value, const char* help) {
    return add_number(options(), name, value, positive_length, "mm", help);
  }

  void execute() const override {
    HemisphereRequest request = request_;
    if (request.bulk_size == 0) request.bulk_size = std::min(3 * request.contact_size, request.size);
    Progress progress("pack-gen", quiet());
    progress.update(0, "meshing a hemisphere");
    const Hemispheres pair = mesh_hemispheres(request);
    progress.update(0.8, "measuring");
    const MeshReport report = report_mesh(pair.packing, pair.mesh, request.size, material_, available_cores());
    const PackingOrigin origin{
        {},
        fmt::format("hemispheres of radius {:g} mm, {:g} mm at the contact", request.radius, request.contact_size),
        {},
        {}};
    write_packing_file(output(), pair.packing, origin,
                       MeshForFile{&pair.mesh, request.size, report.facet_gap.gap, report.smallest_quality, true});
    progress.finish(fmt::format("{} tetrahedra, {}", report.tets, output()));
    if (!quiet()) print(report, pair, request);
  }

  void print(const MeshReport& report, const Hemispheres& pair, const HemisphereRequest& request) const {
    const Refinement detail = refinement(request, pair);
    fmt::print("{} nodes, {} tetrahedra, {} of them in the lower hemisphere, {} near the contact in both; smallest "
               "edge {:.4g} mm; gap {:.4g} mm; smallest quality {:.3f}; critical step {:.4g} s = {:.3f} contact "
               "size/wave speed, median {:.4g} s\n",
               report.nodes, report.tets, pair.mesh.grain_tet_offset[1], detail.tets_near, detail.smallest_edge,
               pair.tip_gap, report.smallest_quality, report.smallest_step,
               report.smallest_step * material_.wave_speed() / request.contact_size, report.median_step);
  }

  HemisphereRequest request_;
  StepMaterial material_;
};

} // namespace

std::unique_ptr<Command> hemispheres_command(CLI::App& app) {
  return std::make_unique<HemispheresCommand>(app);
}

} // namespace mpfem
