#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "results-schema/packing_file.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

MeshedPacking read_packing(const std::string& path) {
  const schema::FileReader reader(path, schema::FileKind::packing);
  if (!reader.has(schema::packing::mesh_tet))
    throw InputError(fmt::format("{}: holds spheres without a mesh; make one with: pack-gen mesh {} --size MM -o "
                                 "packing.h5",
                                 path, path));
  schema::PackingSpheres spheres = schema::read_packing_spheres(reader);
  schema::PackingTets mesh = schema::read_packing_tets(reader, spheres.radius.size());
  MeshedPacking packing;
  std::copy_n(spheres.box_lengths.begin(), 3, packing.box_lengths.begin());
  packing.node = std::move(mesh.node);
  packing.tet = std::move(mesh.tet);
  packing.grain_node_offset = std::move(mesh.grain_node_offset);
  packing.grain_tet_offset = std::move(mesh.grain_tet_offset);
  packing.sphere_center = std::move(spheres.center);
  packing.sphere_radius = std::move(spheres.radius);
  if (reader.has(schema::packing::packing_seed)) packing.seed = reader.read_scalar(schema::packing::packing_seed);
  return packing;
}

} // namespace mpfem
