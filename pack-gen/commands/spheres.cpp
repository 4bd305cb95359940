// spheres: a packing as a TOML file describes it.

#include <filesystem>

#include "common/physical_ranges.hpp"
#include "common/progress.hpp"
#include "common/table_reader.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/commands/commands.hpp"
#include "pack-gen/packing_description.hpp"
#include "pack-gen/sphere_file.hpp"
#include "pack-gen/sphere_order.hpp"

namespace mpfem {

namespace {

class SpheresCommand : public FileCommand {
public:
  explicit SpheresCommand(CLI::App& app)
      : FileCommand(
            app, "spheres",
            "Pack spheres as described in a TOML file.\n"
            "Example: pack-gen spheres powder.toml -o spheres.h5\n"
            "         pack-gen spheres powder.toml --container cylinder --diameter 1 --height 1.2 -o spheres.h5",
            "Description of the packing (TOML)") {
    add_required_output(OutputKind::binary);
    add_number(options(), "--seed", seed_, seed_numbers, "", "Seed, instead of the one in the description");
    add_container(container_, "the description's, else a box");
    add_assignments(options(), assignments_, "Override a value: KEY=VALUE, e.g. count=400");
  }

private:
  /// The description, overridden by the command line.
  PackingDescription description() const {
    TomlDocument document = TomlDocument::from_file(input());
    for (const std::string& assignment : assignments_) document.set(assignment);
    if (seed_) document.set(fmt::format("seed={}", *seed_));
    const ContainerOptions& c = container_;
    if (!c.container.empty()) document.set(fmt::format("container={}", c.container));
    if (c.diameter) document.set(fmt::format("diameter={}", *c.diameter));
    if (c.height) document.set(fmt::format("height={}", *c.height));
    if (!c.surface.empty()) document.set(fmt::format("surface_file={}", std::filesystem::absolute(c.surface).string()));
    if (c.scale) document.set(fmt::format("surface_scale={}", *c.scale));
    return read_packing_description(document, !c.container.empty() && c.container != "box");
  }

  void execute() const override {
    const PackingDescription wanted = description();
    refuse_overwriting_any(wanted.files);
    const DrawnSizes sizes = draw_sizes(wanted);
    Progress progress("pack-gen", quiet());
    const SpherePacking packing = numbered(naming_file(input(), [&] {
      return pack_spheres({.box = wanted.container.lengths,
                           .shape = wanted.container.shape,
                           .surface = wanted.container.surface,
                           .radius = sizes.radius,
                           .smallest_gap = wanted.smallest_gap,
                           .seed = wanted.seed,
                           .progress = [&](const std::string& state) { progress.update(state); }});
    }));
    PackingOrigin origin{static_cast<std::int64_t>(wanted.seed), wanted.text, {}, {}};
    tabulate_target(*wanted.distribution, sizes.scale, origin);
    write_packing_file(output(), packing, origin);
    progress.finish(fmt::format(
        "{} spheres, relative density {:.6f}, smallest gap {:.4g} mm, sizes scaled by {:.5f}, {}",
        packing.radius.size(), relative_density(packing), smallest_gap(packing).gap, sizes.scale, output()));
  }

  std::optional<std::int64_t> seed_;
  ContainerOptions container_;
  std::vector<std::string> assignments_;
};

} // namespace

std::unique_ptr<Command> spheres_command(CLI::App& app) {
  return std::make_unique<SpheresCommand>(app);
}

} // namespace mpfem
