// Files that all ranks write together are those that one rank writes, and each rank reads what is its own. With mpirun
// this test has as many ranks as that starts, otherwise one.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "common/table_reader.hpp"
#include "solver/model/normals.hpp"
#include "solver/model/tets.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/run_file.hpp"
#include "solver/run/simulation.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/solver/parallel/test_ranks.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

using Index = std::int32_t;

/// The same folder on all ranks.
class SharedFolder {
public:
  SharedFolder() {
    const std::string path = own_ / "";
    Bytes message;
    append(message, std::span<const char>(path));
    test_ranks().broadcast_from_root(message);
    path_.resize(message.size());
    MessageReader(message).take(std::span<char>(path_));
  }
  /// When all ranks are done with it.
  ~SharedFolder() { test_ranks().largest(0); }
  std::string operator/(const std::string& name) const { return path_ + name; }

private:
  Folder own_;
  std::string path_;
};

constexpr BondParameters bond{.tensile_strength = 25, .shear_strength = 18, .fracture_energy = 0.05};

/// Everything that a file may hold: bonds and friction between grains, friction at walls, a sticky tool that rubs.
Scenario scenario_of_all() {
  Scenario scenario = read_scenario(TomlDocument::from_text(material_text + R"([contact]
friction = 0.2
[walls]
friction = 0.3
[element]
type = "tet4-anp"
)" + compaction_text,
                                                            "test"));
  scenario.bond = bond;
  // In the middle, where it comes to touch all grains.
  scenario.tools = {
      {.name = "ball", .shape = SphereShape{.centre = {0.21, 0.21, 0.21}, .radius = 0.078}, .friction = 0.2}};
  scenario.tools.front().adhesion = bond;
  return scenario;
}

/// Eight grains, pressed until they touch each other, the walls and the tool.
struct Scene {
  Scenario scenario = scenario_of_all();
  ThreadTeam team{1};
  Simulation simulation{build_model(eight_grains(4), scenario, "test"), scenario, team};

  Scene() {
    for (simulation.evaluate_forces(); simulation.relative_density() < 0.56; simulation.evaluate_forces())
      simulation.advance();
  }
};

/// Grains in turn: neighbours have different owners.
std::vector<Index> in_turn(int grains, int ranks) {
  std::vector<Index> owner;
  for (int g = 0; g < grains; ++g) owner.push_back(g % ranks);
  return owner;
}

/// What a rank has of a state of all grains; the rest is made invalid, so that a use of it would be noticed.
struct RankState {
  Model model;
  Contact contact;
  WallFriction wall_friction;
  Tools tools;
  Grips grips;
  GrainSteps steps;

  bool owns(Index grain) const { return model.ownership.owns(grain); }
};

constexpr double spoilt = std::numeric_limits<double>::quiet_NaN();

void spoil_grain(Model& model, Index grain) {
  const auto g = static_cast<std::size_t>(grain);
  for (auto n = static_cast<std::size_t>(model.node_offset[g]); n < static_cast<std::size_t>(model.node_offset[g + 1]);
       ++n) {
    for (std::size_t i = 4 * n; i < 4 * n + 4; ++i) model.position[i] = model.velocity[i] = model.force[i] = spoilt;
    model.file_node[n] = -1;
    model.reference_area[n] = spoilt;
  }
  for_tets_of(model, grain, model.tet_offset[g], model.tet_offset[g + 1], [](auto& block, int lane, std::size_t) {
    block.flow_stress[lane] = block.plastic_strain[lane] = block.length[lane] = block.deviator[0][lane] = 0.0 / 0.0;
    for (auto& node : block.node) node[lane] = 0;
  });
  std::fill(model.file_tet.begin() + model.tet_offset[g], model.file_tet.begin() + model.tet_offset[g + 1], -1);
}

