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

/// A grid of cells over some grains. A grain is listed in every cell that its box meets.
class GrainGrid {
public:
  /// `bounds` [grains of the packing]; `grains`: those in the grid, at least one.
  GrainGrid(std::span<const Bounds> bounds, std::span<const std::int32_t> grains) : bounds_(bounds) {
    Box all;
    std::vector<double> extents;
    for (const std::int32_t grain : grains) {
      const Bounds& box = bounds[at(grain)];
      all.add(box.low.data()), all.add(box.high.data());
      const double extent = std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
      extents.push_back(std::isfinite(extent) ? extent : 0.0);
    }
    const auto middle = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2);
    std::nth_element(extents.begin(), middle, extents.end());
    low_ = all.low;
    // Cells as large as a typical grain; larger if grains have flown far apart, so that there are only some per grain.
    const double most = std::max(2.0, 2 * std::cbrt(static_cast<double>(grains.size())));
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = all.high[k] - all.low[k], wanted = length / *middle;
      cells_[k] = wanted > 1 ? static_cast<int>(std::min(wanted, most)) : 1;
      inverse_size_[k] = length > 0 ? cells_[k] / length : 0.0;
    }
    fill(grains);
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
  void fill(std::span<const std::int32_t> grains) {
    offset_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                           static_cast<std::size_t>(cells_[2]) +
                       1,
                   0);
    for (const std::int32_t g : grains) for_each_cell(bounds_[at(g)], [&](std::size_t cell) { ++offset_[cell + 1]; });
    for (std::size_t cell = 1; cell < offset_.size(); ++cell) offset_[cell] += offset_[cell - 1];
    grain_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (const std::int32_t g : grains)
      for_each_cell(bounds_[at(g)], [&](std::size_t cell) { grain_[next[cell]++] = g; });
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
    return static_cast<int>(std::clamp((x - region.low[k]) * inverse_size[k], 0.0, static_cast<double>(cells[k] - 1)));
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

/// Boxes of the facets of one grain, grown by the margin: by component, so that many are compared at once.
struct FacetBoxes {
  std::array<std::vector<double>, 3> low, high; ///< [facets]
  std::vector<std::uint8_t> meets;              ///< [facets], of the last region
  double cell = 0;                              ///< mm, about as large as the boxes

  void fill(const SurfaceView& surface, std::int32_t grain, const Bounds& bounds, double margin) {
    const std::int32_t first = surface.facet_offset[at(grain)];
    const auto facets = at(surface.facet_offset[at(grain) + 1] - first);
    for (std::size_t k = 0; k < 3; ++k) low[k].resize(facets), high[k].resize(facets);
    meets.resize(facets);
    for (std::size_t f = 0; f < facets; ++f) {
      const Box box = facet_box(surface, first + static_cast<std::int32_t>(f)).grown(safe(margin));
      for (std::size_t k = 0; k < 3; ++k) low[k][f] = box.low[k], high[k][f] = box.high[k];
    }
    const double extent =
        std::max({bounds.high[0] - bounds.low[0], bounds.high[1] - bounds.low[1], bounds.high[2] - bounds.low[2]});
    cell = std::max(2 * extent / std::sqrt(static_cast<double>(facets)) + margin, 1e-300);
  }
  void compare(const Box& region) {
    std::ranges::fill(meets, std::uint8_t{1});
    for (std::size_t k = 0; k < 3; ++k) {
      const double *const low_k = low[k].data(), *const high_k = high[k].data();
      const double region_low = region.low[k], region_high = region.high[k];
      std::uint8_t* const flag = meets.data();
      for (std::size_t f = 0; f < meets.size(); ++f)
        flag[f] &= static_cast<std::uint8_t>(static_cast<int>(low_k[f] <= region_high) &
                                             static_cast<int>(high_k[f] >= region_low));
    }
  }
  Box box(std::size_t f) const {
    return Box(Bounds{{low[0][f], low[1][f], low[2][f]}, {high[0][f], high[1][f], high[2][f]}});
  }
};

using NodeFacet = std::pair<std::int32_t, std::int32_t>;

/// What a thread needs to search.
struct Scratch {
  FacetBoxes boxes;
  NodeGrid grid;
  std::vector<NodeFacet> found;
};

