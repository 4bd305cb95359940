// settle: spheres that have sunk until they rest.

#include <algorithm>

#include "common/progress.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/settle.hpp"
#include "pack-gen/sphere_file.hpp"
#include "pack-gen/sphere_import.hpp"

namespace mpfem {

namespace {

class SettleCommand : public FileCommand {
public:
  explicit SettleCommand(CLI::App& app)
      : FileCommand(app, "settle",
                    "Let spheres sink under their weight, along -z and without friction, until they rest "
                    "on each other, the bottom and the walls. A box or cylinder is open above.\n"
                    "Example: pack-gen settle spheres.h5 --fit-height -o settled.h5",
                    "Spheres (HDF5)") {
    add_required_output(OutputKind::binary);
    add_number(options(), "--gap", gap_, Range::between(0, 1e9), "mm",
               "Smallest gap to keep between spheres and to the walls (default: the gap of the file)");
    options().add_flag("--fit-height", fit_height_,
                       "Lower or raise the box or cylinder to the bed (default: it stays, with free space above)");
  }

private:
  void execute() const override {
    const SphereFile file = read_spheres(input());
    refuse_overlap(file.packing, input());
    Progress progress("pack-gen", quiet());
    const double gap = gap_.value_or(std::max(smallest_gap(file.packing).gap, 0.0));
    const auto settled = naming_file(input(), [&] {
      return settle(file.packing, {.smallest_gap = gap,
                                   .fit_height = fit_height_,
                                   .progress = [&](const std::string& state) { progress.update(state); }});
    });
    write_packing_file(output(), settled.packing, file.origin);
    SpherePacking bed = settled.packing;
    bed.box[2] = settled.bed_height + gap;
    progress.finish(fmt::format(
        "{} spheres at rest, height of the bed {:.4g} mm, relative density {:.6f}, smallest gap {:.4g} mm, {}",
        bed.radius.size(), settled.bed_height, relative_density(bed), smallest_gap(settled.packing).gap, output()));
  }

  std::optional<double> gap_; ///< mm
  bool fit_height_ = false;
};

} // namespace

std::unique_ptr<Command> settle_command(CLI::App& app) {
  return std::make_unique<SettleCommand>(app);
}

} // namespace mpfem