/// The pairs that touch own grains. Of those whose first grain is another rank's: points, facets and forces alone.
Contact part_of_contact(const Model& model, const Contact& all) {
  Contact part = all;
  ContactCandidates& to = part.candidates;
  const ContactCandidates& from = all.candidates;
  to = {};
  to.pair_point_offset = to.point_facet_offset = {0};
  for (auto* array : {&part.point_facet, &part.active, &part.pulling}) array->clear();
  part.point_open_until.clear(), part.point_facet_until.clear(), part.force.clear(), part.bond_force.clear();
  part.bond.clear(), part.point_friction.clear();
  for (std::size_t pair = 0; pair < from.pair_first.size(); ++pair) {
    const Index first = from.pair_first[pair], second = from.pair_second[pair];
    const bool own = model.ownership.owns(first);
    if (!own && !model.ownership.owns(second)) continue;
    to.pair_first.push_back(first);
    to.pair_second.push_back(second);
    part.active.push_back(all.active[pair]);
    part.pulling.push_back(all.pulling[pair]);
    for (auto i = static_cast<std::size_t>(from.pair_point_offset[pair]);
         i < static_cast<std::size_t>(from.pair_point_offset[pair + 1]); ++i) {
      to.point_node.push_back(from.point_node[i]);
      to.point_facet.insert(to.point_facet.end(), from.point_facet.begin() + from.point_facet_offset[i],
                            from.point_facet.begin() + from.point_facet_offset[i + 1]);
      to.point_facet_offset.push_back(static_cast<Index>(to.point_facet.size()));
      part.force.push_back(all.force[i]);
      part.bond_force.push_back(all.bond_force[i]);
      part.point_facet.push_back(own ? all.point_facet[i] : -1);
      part.point_open_until.push_back(own ? all.point_open_until[i] : spoilt);
      part.point_facet_until.push_back(own ? all.point_facet_until[i] : spoilt);
      part.bond.push_back(own ? all.bond[i] : PointBond{});
      part.point_friction.push_back(own ? all.point_friction[i] : PointFriction{});
    }
    to.pair_point_offset.push_back(static_cast<Index>(to.point_node.size()));
  }
  index_pairs(to, model.grains);
  return part;
}

/// With the grips at both ends of the z axis.
Grips grips_of(const Simulation& simulation) {
  return grip_nodes(simulation.model(), simulation.box().cell(), 2, 0.02, true);
}

RankState part_of(const Simulation& simulation, const Communicator& ranks) {
  RankState part{simulation.model(),         {},
                 simulation.wall_friction(), simulation.tools(),
                 grips_of(simulation),       simulation.step_estimate().grain_steps()};
  Model& model = part.model;
  model.ownership = ownership_of(in_turn(model.grains, ranks.size()), ranks.rank());
  part.contact = part_of_contact(model, simulation.contact());
  for (Index grain = 0; grain < model.grains; ++grain) {
    if (part.owns(grain)) continue;
    const auto g = static_cast<std::size_t>(grain);
    spoil_grain(model, grain);
    part.steps.whole[g] = part.steps.growth[g] = spoilt;
    std::fill(part.steps.contact.begin() + model.node_offset[g], part.steps.contact.begin() + model.node_offset[g + 1],
              spoilt);
    for (std::size_t wall = 0; wall < 6; ++wall) part.wall_friction.anchors(grain, wall).clear();
    for (std::size_t tool = 0; tool < part.tools.size(); ++tool) {
      part.tools.anchors(grain, tool).clear();
      part.tools.bonds(grain, tool).clear();
    }
    std::erase_if(part.grips.node, [&](const GrippedNode& gripped) {
      return gripped.node >= model.node_offset[g] && gripped.node < model.node_offset[g + 1];
    });
  }
  part.grips.make_offsets(model.node_offset);
  return part;
}

RunRecord some_record() {
  RunRecord record;
  record.history.resize(3);
  record.tool_history.resize(3);
  record.snapshot_files = {"snapshot-0000.h5"};
  record.from = "packing";
  return record;
}

FieldValues fields_of(const Simulation& simulation) {
  FieldWriter fields;
  simulation.write(fields);
  const RunRecord record = some_record();
  RunRecord::for_each_field(record, fields);
  return fields.values();
}

/// All ranks write it together.
void write_together(const std::string& path, const Simulation& simulation) {
  const RankState part = part_of(simulation, test_ranks());
  write_checkpoint(
      path, {part.model, part.contact, part.wall_friction, part.tools, part.grips, part.steps, fields_of(simulation)},
      some_record(), "scenario", test_ranks());
}

void write_alone(const std::string& path, const Simulation& simulation) {
  write_checkpoint(path,
                   {simulation.model(), simulation.contact(), simulation.wall_friction(), simulation.tools(),
                    grips_of(simulation), simulation.step_estimate().grain_steps(), fields_of(simulation)},
                   some_record(), "scenario");
}

/// Hash of all datasets, with their names, units, shapes and values.
std::string content(const std::string& path) {
  const std::string checksums = schema::FileReader(path).checksums();
  REQUIRE_FALSE(checksums.empty());
  return checksums;
}