/// All combinations of the first grain's nodes with the second grain's facets within the margin, by node, then facet.
/// `scratch.boxes` are those of the second grain, whose bounds are `bounds`.
std::vector<NodeFacet> near_points(const SurfaceView& surface, std::int32_t first, std::int32_t second,
                                   const Bounds& bounds, double margin, Scratch& scratch) {
  auto& [boxes, grid, found] = scratch;
  const Box reach = Box(bounds).grown(safe(margin));
  grid.node.clear();
  grid.region = Box{};
  for (std::int32_t n = surface.node_offset[at(first)];
       n < surface.node_offset[at(first)] + surface.surface_node_count[at(first)]; ++n)
    if (const double* x = node_row(surface, n); reach.contains(x)) {
      grid.node.push_back(n);
      grid.region.add(x);
    }
  if (grid.node.empty()) return {};
  grid.fill(surface, boxes.cell);

  found.clear();
  boxes.compare(grid.region);
  for (std::size_t i = 0; i < boxes.meets.size(); ++i) {
    if (boxes.meets[i] == 0) continue;
    const std::int32_t f = surface.facet_offset[at(second)] + static_cast<std::int32_t>(i);
    const Box around = boxes.box(i);
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
  return found;
}

/// Grains whose boxes meet that of `grains` together, grown by the margin. A rank thus sorts those near its own only.
std::vector<std::int32_t> grains_around(std::span<const Bounds> bounds, double margin,
                                        std::span<const std::int32_t> grains) {
  Box together;
  for (const std::int32_t g : grains) together.add(bounds[at(g)].low.data()), together.add(bounds[at(g)].high.data());
  together = together.grown(safe(margin));
  std::vector<std::int32_t> around;
  for (std::size_t g = 0; g < bounds.size(); ++g)
    if (together.meets(bounds[g])) around.push_back(static_cast<std::int32_t>(g));
  return around;
}

/// A pair of grains: the number of the first in a list, and of the second in the list of those near the first.
struct NearPair {
  std::int32_t first, other;
};

/// [grains]: the pairs of each second grain.
std::vector<std::vector<NearPair>> pairs_by_second(const NearGrains& near, std::size_t grains) {
  std::vector<std::vector<NearPair>> pairs(grains);
  for (std::size_t i = 0; i < near.other.size(); ++i)
    for (std::size_t k = 0; k < near.other[i].size(); ++k)
      pairs[at(near.other[i][k])].push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(k)});
  return pairs;
}

/// Throws SimulationError if a list of candidates with so many entries does not fit into 32 bits.
void check_fits(std::size_t entries) {
  if (entries > std::numeric_limits<std::int32_t>::max())
    throw SimulationError(
        fmt::format("contact: found more than {} candidate facets in one process, allowed: fewer; use "
                    "more processes (docs/cluster.md) or a coarser mesh",
                    std::numeric_limits<std::int32_t>::max()));
}

/// Adds a pair and its combinations of nodes and facets, by node, then facet.
void append_pair(std::int32_t second, std::span<const NodeFacet> found, GrainCandidates& list) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [node, facet] = found[i];
    if (i == 0 || found[i - 1].first != node) {
      if (i > 0) list.facet_end.push_back(offset_after(list.facet));
      list.node.push_back(node);
    }
    list.facet.push_back(facet);
  }
  list.facet_end.push_back(offset_after(list.facet));
  list.second.push_back(second);
  list.point_end.push_back(offset_after(list.node));
}

/// Entries of lists of candidates.
struct Counts {
  std::size_t pairs = 0, points = 0, facets = 0;
  std::ptrdiff_t pair() const { return static_cast<std::ptrdiff_t>(pairs); }
  std::ptrdiff_t point() const { return static_cast<std::ptrdiff_t>(points); }
  std::ptrdiff_t facet() const { return static_cast<std::ptrdiff_t>(facets); }
};

/// [lists + 1]: of the lists before each; the last has all. Throws SimulationError if a sum does not fit into 32 bits.
std::vector<Counts> counts_before(std::span<const GrainCandidates> lists) {
  std::vector<Counts> before(lists.size() + 1);
  for (std::size_t i = 0; i < lists.size(); ++i)
    before[i + 1] = {before[i].pairs + lists[i].second.size(), before[i].points + lists[i].node.size(),
                     before[i].facets + lists[i].facet.size()};
  check_fits(before.back().facets);
  check_fits(before.back().points); // can be more: bonds that opened have no facets near
  return before;
}

} // namespace

