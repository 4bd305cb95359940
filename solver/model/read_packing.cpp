#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "results-schema/descriptors.hpp"
#include "results-schema/file.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

MeshedPacking read_packing(const std::string& path) {
  const schema::FileReader reader(path, schema::FileKind::packing);
  if (!reader.has(schema::packing::mesh_tet))
    throw InputError(fmt::format("{}: holds spheres without a mesh; make one with: pack-gen mesh {} --size MM -o "
                                 "packing.h5",
                                 path, path));
  MeshedPacking packing;
  const auto lengths = reader.read(schema::packing::box_lengths);
  std::copy_n(lengths.begin(), 3, packing.box_lengths.begin());
  packing.node = reader.read(schema::packing::mesh_node);
  packing.tet = reader.read(schema::packing::mesh_tet);
  packing.grain_node_offset = reader.read(schema::packing::mesh_grain_node_offset);
  packing.grain_tet_offset = reader.read(schema::packing::mesh_grain_tet_offset);
  packing.sphere_center = reader.read(schema::packing::spheres_center);
  packing.sphere_radius = reader.read(schema::packing::spheres_radius);
  if (reader.has(schema::packing::packing_seed)) packing.seed = reader.read_scalar(schema::packing::packing_seed);
  return packing;
}

} // namespace mpfem