template <class Array>
bool equal_rows(const Array& a, const Array& b, Index first, Index end, std::size_t width) {
  return std::equal(a.begin() + static_cast<std::ptrdiff_t>(width) * first,
                    a.begin() + static_cast<std::ptrdiff_t>(width) * end,
                    b.begin() + static_cast<std::ptrdiff_t>(width) * first);
}

bool equal(const PointBond& a, const PointBond& b) {
  return a.facet == b.facet && a.law == b.law && a.weight1 == b.weight1 && a.weight2 == b.weight2 &&
         a.state.initiation == b.state.initiation && a.state.largest == b.state.largest && a.remaining == b.remaining &&
         a.dissipated_before == b.dissipated_before;
}
bool equal(const PointFriction& a, const PointFriction& b) {
  return a.facet == b.facet && a.weight1 == b.weight1 && a.weight2 == b.weight2 && a.stiffness == b.stiffness &&
         a.force.x == b.force.x && a.force.y == b.force.y && a.force.z == b.force.z;
}

template <class Lists>
void check_lists(const RankState& part, std::size_t surfaces, Lists&& lists) {
  for (Index grain = 0; grain < part.model.grains; ++grain)
    for (std::size_t surface = 0; surface < surfaces; ++surface) {
      const auto& [read, written] = lists(grain, surface);
      REQUIRE(read.size() == (part.owns(grain) ? written.size() : 0));
      for (std::size_t i = 0; i < read.size(); ++i) {
        CHECK(read[i].node == written[i].node);
        CHECK(read[i].place.x == written[i].place.x);
        CHECK(read[i].place.z == written[i].place.z);
      }
    }
}

/// A model as it begins, that belongs to one of some ranks.
RankState fresh_part(const Scene& scene, int rank, int ranks) {
  RankState part{
      build_model(eight_grains(4), scene.scenario, "test"), {}, WallFriction(0.3, 8), scene.simulation.tools(), {}, {}};
  part.model.ownership = ownership_of(in_turn(8, ranks), rank);
  part.contact.bond_laws = scene.simulation.contact().bond_laws;
  part.contact.friction = scene.simulation.contact().friction;
  part.grips.axis = 2;
  for (Index grain = 0; grain < 8; ++grain) part.tools.anchors(grain, 0).clear(), part.tools.bonds(grain, 0).clear();
  return part;
}

void check_nodes_and_tets(const RankState& part, const Model& before, const Simulation& written) {
  const Model& model = part.model;
  for (Index grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    const Model& expected = part.owns(grain) ? written.model() : before;
    const Index first = model.node_offset[g], end = model.node_offset[g + 1];
    CHECK(equal_rows(model.position, expected.position, first, end, 4));
    CHECK(equal_rows(model.velocity, expected.velocity, first, end, 4));
    CHECK(equal_rows(model.force, expected.force, first, end, 4));
    if (part.owns(grain))
      CHECK(equal_rows(part.steps.contact, written.step_estimate().grain_steps().contact, first, end, 1));
    std::vector<double> strain, expected_strain;
    const auto list = [](std::vector<double>& values) {
      return [&values](const auto& block, int lane, std::size_t) {
        values.insert(values.end(), {block.plastic_strain[lane], block.deviator[2][lane], block.length[lane]});
      };
    };
    for_tets_of(model, grain, model.tet_offset[g], model.tet_offset[g + 1], list(strain));
    for_tets_of(expected, grain, model.tet_offset[g], model.tet_offset[g + 1], list(expected_strain));
    CHECK(strain == expected_strain);
  }
}

