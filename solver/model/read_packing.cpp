#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "results-schema/packing_file.hpp"
#include "solver/model/model.hpp"
#include "solver/parallel/agree.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;
namespace file = schema::packing;

schema::FileReader open_meshed(const std::string& path) {
  schema::FileReader reader(path, schema::FileKind::packing);
  if (!reader.has(file::mesh_tet))
    throw InputError(fmt::format("{}: found spheres without a mesh, allowed: a meshed packing; make it with: pack-gen "
                                 "mesh {} --size MM -o packing.h5",
                                 path, path));
  return reader;
}

void take_spheres(schema::PackingSpheres&& spheres, MeshedPacking& packing) {
  std::copy_n(spheres.box_lengths.begin(), 3, packing.box_lengths.begin());
  packing.sphere_center = std::move(spheres.center);
  packing.sphere_radius = std::move(spheres.radius);
}

/// Owners of grains by the number of tets, which is what the step of a loose grain costs. `point` ([grains * 3], mm): a
/// point of each grain.
std::vector<Index> owners(const std::vector<double>& point, const std::vector<Index>& tet_offset, int ranks) {
  std::vector<std::array<double, 3>> centre(tet_offset.size() - 1);
  std::vector<double> weight(centre.size());
  for (std::size_t g = 0; g < centre.size(); ++g) {
    std::copy_n(&point[3 * g], 3, centre[g].begin());
    weight[g] = tet_offset[g + 1] - tet_offset[g];
  }
  return divide_among_ranks(centre, weight, ranks);
}

/// Where the part of each own grain begins when these parts follow each other.
std::vector<std::size_t> starts_of_own(const Ownership& ownership, const std::vector<Index>& offset) {
  std::vector<std::size_t> start(ownership.owner.size(), 0);
  std::size_t next = 0;
  for (const Index g : ownership.own) {
    start[at(g)] = next;
    next += at(offset[at(g) + 1] - offset[at(g)]);
  }
  return start;
}

/// Reads the rows of own grains of a dataset, one grain after another, and adds all values to `hash`.
template <class Dataset, class T>
void read_own_rows(const schema::FileReader& reader, const Dataset& dataset, const Ownership& ownership,
                   const std::vector<Index>& offset, std::size_t width, StreamingHash& hash, std::vector<T>& rows) {
  std::size_t own = 0; // index of the current grain in ownership.own
  reader.read_in_pieces(dataset, [&](std::size_t first, std::span<const T> values) {
    hash.update(std::as_bytes(values));
    const std::size_t end = first + values.size() / width;
    for (; own < ownership.own.size(); ++own) {
      const std::size_t g = at(ownership.own[own]);
      const std::size_t from = std::max(at(offset[g]), first), to = std::min(at(offset[g + 1]), end);
      if (from < to)
        rows.insert(rows.end(), values.begin() + static_cast<std::ptrdiff_t>(width * (from - first)),
                    values.begin() + static_cast<std::ptrdiff_t>(width * (to - first)));
      if (at(offset[g + 1]) > end) break; // the rest is in the next piece
    }
  });
}

/// The meshes of this rank's grains.
void read_own_meshes(const schema::FileReader& reader, const Communicator& ranks,
                     const std::optional<std::vector<Index>>& owner, MeshedPacking& packing) {
  const schema::PackingOffsets offsets = schema::read_packing_offsets(reader, packing.sphere_radius.size());
  packing.grain_node_offset = offsets.node;
  packing.grain_tet_offset = offsets.tet;
  packing.ownership = ownership_of(
      owner ? *owner : owners(packing.sphere_center, packing.grain_tet_offset, ranks.size()), ranks.rank());
  packing.node_start = starts_of_own(*packing.ownership, offsets.node);
  packing.tet_start = starts_of_own(*packing.ownership, offsets.tet);
  StreamingHash nodes;
  read_own_rows(reader, file::mesh_node, *packing.ownership, offsets.node, 3, nodes, packing.node);
  StreamingHash tets(nodes.value());
  read_own_rows(reader, file::mesh_tet, *packing.ownership, offsets.tet, 4, tets, packing.tet);
  packing.hash = hash_of_mesh(tets.value(), packing);
}

} // namespace

void divide(MeshedPacking& packing, const Communicator& ranks) {
  if (ranks.alone()) return;
  std::vector<double> point; // the first node of each grain
  for (std::size_t g = 0; g < at(packing.grains()); ++g)
    point.insert(point.end(), &packing.node[3 * at(packing.grain_node_offset[g])],
                 &packing.node[3 * at(packing.grain_node_offset[g])] + 3);
  packing.ownership = ownership_of(owners(point, packing.grain_tet_offset, ranks.size()), ranks.rank());
  packing.node_start.assign(packing.grain_node_offset.begin(), packing.grain_node_offset.end() - 1);
  packing.tet_start.assign(packing.grain_tet_offset.begin(), packing.grain_tet_offset.end() - 1);
}

MeshedPacking read_packing(const std::string& path, const Communicator& ranks,
                           const std::optional<std::vector<Index>>& owner) {
  MeshedPacking packing;
  agree(ranks, [&] {
    const schema::FileReader reader = open_meshed(path);
    take_spheres(schema::read_packing_spheres(reader), packing);
    if (reader.has(file::packing_seed)) packing.seed = reader.read_scalar(file::packing_seed);
    if (!ranks.alone()) return read_own_meshes(reader, ranks, owner, packing);
    schema::PackingTets mesh = schema::read_packing_tets(reader, packing.sphere_radius.size());
    packing.node = std::move(mesh.node);
    packing.tet = std::move(mesh.tet);
    packing.grain_node_offset = std::move(mesh.grain_node_offset);
    packing.grain_tet_offset = std::move(mesh.grain_tet_offset);
  });
  return packing;
}

} // namespace mpfem
