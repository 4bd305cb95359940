// quality: what a mesh is like.

#include "common/table_reader.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/mesh_report.hpp"
#include "pack-gen/packing_description.hpp"
#include "pack-gen/packing_quality.hpp"
#include "pack-gen/sphere_file.hpp"

namespace mpfem {

namespace {

class QualityCommand : public FileCommand {
public:
  explicit QualityCommand(CLI::App& app)
      : FileCommand(app, "quality",
                    "Report the quality of a mesh: volumes, shapes, gaps and critical time "
                    "step.\nExample: pack-gen quality packing.h5",
                    "Meshed packing (HDF5)") {
    add_optional_output("JSON file to write: the report's numbers by name");
    add_input("--description", description_,
              "Description of the packing (TOML); the report then compares the sizes of the grains with it");
    add_output("--sizes", sizes_, "CSV file to write: diameters with their cumulative fraction", OutputKind::text);
    add_output("--target", target_, "CSV file to write: the size table of --description", OutputKind::text)
        ->needs("--description");
    add_threads(threads_);
    add_material(material_);
  }

private:
  /// A defect that would be a failure of the mesher is here a mistake in the file.
  MeshReport report_of(const SpherePacking& packing) const {
    const MeshFromFile mesh = read_mesh(input());
    try {
      return report_mesh(packing, mesh.mesh, mesh.nominal_size, material_, threads_);
    } catch (const SimulationError& error) {
      throw InputError(fmt::format("{}: {}, allowed: closed grains of tetrahedra with positive volume",
                                   one_line(input()), error.what()));
    }
  }

  void execute() const override {
    const SphereFile file = read_spheres(input());
    const MeshReport report = report_of(file.packing);
    std::optional<PackingDescription> wanted;
    if (!description_.empty()) {
      wanted = read_packing_description(TomlDocument::from_file(description_));
      refuse_overwriting_any(wanted->files);
      if (!target_.empty()) write_file(target_, target_csv(*wanted));
    }
    if (!sizes_.empty()) write_file(sizes_, sizes_csv(file.packing));
    if (!output().empty()) write_file(output(), quality_json(file.packing, report, wanted ? &*wanted : nullptr));
    if (!quiet()) fmt::print("{}", report_text(report));
  }

  std::string description_, sizes_, target_;
  int threads_ = 1;
  StepMaterial material_;
};

} // namespace

std::unique_ptr<Command> quality_command(CLI::App& app) {
  return std::make_unique<QualityCommand>(app);
}

} // namespace mpfem
