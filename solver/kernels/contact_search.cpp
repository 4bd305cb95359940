#include "solver/kernels/contact_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/index.hpp"
#include "solver/physics/gap.hpp"

// Three sieves, each of which passes everything that could be near: boxes of grains in a grid, boxes of facets
// against a grid of the other grain's nodes, and the exact distance. What a sieve passes needlessly only costs time.

namespace mpfem {

namespace {

struct Box : Bounds {
  Box()
      : Bounds{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                std::numeric_limits<double>::infinity()},
               {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity()}} {}
  explicit Box(const Bounds& bounds) : Bounds(bounds) {}

  void add(const double* x) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  }
  Box grown(double margin) const {
    Box box = *this;
    for (std::size_t k = 0; k < 3; ++k) box.low[k] -= margin, box.high[k] += margin;
    return box;
  }
  bool contains(const double* x) const {
    return x[0] >= low[0] && x[0] <= high[0] && x[1] >= low[1] && x[1] <= high[1] && x[2] >= low[2] && x[2] <= high[2];
  }
  bool meets(const Bounds& other) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (low[k] > other.high[k] || high[k] < other.low[k]) return false;
    return true;
  }
};

const double* node_row(const SurfaceView& surface, std::int32_t node) {
  return surface.position.data() + 4 * at(node);
}

Box facet_box(const SurfaceView& surface, std::int32_t facet) {
  Box box;
  for (std::size_t c = 0; c < 3; ++c) box.add(node_row(surface, surface.facet[3 * at(facet) + c]));
  return box;
}

/// A little more than the margin, so that rounding in the sieves cannot lose a node at exactly the margin.
double safe(double margin) {
  return margin * (1 + 1e-9);
}

/// A grid of cells over all grains. A grain is listed in every cell that its box meets.
class GrainGrid {
public:
  explicit GrainGrid(std::span<const Bounds> bounds) : bounds_(bounds) {
    Box all;
    std::vector<double> extents;
    for (const Bounds& box : bounds) {
      all.add(box.low.data()), all.add(box.high.data());
      const double extent = std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
      extents.push_back(std::isfinite(extent) ? extent : 0.0);
    }
    const auto middle = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2);
    std::nth_element(extents.begin(), middle, extents.end());
    low_ = all.low;
    // Cells as large as a typical grain; larger if grains have flown far apart, so that there are only some per grain.
    const double most = std::max(2.0, 2 * std::cbrt(static_cast<double>(bounds.size())));
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = all.high[k] - all.low[k], wanted = length / *middle;
      cells_[k] = wanted > 1 ? static_cast<int>(std::min(wanted, most)) : 1;
      inverse_size_[k] = length > 0 ? cells_[k] / length : 0.0;
    }
    fill();
  }
  /// Calls visit(grain) for every grain of the cells that a box meets; a grain may be visited more than once.
  template <class Visit>
  void in(const Bounds& box, Visit visit) const {
    for_each_cell(box, [&](std::size_t cell) {
      for (std::size_t i = offset_[cell]; i < offset_[cell + 1]; ++i) visit(grain_[i]);
    });
  }

private:
  /// Returns the first cell for NaN.
  int coordinate(double x, std::size_t k) const {
    const double place = (x - low_[k]) * inverse_size_[k];
    return place > 0 ? static_cast<int>(std::min(place, static_cast<double>(cells_[k] - 1))) : 0;
  }
  template <class Visit>
  void for_each_cell(const Bounds& box, Visit visit) const {
    std::array<int, 3> from{}, to{};
    for (std::size_t k = 0; k < 3; ++k) from[k] = coordinate(box.low[k], k), to[k] = coordinate(box.high[k], k);
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x)
          visit(static_cast<std::size_t>(x) +
                static_cast<std::size_t>(cells_[0]) *
                    (static_cast<std::size_t>(y) + static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(z)));
  }
  void fill() {
    offset_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                           static_cast<std::size_t>(cells_[2]) +
                       1,
                   0);
    for (const Bounds& box : bounds_) for_each_cell(box, [&](std::size_t cell) { ++offset_[cell + 1]; });
    for (std::size_t cell = 1; cell < offset_.size(); ++cell) offset_[cell] += offset_[cell - 1];
    grain_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (std::size_t g = 0; g < bounds_.size(); ++g)
      for_each_cell(bounds_[g], [&](std::size_t cell) { grain_[next[cell]++] = static_cast<std::int32_t>(g); });
  }

  std::span<const Bounds> bounds_;
  std::array<double, 3> low_{}, inverse_size_{};
  std::array<int, 3> cells_{1, 1, 1};
  std::vector<std::size_t> offset_; ///< [cells + 1]
  std::vector<std::int32_t> grain_;
};

