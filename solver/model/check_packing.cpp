#include "solver/model/check_packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/model/packing_geometry.hpp"

namespace mpfem {

using Index = std::int32_t;

namespace {

void check_array_sizes(const MeshedPacking& packing, const std::string& name) {
  const auto nodes = static_cast<Index>(packing.node.size() / 3);
  const auto tets = static_cast<Index>(packing.tet.size() / 4);
  for (const double length : packing.box_lengths)
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(fmt::format("{}: /box/lengths holds {}, allowed > 0", name, length));
  const auto& no = packing.grain_node_offset;
  const auto& to = packing.grain_tet_offset;
  if (no.size() < 2 || no.size() != to.size() || no.front() != 0 || to.front() != 0 || no.back() != nodes ||
      to.back() != tets || !std::is_sorted(no.begin(), no.end()) || !std::is_sorted(to.begin(), to.end()))
    throw InputError(fmt::format("{}: /mesh/grain_node_offset and /mesh/grain_tet_offset do not divide {} nodes and {} "
                                 "tets into grains",
                                 name, nodes, tets));
  if (!packing.sphere_radius.empty() && (packing.sphere_radius.size() + 1 != no.size() ||
                                         packing.sphere_center.size() != 3 * packing.sphere_radius.size()))
    throw InputError(
        fmt::format("{}: /spheres/center and /spheres/radius hold {} and {} numbers, allowed three and one for "
                    "each of {} grains",
                    name, packing.sphere_center.size(), packing.sphere_radius.size(), no.size() - 1));
}

void check_tet(const MeshedPacking& packing, Index tet, std::size_t grain, const std::string& name) {
  const Index first = packing.grain_node_offset[grain], end = packing.grain_node_offset[grain + 1];
  for (std::size_t i = 0; i < 4; ++i) {
    const Index n = packing.tet[4 * at(tet) + i];
    if (n < first || n >= end)
      throw InputError(fmt::format("{}: /mesh/tet row {}: node {} is not one of grain {} (allowed {} … {})", name, tet,
                                   n, grain, first, end - 1));
  }
  const double volume = tet_volume(packing, tet);
  if (!(volume > 0))
    throw InputError(fmt::format("{}: /mesh/tet row {} (grain {}) is inverted or degenerate: volume {:.3g} mm^3, "
                                 "allowed > 0",
                                 name, tet, grain, volume));
}

} // namespace

void check_packing(const MeshedPacking& packing, const std::string& name) {
  check_array_sizes(packing, name);
  const auto& offset = packing.grain_tet_offset;
  for (std::size_t g = 0; g + 1 < offset.size(); ++g) {
    if (offset[g + 1] == offset[g]) throw InputError(fmt::format("{}: grain {} has no tetrahedra", name, g));
    for (Index t = offset[g]; t < offset[g + 1]; ++t) check_tet(packing, t, g, name);
  }
  const auto nodes = static_cast<Index>(packing.node.size() / 3);
  for (Index i = 0; i < nodes; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = packing.node[3 * at(i) + axis];
      if (!std::isfinite(x)) throw InputError(fmt::format("{}: /mesh/node row {} is not finite", name, i));
    }
}

void refuse_sizes_beyond_floats(const MeshedPacking& packing, const std::string& name) {
  constexpr double least = 1e-4, most = 1e4; // mm
  for (std::size_t t = 0; t < packing.tet.size() / 4; ++t) {
    double longest = 0;
    const auto x0 = point(packing.node, packing.tet[4 * t]);
    for (std::size_t c = 1; c < 4; ++c)
      longest = std::max(longest, norm(point(packing.node, packing.tet[4 * t + c]) - x0));
    if (!(longest > least && longest < most))
      throw InputError(
          fmt::format("{}: tet {} has an edge of {:.3g} mm; element.precision = 'mixed' takes {:g} … {:g} mm, "
                      "'double' any",
                      name, t, longest, least, most));
  }
}

void refuse_shared_places(const Model& model, const std::string& name) {
  struct Place {
    std::array<double, 3> x;
    int grain;
    bool operator<(const Place& other) const { return std::tie(x, grain) < std::tie(other.x, other.grain); }
  };
  std::vector<Place> places;
  for (int g = 0; g < model.grains; ++g) {
    const auto gs = static_cast<std::size_t>(g);
    for (Index n = model.node_offset[gs]; n < model.node_offset[gs] + model.surface_node_count[gs]; ++n)
      places.push_back({{model.position[4 * at(n)], model.position[4 * at(n) + 1], model.position[4 * at(n) + 2]}, g});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].x == places[i - 1].x && places[i].grain != places[i - 1].grain)
      throw InputError(
          fmt::format("{}: grains {} and {} have a node in the same place ({:g}, {:g}, {:g}), allowed grains apart",
                      name, places[i - 1].grain, places[i].grain, places[i].x[0], places[i].x[1], places[i].x[2]));
}

} // namespace mpfem