/// The pairs of own grains and no others, with the state of their points.
void check_contact(const RankState& part, const Contact& written) {
  const ContactCandidates& read = part.contact.candidates;
  const ContactCandidates& all = written.candidates;
  std::size_t next = 0;
  for (std::size_t pair = 0; pair < all.pair_first.size(); ++pair) {
    if (!part.owns(all.pair_first[pair])) continue;
    REQUIRE(next < read.pair_first.size());
    CHECK(read.pair_first[next] == all.pair_first[pair]);
    CHECK(read.pair_second[next] == all.pair_second[pair]);
    const auto point = static_cast<std::size_t>(read.pair_point_offset[next]),
               there = static_cast<std::size_t>(all.pair_point_offset[pair]);
    const auto points = static_cast<std::size_t>(all.pair_point_offset[pair + 1]) - there;
    REQUIRE(static_cast<std::size_t>(read.pair_point_offset[next + 1]) - point == points);
    for (std::size_t i = 0; i < points; ++i) {
      CHECK(read.point_node[point + i] == all.point_node[there + i]);
      REQUIRE(std::equal(read.point_facet.begin() + read.point_facet_offset[point + i],
                         read.point_facet.begin() + read.point_facet_offset[point + i + 1],
                         all.point_facet.begin() + all.point_facet_offset[there + i],
                         all.point_facet.begin() + all.point_facet_offset[there + i + 1]));
      CHECK(part.contact.point_facet[point + i] == written.point_facet[there + i]);
      CHECK(part.contact.point_open_until[point + i] == written.point_open_until[there + i]);
      CHECK(part.contact.point_facet_until[point + i] == written.point_facet_until[there + i]);
      CHECK(equal(part.contact.bond[point + i], written.bond[there + i]));
      CHECK(equal(part.contact.point_friction[point + i], written.point_friction[there + i]));
    }
    ++next;
  }
  CHECK(next == read.pair_first.size());
  CHECK(read.outgoing_offset.back() == static_cast<Index>(next));
  CHECK(read.incoming_pair.size() == next);
  CHECK(part.contact.force.size() == read.point_node.size());
  CHECK(part.contact.bond_force.size() == read.point_node.size());
  CHECK(part.contact.active == std::vector<Index>(next, 0));
  CHECK(part.contact.travel == written.travel);
  CHECK(part.contact.travel_at_search == written.travel_at_search);
}

} // namespace

TEST_CASE("a checkpoint of all ranks is that of one") {
  Scene scene;
  scene.simulation.advance();
  const Simulation& simulation = scene.simulation;
  // Otherwise some of the file would be empty.
  REQUIRE(std::ranges::any_of(simulation.contact().bond, &PointBond::exists));
  REQUIRE(std::ranges::any_of(simulation.contact().point_friction, &PointFriction::exists));
  const SharedFolder folder;
  write_together(folder / "together.h5", simulation);
  if (!test_ranks().is_root()) return;
  write_alone(folder / "alone.h5", simulation);
  CHECK(content(folder / "together.h5") == content(folder / "alone.h5"));
  CHECK(schema::validate(folder / "together.h5").empty());
  const schema::FileReader file(folder / "together.h5");
  for (const auto& dataset : {schema::checkpoint::wall_friction_node, schema::checkpoint::tool_friction_node,
                              schema::checkpoint::tool_adhesion_node, schema::checkpoint::grip_node})
    CHECK(file.rows(dataset) > 0);
}

TEST_CASE("a snapshot and a run file of all ranks are those of one") {
  const Scene scene;
  const Simulation& simulation = scene.simulation;
  const RankState part = part_of(simulation, test_ranks());
  const SharedFolder folder;
  const auto state = [&](const auto& of) {
    return SnapshotState{of.model, of.contact, simulation.box(), of.wall_friction, of.tools, 1e-6, 12, 0.56};
  };
  struct All {
    const Model& model;
    const Contact& contact;
    const WallFriction& wall_friction;
    const Tools& tools;
  };
  const All all{simulation.model(), simulation.contact(), simulation.wall_friction(), simulation.tools()};
  write_snapshot_file(folder / "together-0.h5", state(part), test_ranks());
  if (test_ranks().is_root()) write_snapshot_file(folder / "alone-0.h5", state(all));

  const std::vector<HistoryRow> rows(2);
  const std::vector<ToolRow> tool_rows(2);
  const RunHistory history{rows, simulation.tools(), tool_rows};
  Provenance provenance;
  provenance.scenario_text = "scenario";
  provenance.status = "complete";
  provenance.ranks = 3;
  write_run_file(folder / "together.h5", part.model, history, {folder / "together-0.h5"}, provenance, test_ranks());
  if (!test_ranks().is_root()) return;
  write_run_file(folder / "alone.h5", simulation.model(), history, {folder / "alone-0.h5"}, provenance);
  CHECK(content(folder / "together-0.h5") == content(folder / "alone-0.h5"));
  CHECK(content(folder / "together.h5") == content(folder / "alone.h5"));
  CHECK(schema::validate(folder / "together.h5").empty());
  const schema::FileReader file(folder / "together.h5");
  CHECK(file.read_scalar(schema::run::provenance_ranks) == 3);
  CHECK(file.rows(schema::run::snapshots_bond_node, "0000") > 0);
  CHECK(file.rows(schema::run::snapshots_pair_grains, "0000") > 0);
}

