// export: spheres as a table.

#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/sphere_file.hpp"

namespace mpfem {

namespace {

class ExportCommand : public FileCommand {
public:
  explicit ExportCommand(CLI::App& app)
      : FileCommand(app, "export",
                    "Write spheres to a table x,y,z,radius (mm).\nExample: pack-gen export spheres.h5 -o spheres.csv",
                    "Packing (HDF5), meshed or not") {
    add_required_output(OutputKind::text);
  }

private:
  void execute() const override { export_spheres(output(), read_spheres(input()).packing); }
};

} // namespace

std::unique_ptr<Command> export_command(CLI::App& app) {
  return std::make_unique<ExportCommand>(app);
}

} // namespace mpfem
