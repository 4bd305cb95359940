// Coordination numbers on packings whose contacts are counted by hand.

#include <catch2/catch.hpp>

#include "bonded_run.hpp"
#include "postproc/metrics/coordination.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// n^3 grains on a cubic lattice, between walls that touch the outer layers.
ContactGraph lattice(int n) {
  ContactGraph graph;
  const auto number = [n](int x, int y, int z) { return static_cast<std::int32_t>((z * n + y) * n + x); };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        int walls = 0;
        for (const int at : {x, y, z}) walls += (at == 0 ? 1 : 0) + (at == n - 1 ? 1 : 0);
        graph.walls.push_back(walls);
        if (x + 1 < n) graph.pairs.push_back({{number(x, y, z), number(x + 1, y, z)}, false});
        if (y + 1 < n) graph.pairs.push_back({{number(x, y, z), number(x, y + 1, z)}, false});
        if (z + 1 < n) graph.pairs.push_back({{number(x, y, z), number(x, y, z + 1)}, false});
      }
  return graph;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

std::vector<bool> everyone(const ContactGraph& graph) {
  return std::vector<bool>(graph.walls.size(), true);
}

} // namespace

TEST_CASE("every grain of a cubic lattice between walls has six contacts, and fewer with other grains alone") {
  const ContactGraph graph = lattice(3);
  for (const double contacts : contacts_of(graph, everyone(graph), true)) CHECK(contacts == 6);
  CHECK(sum(contacts_of(graph, everyone(graph), false)) == 2 * 3 * 9 * 2); // three axes, nine rows, two contacts each
  const std::vector<bool> rattlers = find_rattlers(graph, 4);
  CHECK(std::count(rattlers.begin(), rattlers.end(), true) == 0);
}

TEST_CASE("rattlers are removed with their contacts until none is left") {
  ContactGraph graph = lattice(2);
  // A string of three that hangs on a corner: the last has one contact, and each but for the one behind it two.
  for (std::int32_t i = 0; i < 3; ++i) {
    graph.walls.push_back(i == 0 ? 2 : 0); // with the wall's two it has four until its neighbour is gone
    graph.pairs.push_back({{i == 0 ? 0 : 7 + i, 8 + i}, false});
  }
  std::vector<bool> kept = find_rattlers(graph, 4);
  CHECK(std::vector<bool>(kept.begin() + 8, kept.end()) == std::vector<bool>{true, true, true});
  CHECK(std::count(kept.begin(), kept.end(), true) == 3);
  kept.flip();
  const auto contacts = contacts_of(graph, kept, true);
  for (std::size_t grain = 0; grain < 8; ++grain) CHECK(contacts[grain] == 6); // the corner's seventh is not counted
  for (std::size_t grain = 8; grain < 11; ++grain) CHECK(contacts[grain] == 0);
}

TEST_CASE("a grain that an intact bond holds is not a rattler") {
  ContactGraph graph = lattice(2);
  graph.walls.push_back(0);
  graph.pairs.push_back({{3, 8}, true});
  const std::vector<bool> rattlers = find_rattlers(graph, 4);
  CHECK(std::count(rattlers.begin(), rattlers.end(), true) == 0);
}

TEST_CASE("coordination counts pairs that touch or are bonded, and walls that push") {
  const Folder folder;
  RunContents contents = bonded_run();
  contents.numbers["/snapshots/*/pair_area"] = {0, 0}; // the first is held by bonds, the second by nothing
  contents.numbers["/snapshots/*/wall_force"] = {1, 0, 2, 2, 0, 0, /**/ 0, 0, 0, 0, 0, 0, /**/ 0, 0, 0, 0, 0, 3};
  write_run(folder / "run.h5", contents);
  const schema::FileReader file(folder / "run.h5");
  const ContactGraph graph = contact_graph(file, -1);
  REQUIRE(graph.pairs.size() == 1);
  CHECK(graph.pairs[0].grains == std::array<std::int32_t, 2>{0, 1});
  CHECK(graph.pairs[0].bonded);
  CHECK(graph.walls == std::vector<int>{3, 0, 1});
  const Measurement m = measure_coordination(file, -1, 4);
  CHECK(m.value == 2.5); // grain 2 is a rattler; the others have 4 and 1
  CHECK(m.details["rattlers"] == 1);
  CHECK(m.details["coordination_number"].get<double>() == Approx(2.0 / 3).epsilon(1e-14));
  CHECK(m.details["coordination_number_with_walls"].get<double>() == Approx(2).epsilon(1e-14));
  CHECK(m.details["coordination_number_without_rattlers"].get<double>() == 1);
  contents.numbers.erase("/snapshots/*/wall_force");
  write_run(folder / "old.h5", contents);
  CHECK_THROWS_WITH(contact_graph(schema::FileReader(folder / "old.h5"), -1), Catch::Contains("no forces of walls"));
}
