#include "solver/model/check_packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "solver/parallel/agree.hpp"

namespace mpfem {

using Index = std::int32_t;

namespace {

void check_array_sizes(const MeshedPacking& packing, const std::string& name) {
  const auto nodes = static_cast<Index>(packing.node.size() / 3);
  const auto tets = static_cast<Index>(packing.tet.size() / 4);
  for (const double length : packing.box_lengths)
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(fmt::format("{}: /box/lengths holds {}, allowed: > 0", name, length));
  const auto& no = packing.grain_node_offset;
  const auto& to = packing.grain_tet_offset;
  if (no.size() < 2 || no.size() != to.size() || no.front() != 0 || to.front() != 0 || no.back() != nodes ||
      to.back() != tets || !std::is_sorted(no.begin(), no.end()) || !std::is_sorted(to.begin(), to.end()))
    throw InputError(fmt::format("{}: /mesh/grain_node_offset and /mesh/grain_tet_offset do not divide {} nodes and {} "
                                 "tetrahedra among the grains",
                                 name, nodes, tets));
  if (!packing.sphere_radius.empty() && (packing.sphere_radius.size() + 1 != no.size() ||
                                         packing.sphere_center.size() != 3 * packing.sphere_radius.size()))
    throw InputError(
        fmt::format("{}: /spheres/center and /spheres/radius hold {} and {} numbers, allowed: three and one for "
                    "each of {} grains",
                    name, packing.sphere_center.size(), packing.sphere_radius.size(), no.size() - 1));
}

void check_tet(const PackedMesh& mesh, Index tet, std::size_t grain, const std::string& name) {
  for (const Index n : mesh.corners(tet))
    if (n < mesh.first_node || n >= mesh.end_node())
      throw InputError(fmt::format("{}: /mesh/tet row {}: node {} is not one of grain {}, allowed: {} … {}", name, tet,
                                   n, grain, mesh.first_node, mesh.end_node() - 1));
  const double volume = mesh.volume(tet);
  if (!(volume > 0))
    throw InputError(fmt::format("{}: /mesh/tet row {} (grain {}) is inverted or degenerate: volume {:.3g} mm^3, "
                                 "allowed: > 0",
                                 name, tet, grain, volume));
}

/// mm, along the axis in which the nodes of a grain reach farthest.
double largest_extent(const PackedMesh& mesh) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = mesh.node[axis], high = low;
    for (std::size_t i = axis; i < mesh.node.size(); i += 3)
      low = std::min(low, mesh.node[i]), high = std::max(high, mesh.node[i]);
    largest = std::max(largest, high - low);
  }
  return largest;
}

} // namespace

void check_packing(const MeshedPacking& packing, const std::string& name) {
  if (!packing.ownership) check_array_sizes(packing, name); // else the reader of the file has done so
  for (int grain = 0; grain < packing.grains(); ++grain) {
    if (packing.ownership && !packing.ownership->owns(grain)) continue;
    const auto g = static_cast<std::size_t>(grain);
    const PackedMesh mesh = packing.mesh_of(grain);
    if (mesh.tet.empty())
      throw InputError(fmt::format("{}: grain {} has no tetrahedra, allowed: at least one", name, g));
    for (Index t = mesh.first_tet; t < mesh.end_tet(); ++t) check_tet(mesh, t, g, name);
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
      if (!std::isfinite(mesh.node[i]))
        throw InputError(fmt::format("{}: /mesh/node row {} is not finite, allowed: finite numbers", name,
                                     at(mesh.first_node) + i / 3));
  }
}

void refuse_sizes_beyond_floats(const MeshedPacking& packing, std::span<const Index> grains, const std::string& name) {
  constexpr double least = 1e-4, most = 1e4; // mm
  // Floats are measured from the middle of a grain: an edge of this share of it is known to 3e-5.
  constexpr double least_share = 1e-3;
  for (const Index grain : grains) {
    const PackedMesh mesh = packing.mesh_of(grain);
    const double extent = largest_extent(mesh);
    for (Index t = mesh.first_tet; t < mesh.end_tet(); ++t) {
      const auto corner = mesh.corners(t);
      double longest = 0;
      for (std::size_t c = 1; c < 4; ++c)
        longest = std::max(longest, norm(mesh.point(corner[c]) - mesh.point(corner[0])));
      if (!(longest > least && longest < most))
        throw InputError(fmt::format("{}: tetrahedron {} has an edge of {:.3g} mm, allowed: {:g} … {:g} mm with "
                                     "element.precision = 'mixed'; 'double' has no limit",
                                     name, t, longest, least, most));
      if (longest < least_share * extent)
        throw InputError(fmt::format("{}: tetrahedron {} of {:.3g} mm lies in a grain of {:.3g} mm, allowed: at least "
                                     "{:g} of the grain with element.precision = 'mixed'; 'double' has no limit",
                                     name, t, longest, extent, least_share));
    }
  }
}

namespace {

/// A surface node of a grain.
struct Place {
  std::array<double, 3> x; ///< mm
  std::int64_t grain;
  bool operator<(const Place& other) const { return std::tie(x, grain) < std::tie(other.x, other.grain); }
};

/// The places of surface nodes that this rank compares. With several ranks, a hash of the place says which rank gets
/// it, so that equal places come to the same rank.
std::vector<Place> places_to_compare(const Model& model, const Communicator& ranks) {
  std::vector<Bytes> to(static_cast<std::size_t>(ranks.size()));
  std::vector<Place> places;
  for (const Index g : model.own())
    for (Index n = model.node_offset[at(g)]; n < model.node_offset[at(g)] + model.surface_node_count[at(g)]; ++n) {
      const double* x = &model.position[4 * at(n)];
      const Place place{{x[0] + 0.0, x[1] + 0.0, x[2] + 0.0}, g}; // -0 becomes 0: the hash tells them apart
      if (ranks.alone())
        places.push_back(place);
      else
        append(to[hash_values(std::span<const double>(place.x)) % to.size()], place);
    }
  if (ranks.alone()) return places;
  for (const Bytes& bytes : ranks.exchange(to))
    for (MessageReader reader(bytes); !reader.done();) places.push_back(reader.take<Place>());
  return places;
}

} // namespace

void refuse_shared_places(const Model& model, const std::string& name, const Communicator& ranks) {
  std::vector<Place> places = places_to_compare(model, ranks);
  std::sort(places.begin(), places.end());
  agree(ranks, [&] {
    for (std::size_t i = 1; i < places.size(); ++i)
      if (places[i].x == places[i - 1].x && places[i].grain != places[i - 1].grain)
        throw InputError(fmt::format(
            "{}: grains {} and {} have a node in the same place ({:g}, {:g}, {:g}), allowed: different places", name,
            places[i - 1].grain, places[i].grain, places[i].x[0], places[i].x[1], places[i].x[2]));
  });
}

} // namespace mpfem