/// Nodes of one grain inside a region, sorted into a grid of cells.
struct NodeGrid {
  Box region;
  std::array<int, 3> cells{1, 1, 1};
  std::array<double, 3> inverse_size{};
  std::vector<std::int32_t> node, offset, sorted, cell_of, next;

  int coordinate(double x, std::size_t k) const {
    return std::clamp(static_cast<int>((x - region.low[k]) * inverse_size[k]), 0, cells[k] - 1);
  }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells[0]) +
           static_cast<std::size_t>(x);
  }
  /// `cell` in mm; at most 30 cells along each axis.
  void fill(const SurfaceView& surface, double cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = std::max(region.high[k] - region.low[k], 0.0);
      cells[k] = static_cast<int>(std::clamp(length / cell, 1.0, 30.0));
      inverse_size[k] = length > 0 ? cells[k] / length : 0.0;
    }
    offset.assign(
        index(0, 0, cells[2] - 1) + static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) + 1, 0);
    cell_of.resize(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double* x = node_row(surface, node[i]);
      const std::size_t c = index(coordinate(x[0], 0), coordinate(x[1], 1), coordinate(x[2], 2));
      cell_of[i] = static_cast<std::int32_t>(c);
      ++offset[c + 1];
    }
    for (std::size_t c = 1; c < offset.size(); ++c) offset[c] += offset[c - 1];
    sorted.resize(node.size());
    next.assign(offset.begin(), offset.end() - 1);
    for (std::size_t i = 0; i < node.size(); ++i) sorted[at(next[at(cell_of[i])]++)] = node[i];
  }
  /// Calls visit(node) for all nodes in the cells that a box meets.
  template <class Visit>
  void in(const Box& box, Visit visit) const {
    if (!region.meets(box)) return;
    const std::array<int, 3> from{coordinate(box.low[0], 0), coordinate(box.low[1], 1), coordinate(box.low[2], 2)};
    const std::array<int, 3> to{coordinate(box.high[0], 0), coordinate(box.high[1], 1), coordinate(box.high[2], 2)};
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y) {
        const auto first = offset[index(from[0], y, z)], last = offset[index(to[0], y, z) + 1];
        for (std::int32_t i = first; i < last; ++i) visit(sorted[at(i)]);
      }
  }
};

using NodeFacet = std::pair<std::int32_t, std::int32_t>;

/// All combinations of the first grain's nodes with the second grain's facets within the margin, by node, then facet.
void near_points(const SurfaceView& surface, std::int32_t first, std::int32_t second, std::span<const Bounds> bounds,
                 double margin, NodeGrid& grid, std::vector<NodeFacet>& found) {
  found.clear();
  const Box reach = Box(bounds[at(second)]).grown(safe(margin)), own = Box(bounds[at(first)]).grown(safe(margin));
  grid.node.clear();
  grid.region = Box{};
  for (std::int32_t n = surface.node_offset[at(first)];
       n < surface.node_offset[at(first)] + surface.surface_node_count[at(first)]; ++n)
    if (const double* x = node_row(surface, n); reach.contains(x)) {
      grid.node.push_back(n);
      grid.region.add(x);
    }
  if (grid.node.empty()) return;

  // Cells about as large as the boxes that are looked up: the mean facet box of the second grain.
  const Bounds& other = bounds[at(second)];
  const auto facets = static_cast<double>(surface.facet_offset[at(second) + 1] - surface.facet_offset[at(second)]);
  const double extent =
      std::max({other.high[0] - other.low[0], other.high[1] - other.low[1], other.high[2] - other.low[2]});
  grid.fill(surface, std::max(2 * extent / std::sqrt(facets) + margin, 1e-300));

  for (std::int32_t f = surface.facet_offset[at(second)]; f < surface.facet_offset[at(second) + 1]; ++f) {
    const Box around = facet_box(surface, f).grown(safe(margin));
    if (!around.meets(own) || !around.meets(grid.region)) continue;
    Vector3<double> x[3];
    for (std::size_t c = 0; c < 3; ++c) x[c] = vector_of(node_row(surface, surface.facet[3 * at(f) + c]));
    grid.in(around, [&](std::int32_t n) {
      const double* row = node_row(surface, n);
      if (!around.contains(row)) return;
      const Vector3<double> p = vector_of(row);
      if (norm(p - closest_point_on_triangle(p, x).point) <= margin) found.emplace_back(n, f);
    });
  }
  std::sort(found.begin(), found.end());
}

} // namespace

