#pragma once
// Which surface nodes may touch which facets of other grains before the next search.

#include <cstdint>
#include <span>
#include <vector>

#include "solver/kernels/thread_team.hpp"
#include "solver/model/surface_view.hpp"

namespace mpfem {

/// Candidate contact points. A contact point is a surface node of one grain and an opposing grain; it carries the
/// facets of that grain that the node may meet. Points are grouped by ordered grain pair (first: the node's grain,
/// second: the facets' grain), pairs sorted by first, then second; points of a pair by node; facets of a point
/// ascending.
struct ContactCandidates {
  std::vector<std::int32_t> pair_first;         ///< [pairs]
  std::vector<std::int32_t> pair_second;        ///< [pairs]
  std::vector<std::int32_t> pair_point_offset;  ///< [pairs + 1]
  std::vector<std::int32_t> outgoing_offset;    ///< [grains + 1]: pairs whose first is g
  std::vector<std::int32_t> incoming_offset;    ///< [grains + 1] into incoming_pair
  std::vector<std::int32_t> incoming_pair;      ///< [pairs]: pairs whose second is g, ascending
  std::vector<std::int32_t> point_node;         ///< [points]
  std::vector<std::int32_t> point_facet_offset; ///< [points + 1]
  std::vector<std::int32_t> point_facet;        ///< candidate facets
};

/// All (node, facet) combinations of different grains with distance(node, facet) <= margin; none is ever missed (the
/// distance is that to the closest point of the triangle, whichever side the node is on). The result does not depend
/// on the number of threads. `margin` in mm.
ContactCandidates find_contact_candidates(const SurfaceView& surface, double margin, ThreadTeam& team);

/// Grains and the other grains that lie near each of them.
struct NearGrains {
  std::vector<std::int32_t> grain;              ///< ascending
  std::vector<std::vector<std::int32_t>> other; ///< of each: ascending
};

/// For each of `grains`, the others whose bounding boxes come within the margin of its own; may include a few more.
/// `bounds` [grains of the packing].
NearGrains find_near_grains(std::span<const Bounds> bounds, double margin, std::vector<std::int32_t> grains,
                            ThreadTeam& team);

/// Candidates of the nodes of one grain, sorted as ContactCandidates are.
struct GrainCandidates {
  std::vector<std::int32_t> second;    ///< [pairs]
  std::vector<std::int32_t> point_end; ///< [pairs]
  std::vector<std::int32_t> node;      ///< [points]
  std::vector<std::int32_t> facet_end; ///< [points]
  std::vector<std::int32_t> facet;
};

/// Candidates of each of near.grain, only for pairs with a second grain in its near.other; looks at no other surfaces.
/// `bounds` [grains of the packing] of the surfaces at present.
std::vector<GrainCandidates> find_candidates_of_grains(const SurfaceView& surface, double margin,
                                                       std::span<const Bounds> bounds, const NearGrains& near,
                                                       ThreadTeam& team);

/// The candidates of these grains (ascending) in one list. `grains`: of the packing. Throws SimulationError if a list
/// is too long for 32 bits.
ContactCandidates join_candidates(std::span<const std::int32_t> firsts, std::span<const GrainCandidates> lists,
                                  int grains, ThreadTeam& team);

/// The offset that follows the last entry of a list of candidates. Throws SimulationError if it does not fit into 32
/// bits.
std::int32_t offset_after(const std::vector<std::int32_t>& list);

/// Makes outgoing_offset, incoming_offset and incoming_pair from pair_first and pair_second.
void index_pairs(ContactCandidates& candidates, int grains);

} // namespace mpfem