std::int32_t offset_after(const std::vector<std::int32_t>& list) {
  check_fits(list.size());
  return static_cast<std::int32_t>(list.size());
}

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

NearGrains find_near_grains(std::span<const Bounds> bounds, double margin, std::vector<std::int32_t> grains,
                            ThreadTeam& team) {
  NearGrains near;
  near.grain = std::move(grains);
  near.other.resize(near.grain.size());
  const std::vector<std::int32_t> around = grains_around(bounds, margin, near.grain);
  if (around.empty()) return near;
  const GrainGrid grid(bounds, around);
  team.for_each(static_cast<int>(near.grain.size()), [&](int i, int) {
    const std::int32_t g = near.grain[at(i)];
    std::vector<std::int32_t>& others = near.other[at(i)];
    const Box grown = Box(bounds[at(g)]).grown(safe(margin));
    grid.in(grown, [&](std::int32_t other) {
      if (other != g && grown.meets(bounds[at(other)])) others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  });
  return near;
}

std::vector<GrainCandidates> find_candidates_of_grains(const SurfaceView& surface, double margin,
                                                       std::span<const Bounds> bounds, const NearGrains& near,
                                                       ThreadTeam& team) {
  // By second grain, so that the boxes of its facets are made once for all grains near it.
  const std::vector<std::vector<NearPair>> pairs = pairs_by_second(near, bounds.size());
  std::vector<std::vector<std::vector<NodeFacet>>> found(near.grain.size()); // as near.other
  for (std::size_t i = 0; i < found.size(); ++i) found[i].resize(near.other[i].size());
  std::vector<Scratch> scratch(static_cast<std::size_t>(team.size()));
  team.for_each(static_cast<int>(pairs.size()), [&](int second, int thread) {
    if (pairs[at(second)].empty()) return;
    Scratch& own = scratch[at(thread)];
    own.boxes.fill(surface, second, bounds[at(second)], margin);
    for (const auto [first, other] : pairs[at(second)])
      found[at(first)][at(other)] =
          near_points(surface, near.grain[at(first)], second, bounds[at(second)], margin, own);
  });

  std::vector<GrainCandidates> lists(near.grain.size());
  team.for_each(static_cast<int>(lists.size()), [&](int i, int) {
    for (std::size_t k = 0; k < found[at(i)].size(); ++k)
      if (!found[at(i)][k].empty()) append_pair(near.other[at(i)][k], found[at(i)][k], lists[at(i)]);
    found[at(i)] = {};
  });
  return lists;
}

ContactCandidates join_candidates(std::span<const std::int32_t> firsts, std::span<const GrainCandidates> lists,
                                  int grains, ThreadTeam& team) {
  const std::vector<Counts> before = counts_before(lists);
  const Counts total = before.back();
  ContactCandidates result;
  result.pair_first.resize(total.pairs);
  result.pair_second.resize(total.pairs);
  result.pair_point_offset.resize(total.pairs + 1);
  result.point_node.resize(total.points);
  result.point_facet_offset.resize(total.points + 1);
  result.point_facet.resize(total.facets);
  team.for_each(static_cast<int>(lists.size()), [&](int i, int) {
    const GrainCandidates& list = lists[at(i)];
    const Counts& start = before[at(i)];
    std::fill_n(result.pair_first.begin() + start.pair(), list.second.size(), firsts[at(i)]);
    std::ranges::copy(list.second, result.pair_second.begin() + start.pair());
    std::ranges::copy(list.node, result.point_node.begin() + start.point());
    std::ranges::copy(list.facet, result.point_facet.begin() + start.facet());
    for (std::size_t p = 0; p < list.second.size(); ++p)
      result.pair_point_offset[start.pairs + p + 1] = static_cast<std::int32_t>(start.points) + list.point_end[p];
    for (std::size_t p = 0; p < list.node.size(); ++p)
      result.point_facet_offset[start.points + p + 1] = static_cast<std::int32_t>(start.facets) + list.facet_end[p];
  });
  index_pairs(result, grains);
  return result;
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
  const NearGrains near = find_near_grains(bounds, margin, std::move(all), team);
  return join_candidates(near.grain, find_candidates_of_grains(surface, margin, bounds, near, team), grains, team);
}

} // namespace mpfem