void index_pairs(ContactCandidates& candidates, int grains) {
  const std::size_t pairs = candidates.pair_first.size();
  const auto offsets = [&](const std::vector<std::int32_t>& grain_of) {
    std::vector<std::int32_t> offset(static_cast<std::size_t>(grains) + 1, 0);
    for (const std::int32_t g : grain_of) ++offset[at(g) + 1];
    for (std::size_t g = 1; g < offset.size(); ++g) offset[g] += offset[g - 1];
    return offset;
  };
  candidates.outgoing_offset = offsets(candidates.pair_first);
  candidates.incoming_offset = offsets(candidates.pair_second);
  candidates.incoming_pair.resize(pairs);
  std::vector<std::int32_t> next(candidates.incoming_offset);
  for (std::size_t p = 0; p < pairs; ++p)
    candidates.incoming_pair[at(next[at(candidates.pair_second[p])]++)] = static_cast<std::int32_t>(p);
}

NearGrains find_near_grains(std::span<const Bounds> bounds, double margin, std::vector<std::int32_t> grains) {
  const GrainGrid grid(bounds);
  NearGrains near;
  near.grain = std::move(grains);
  for (const std::int32_t g : near.grain) {
    std::vector<std::int32_t>& others = near.other.emplace_back();
    const Box grown = Box(bounds[at(g)]).grown(safe(margin));
    grid.in(grown, [&](std::int32_t other) {
      if (other != g && grown.meets(bounds[at(other)])) others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  return near;
}

std::int32_t offset_after(const std::vector<std::int32_t>& list) {
  if (list.size() > std::numeric_limits<std::int32_t>::max())
    throw SimulationError(
        fmt::format("contact: found more than {} candidate facets in one process, allowed: fewer; use "
                    "more processes (docs/cluster.md) or a coarser mesh",
                    std::numeric_limits<std::int32_t>::max()));
  return static_cast<std::int32_t>(list.size());
}

ContactCandidates find_contact_candidates(const SurfaceView& surface, double margin, ThreadTeam& team) {
  const auto grains = static_cast<std::int32_t>(surface.node_offset.size()) - 1;
  std::vector<Bounds> bounds(at(grains));
  std::vector<std::int32_t> all(at(grains));
  for (std::int32_t g = 0; g < grains; ++g) {
    Box box;
    for (std::int32_t n = surface.node_offset[at(g)];
         n < surface.node_offset[at(g)] + surface.surface_node_count[at(g)]; ++n)
      box.add(node_row(surface, n));
    bounds[at(g)] = box;
    all[at(g)] = g;
  }
  return find_contact_candidates(surface, margin, bounds, find_near_grains(bounds, margin, std::move(all)), team);
}

ContactCandidates find_contact_candidates(const SurfaceView& surface, double margin, std::span<const Bounds> bounds,
                                          const NearGrains& near, ThreadTeam& team) {
  struct Found {
    std::int32_t second;
    std::vector<NodeFacet> points;
  };
  struct Scratch {
    NodeGrid grid;
    std::vector<NodeFacet> points;
  };
  std::vector<std::vector<Found>> found(near.grain.size());
  std::vector<Scratch> scratch(static_cast<std::size_t>(team.size()));
  team.for_each(static_cast<int>(near.grain.size()), [&](int i, int thread) {
    Scratch& own = scratch[at(thread)];
    for (const std::int32_t other : near.other[at(i)]) {
      near_points(surface, near.grain[at(i)], other, bounds, margin, own.grid, own.points);
      if (!own.points.empty()) found[at(i)].push_back({other, own.points});
    }
  });

  // Joined in the grains' order, so that the result does not depend on which thread found what.
  ContactCandidates result;
  result.pair_point_offset.push_back(0);
  result.point_facet_offset.push_back(0);
  for (std::size_t first = 0; first < found.size(); ++first)
    for (const Found& pair : found[first]) {
      result.pair_first.push_back(near.grain[first]);
      result.pair_second.push_back(pair.second);
      for (std::size_t i = 0; i < pair.points.size(); ++i) {
        const auto [node, facet] = pair.points[i];
        if (i == 0 || pair.points[i - 1].first != node) {
          if (i > 0) result.point_facet_offset.push_back(offset_after(result.point_facet));
          result.point_node.push_back(node);
        }
        result.point_facet.push_back(facet);
      }
      result.point_facet_offset.push_back(offset_after(result.point_facet));
      result.pair_point_offset.push_back(offset_after(result.point_node));
    }
  index_pairs(result, static_cast<int>(surface.node_offset.size()) - 1);
  return result;
}

} // namespace mpfem