TEST_CASE("each rank reads the data of its own grains from a checkpoint, and nothing else") {
  Scene scene;
  scene.simulation.advance();
  const Simulation& simulation = scene.simulation;
  const Grips grips = grips_of(simulation);
  const Folder folder;
  write_alone(folder / "f.h5", simulation);
  const CheckpointReader reader(folder / "f.h5");
  CHECK(reader.has_bonds());
  const int ranks = GENERATE(1, 2, 3, 9); // of nine the last has no grain
  for (int rank = 0; rank < ranks; ++rank) {
    CAPTURE(ranks, rank);
    RankState part = fresh_part(scene, rank, ranks);
    const Model before = part.model;
    reader.take_arrays(part.model, part.contact, part.wall_friction, part.tools, part.steps, &part.grips, bond);
    check_nodes_and_tets(part, before, simulation);
    check_contact(part, simulation.contact());
    CHECK(part.steps.whole == simulation.step_estimate().grain_steps().whole);
    check_lists(part, 6, [&](Index grain, std::size_t wall) {
      return std::pair(part.wall_friction.anchors(grain, wall), simulation.wall_friction().anchors(grain, wall));
    });
    check_lists(part, 1, [&](Index grain, std::size_t tool) {
      return std::pair(part.tools.anchors(grain, tool), simulation.tools().anchors(grain, tool));
    });
    check_lists(part, 1, [&](Index grain, std::size_t tool) {
      return std::pair(part.tools.bonds(grain, tool), simulation.tools().bonds(grain, tool));
    });
    std::size_t gripped = 0;
    for (const GrippedNode& node : grips.node) {
      const auto& first = part.model.node_offset;
      const auto grain = static_cast<Index>(std::ranges::upper_bound(first, node.node) - first.begin() - 1);
      if (!part.owns(grain)) continue;
      REQUIRE(gripped < part.grips.node.size());
      CHECK(part.grips.node[gripped].node == node.node);
      CHECK(part.grips.node[gripped].side == node.side);
      CHECK(part.grips.node[gripped++].reference == node.reference);
    }
    CHECK(gripped == part.grips.node.size());
    CHECK(part.grips.offset.back() == static_cast<Index>(gripped));
  }
}

TEST_CASE("a checkpoint that names nodes, facets or sides that do not exist is damaged") {
  if (!test_ranks().is_root()) return;
  Scene scene;
  scene.simulation.advance();
  const Communicator alone;
  const Index nodes = scene.simulation.model().nodes(), facets = scene.simulation.model().facets();
  const std::vector<std::function<void(RankState&)>> changes{
      [](RankState&) {},
      [=](RankState& part) { part.contact.candidates.point_node.back() = nodes; },
      [](RankState& part) { part.contact.candidates.point_node.front() = -1; },
      [=](RankState& part) { part.contact.candidates.point_facet.back() = facets; },
      [](RankState& part) { part.contact.candidates.point_facet.front() = -1; },
      [=](RankState& part) { part.contact.point_facet.back() = facets; },
      [](RankState& part) { part.contact.point_facet.front() = -2; },
      [](RankState& part) { part.grips.node.back().side = 2; }};
  for (std::size_t change = 0; change < changes.size(); ++change) {
    CAPTURE(change);
    const Folder folder;
    RankState part = part_of(scene.simulation, alone);
    changes[change](part);
    write_checkpoint(
        folder / "f.h5",
        {part.model, part.contact, part.wall_friction, part.tools, part.grips, part.steps, fields_of(scene.simulation)},
        some_record(), "scenario");
    const CheckpointReader reader(folder / "f.h5");
    RankState read = fresh_part(scene, 0, 1);
    const auto take = [&] {
      reader.take_arrays(read.model, read.contact, read.wall_friction, read.tools, read.steps, &read.grips, bond);
    };
    if (change == 0)
      CHECK_NOTHROW(take());
    else
      CHECK_THROWS_AS(take(), InputError);
  }
}

