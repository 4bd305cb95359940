// The contact search against brute force.

#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include <catch2/catch.hpp>

#include "solver/kernels/contact_search.hpp"
#include "solver/physics/gap.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

using Combination = std::tuple<std::int32_t, std::int32_t, std::int32_t>; ///< second grain, node, facet

Model random_heap(int grains, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<GrainMesh> mesh;
  for (int g = 0; g < grains; ++g) {
    // Sizes of one to four, meshes from coarse to fine, and grains that overlap: none of it may matter.
    const double radius = 0.05 + 0.15 * uniform(random);
    mesh.push_back(ball_mesh(1 + static_cast<int>(4 * uniform(random)), radius));
    rotate(mesh.back(), {0, 0, 1}, 6 * uniform(random));
    rotate(mesh.back(), {1, 0, 0}, 6 * uniform(random));
    move(mesh.back(), {0.25 + 0.5 * uniform(random), 0.25 + 0.5 * uniform(random), 0.25 + 0.5 * uniform(random)});
  }
  return build_model(pack(mesh, {1, 1, 1}), holding_scenario(1), "test");
}

std::set<Combination> by_brute_force(const SurfaceView& s, double margin) {
  std::set<Combination> found;
  const auto point = [&s](std::int32_t n) { return vector_of(&s.position[4 * static_cast<std::size_t>(n)]); };
  const std::size_t grains = s.node_offset.size() - 1;
  for (std::size_t a = 0; a < grains; ++a)
    for (std::size_t b = 0; b < grains; ++b)
      if (a != b)
        for (std::int32_t n = s.node_offset[a]; n < s.node_offset[a] + s.surface_node_count[a]; ++n)
          for (std::int32_t f = s.facet_offset[b]; f < s.facet_offset[b + 1]; ++f) {
            const std::size_t first = 3 * static_cast<std::size_t>(f);
            const Vector3<double> x[3] = {point(s.facet[first]), point(s.facet[first + 1]), point(s.facet[first + 2])};
            if (norm(point(n) - closest_point_on_triangle(point(n), x).point) <= margin)
              found.insert({static_cast<std::int32_t>(b), n, f});
          }
  return found;
}

std::set<Combination> combinations(const ContactCandidates& c) {
  std::set<Combination> found;
  for (std::size_t pair = 0; pair < c.pair_first.size(); ++pair)
    for (auto p = static_cast<std::size_t>(c.pair_point_offset[pair]);
         p < static_cast<std::size_t>(c.pair_point_offset[pair + 1]); ++p)
      for (auto f = static_cast<std::size_t>(c.point_facet_offset[p]);
           f < static_cast<std::size_t>(c.point_facet_offset[p + 1]); ++f)
        found.insert({c.pair_second[pair], c.point_node[p], c.point_facet[f]});
  return found;
}

} // namespace

TEST_CASE("the contact search finds exactly what brute force finds") {
  ThreadTeam team(2);
  std::size_t total = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Model model = random_heap(7, seed);
    for (const double margin : {1e-4, 0.01, 0.08}) {
      const ContactCandidates candidates = find_contact_candidates(model.surface(), margin, team);
      const auto found = combinations(candidates);
      CHECK(found == by_brute_force(model.surface(), margin));
      CHECK(found.size() == candidates.point_facet.size()); // none twice
      total += found.size();
    }
  }
  CHECK(total > 10000); // the heaps do touch
}

TEST_CASE("the contact search gives the same lists in the same order on any number of threads") {
  const Model model = random_heap(9, 11);
  ThreadTeam one(1), four(4);
  const ContactCandidates a = find_contact_candidates(model.surface(), 0.02, one),
                          b = find_contact_candidates(model.surface(), 0.02, four);
  CHECK(a.pair_first == b.pair_first);
  CHECK(a.pair_second == b.pair_second);
  CHECK(a.pair_point_offset == b.pair_point_offset);
  CHECK(a.point_node == b.point_node);
  CHECK(a.point_facet_offset == b.point_facet_offset);
  CHECK(a.point_facet == b.point_facet);
  CHECK(std::is_sorted(a.pair_first.begin(), a.pair_first.end()));
}

TEST_CASE("the grains near some of the grains are those that are found for all") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Bounds> bounds(400);
  for (Bounds& box : bounds)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = uniform(random);
      box.high[axis] = box.low[axis] + 0.02 + 0.1 * uniform(random);
    }
  std::vector<std::int32_t> all(bounds.size()), some;
  std::iota(all.begin(), all.end(), 0);
  for (const std::int32_t g : all)
    if (bounds[static_cast<std::size_t>(g)].low[0] < 0.3) some.push_back(g);
  ThreadTeam team(2);
  const NearGrains of_all = find_near_grains(bounds, 0.01, all, team),
                   of_some = find_near_grains(bounds, 0.01, some, team);
  REQUIRE(of_some.grain == some);
  for (std::size_t i = 0; i < some.size(); ++i)
    CHECK(of_some.other[i] == of_all.other[static_cast<std::size_t>(some[i])]);
  CHECK(find_near_grains(bounds, 0.01, {}, team).grain.empty());
}

TEST_CASE("pairs are indexed by both of their grains") {
  const Model model = random_heap(9, 12);
  ThreadTeam team(1);
  const ContactCandidates c = find_contact_candidates(model.surface(), 0.02, team);
  REQUIRE(c.pair_first.size() > 4);
  std::size_t incoming = 0;
  for (std::size_t g = 0; g < 9; ++g) {
    for (auto p = static_cast<std::size_t>(c.outgoing_offset[g]);
         p < static_cast<std::size_t>(c.outgoing_offset[g + 1]); ++p)
      CHECK(c.pair_first[p] == static_cast<std::int32_t>(g));
    for (auto i = static_cast<std::size_t>(c.incoming_offset[g]);
         i < static_cast<std::size_t>(c.incoming_offset[g + 1]); ++i, ++incoming)
      CHECK(c.pair_second[static_cast<std::size_t>(c.incoming_pair[i])] == static_cast<std::int32_t>(g));
  }
  CHECK(incoming == c.pair_first.size());
}
