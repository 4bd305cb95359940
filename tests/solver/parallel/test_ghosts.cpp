// What ranks know of grains of other ranks. Run with mpirun, see CMakeLists.txt.

#include <algorithm>
#include <span>

#include <catch2/catch.hpp>

#include "common/index.hpp"
#include "common/table_reader.hpp"
#include "solver/run/ghosts.hpp"
#include "solver/scenario/scenario.hpp"
#include "tests/solver/parallel/test_ranks.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Pairs without points of each own grain as the first one, and of the next grain as the second.
Contact contact_with_next_grains(const Model& model) {
  Contact contact;
  ContactCandidates& candidates = contact.candidates;
  for (const std::int32_t grain : model.own()) {
    candidates.pair_first.push_back(grain);
    candidates.pair_second.push_back((grain + 1) % model.grains);
  }
  candidates.pair_point_offset.assign(candidates.pair_first.size() + 1, 0);
  candidates.point_facet_offset = {0};
  index_pairs(candidates, model.grains);
  contact.active.assign(candidates.pair_first.size(), 0);
  contact.travel.assign(at(model.grains), 0.0);
  contact.travel_at_search = contact.travel;
  return contact;
}

} // namespace

// As after a restart, when no search has yet looked at the grains around. The stable step depends on these areas.
TEST_CASE("A rank knows the areas of the nodes of both grains of every pair", "[.several-ranks]") {
  const Scenario scenario = read_scenario(TomlDocument::from_text(material_text + R"([[stages]]
name = "hold"
type = "hold"
duration = 1
)",
                                                                  "test"));
  MeshedPacking packing = eight_grains(4);
  divide(packing, test_ranks());
  Model model = build_model(packing, scenario, "test", test_ranks());
  Contact contact = contact_with_next_grains(model);
  Ghosts ghosts(test_ranks(), false);
  ghosts.share_pairs(model, contact);
  const auto knows = [&](std::int32_t grain) {
    const auto areas = std::span(model.reference_area)
                           .subspan(at(model.node_offset[at(grain)]), at(model.surface_node_count[at(grain)]));
    return std::ranges::all_of(areas, [](double area) { return area > 0; });
  };
  CHECK(contact.candidates.pair_first.size() >= model.own().size());
  for (const std::int32_t grain : contact.candidates.pair_first) CHECK(knows(grain));
  for (const std::int32_t grain : contact.candidates.pair_second) CHECK(knows(grain));
}

TEST_CASE("Messages arrive whole when they are moved on while a rank computes", "[.several-ranks]") {
  const Communicator& ranks = test_ranks();
  const int next = (ranks.rank() + 1) % ranks.size(), before = (ranks.rank() + ranks.size() - 1) % ranks.size();
  constexpr std::size_t size = std::size_t{1} << 20; // more than MPI sends without an answer
  const Bytes sent(size, static_cast<std::byte>(ranks.rank() + 1));
  Bytes received(size);
  Communicator::Transfer transfer = ranks.start({{next, sent}}, {{before, received}});
  for (int look = 0; look < 1000; ++look) transfer.progress();
  transfer.finish();
  transfer.progress(); // nothing is under way
  CHECK(std::ranges::all_of(received, [&](std::byte b) { return b == static_cast<std::byte>(before + 1); }));
}