TEST_CASE("all ranks detect a checkpoint with another order of nodes, whichever rank owns the grain") {
  Scene scene;
  scene.simulation.advance();
  const SharedFolder folder;
  write_together(folder / "f.h5", scene.simulation);
  RankState part = part_of(scene.simulation, test_ranks());
  test_ranks().largest(0); // the file is there
  const CheckpointReader reader(folder / "f.h5");
  CHECK_NOTHROW(reader.check_model(part.model, test_ranks()));
  for (const Index grain : part.model.own())
    if (grain == part.model.grains - 1)
      std::swap(part.model.file_node[static_cast<std::size_t>(part.model.node_offset[7])],
                part.model.file_node[static_cast<std::size_t>(part.model.node_offset[7]) + 1]);
  CHECK_THROWS_WITH(reader.check_model(part.model, test_ranks()),
                    Catch::Contains("orders nodes and tetrahedra differently"));
}

TEST_CASE("the pressure at nodes and the forces of pairs are sums over all contact points") {
  const Scene scene;
  const Simulation& simulation = scene.simulation;
  const Model& model = simulation.model();
  const Contact& contact = simulation.contact();
  std::vector<double> push(static_cast<std::size_t>(model.nodes()), 0.0); // N, along the inward normal
  std::map<std::pair<Index, Index>, std::array<double, 3>> force;         // N, of the second on the first
  std::vector<SurfaceNormals> normals;
  for (Index grain = 0; grain < model.grains; ++grain) normals.emplace_back(model, grain);
  const auto add = [&](Index grain, Index node, double share, const ContactForce& point) {
    const Vector3<double> normal = normals[static_cast<std::size_t>(grain)].normal(static_cast<std::size_t>(node));
    for (std::size_t axis = 0; axis < 3; ++axis)
      push[static_cast<std::size_t>(node)] -= share * point.force[axis] * normal[axis];
  };
  for (std::size_t p = 0; p < contact.active.size(); ++p) {
    const auto pair = static_cast<Index>(p);
    const Index first = contact.candidates.pair_first[p], second = contact.candidates.pair_second[p];
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points) {
        add(first, point.node, 1.0, point);
        for (int c = 0; c < 3; ++c) add(second, point.facet_node[c], -point.weight(c), point);
        for (std::size_t axis = 0; axis < 3; ++axis)
          force[std::minmax(first, second)][axis] += (first < second ? 1 : -1) * point.force[axis];
      }
  }

  const Folder folder;
  write_snapshot_file(folder / "f.h5",
                      {model, contact, simulation.box(), simulation.wall_friction(), simulation.tools(), 0, 0, 0.5});
  const schema::FileReader file(folder / "f.h5");
  const auto pressure = file.read(schema::run::snapshots_contact_pressure, "0000");
  for (Index grain = 0; grain < model.grains; ++grain) {
    const auto first = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain)]);
    const auto count = static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]);
    for (std::size_t n = first; n < first + count; ++n) {
      const double sum = push[n] + simulation.box().wall_force_on_node(model, n, grain) +
                         simulation.tools().push_on_node(model, n, grain);
      CHECK(pressure[static_cast<std::size_t>(model.file_node[n])] ==
            static_cast<float>(sum /
                               normals[static_cast<std::size_t>(grain)].area(n))); // every bit: in the order of pairs
    }
  }
  const auto grains = file.read(schema::run::snapshots_pair_grains, "0000");
  const auto of_pairs = file.read(schema::run::snapshots_pair_force, "0000");
  REQUIRE(grains.size() == 2 * force.size());
  std::size_t row = 0;
  for (const auto& [pair, sum] : force) { // ascending, as in the file
    CHECK(grains[2 * row] == pair.first);
    CHECK(grains[2 * row + 1] == pair.second);
    const double size = std::hypot(sum[0], sum[1], sum[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(std::abs(of_pairs[3 * row + axis] - sum[axis]) < accumulated_rounding * size);
    ++row;
  }
}

TEST_CASE("the two halves of a pair's contact add up on the owner of its first grain") {
  const Scene scene;
  const Simulation& simulation = scene.simulation;
  const RankState part = part_of(simulation, test_ranks());
  const auto all = pair_contacts(simulation.model(), simulation.contact());
  const auto own = pair_contacts(part.model, part.contact, test_ranks());
  REQUIRE(all.size() > 8);
  std::size_t next = 0;
  for (const PairContact& pair : all) {
    CHECK(pair.first < pair.second);
    if (!part.owns(pair.first)) continue;
    REQUIRE(next < own.size());
    CHECK(own[next].second == pair.second);
    CHECK(own[next].force[0] == pair.force[0]);
    CHECK(own[next].area == pair.area);
    CHECK(own[next].bonds.bonds == pair.bonds.bonds);
    CHECK(own[next++].bonds.stored == pair.bonds.stored);
  }
  CHECK(next == own.size());
}
