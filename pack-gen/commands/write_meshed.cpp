#include "pack-gen/commands/write_meshed.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "common/progress.hpp"
#include "pack-gen/commands/command.hpp"
#include "pack-gen/mesh_report.hpp"

namespace mpfem {

void write_meshed(const MeshingOptions& options, const SpherePacking& packing, const PackingOrigin& origin) {
  Progress progress("pack-gen", options.quiet);
  const PackingMesh mesh = naming_file(options.input, [&] {
    return mesh_packing(
        packing, {.nominal_size = options.size,
                  .seed = static_cast<std::uint64_t>(options.seed),
                  .threads = options.threads,
                  .optimise = options.optimise,
                  .memory = available_memory(),
                  .progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); }});
  });
  const MeshReport report = report_mesh(packing, mesh, options.size, options.material, options.threads);
  if (!(report.facet_gap.gap > 0))
    throw SimulationError(fmt::format("{}: no positive gap could be proven between the facets of grain {} and {}",
                                      options.input, report.facet_gap.first, neighbour_name(report.facet_gap.second)));
  write_packing_file(options.output, packing, origin,
                     MeshForFile{&mesh, options.size, report.facet_gap.gap, report.smallest_quality});
  progress.finish(fmt::format("{} tetrahedra, {}", report.tets, options.output));
  if (options.quiet) return;
  for (const std::string& note : mesh.notes) fmt::print(stderr, "pack-gen: note: {}\n", note);
  fmt::print("{}", report_text(report));
}

} // namespace mpfem
