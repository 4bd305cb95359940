#include "solver/output/checkpoint.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "common/version.hpp"
#include "results-schema/descriptors.hpp"
#include "solver/model/tets.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/history.hpp"

namespace mpfem {

namespace {

namespace check = schema::checkpoint;

/// Calls visit(dataset, array, rows) for every array of contact whose type is that of its dataset; `rows` is 0 where
/// the file decides.
template <class ContactType, class Visitor>
void for_each_contact_array(ContactType& contact, std::size_t grains, Visitor&& visit) {
  auto& k = contact.candidates;
  visit(check::contact_pair_first, k.pair_first, std::size_t{0});
  visit(check::contact_pair_second, k.pair_second, k.pair_first.size());
  visit(check::contact_pair_point_offset, k.pair_point_offset, k.pair_first.size() + 1);
  visit(check::contact_point_node, k.point_node, std::size_t{0});
  visit(check::contact_point_facet_offset, k.point_facet_offset, k.point_node.size() + 1);
  visit(check::contact_candidate_facet, k.point_facet, std::size_t{0});
  visit(check::grain_travel, contact.travel, grains);
  visit(check::grain_travel_at_search, contact.travel_at_search, grains);
  visit(check::contact_point_facet, contact.point_facet, k.point_node.size());
  visit(check::contact_point_wake, contact.point_open_until, k.point_node.size());
  visit(check::contact_point_sure, contact.point_facet_until, k.point_node.size());
}

template <class Steps, class Visitor>
void for_each_step_array(Steps& steps, std::size_t grains, std::size_t nodes, Visitor&& visit) {
  visit(check::grain_step, steps.whole, grains);
  visit(check::grain_step_growth, steps.growth, grains);
  visit(check::node_step_contact, steps.contact, nodes);
}

template <class ModelType, class Visitor>
void for_each_node_array(ModelType& model, Visitor&& visit) {
  visit(check::node_position, model.position);
  visit(check::node_velocity, model.velocity);
  visit(check::node_force, model.force);
}

/// Calls visit(dataset, place) for every number that a tet keeps; place(block) gives its lanes. One array each: a copy
/// of all of them would be the most that a run holds.
template <class Visitor>
void for_each_tet_array(Visitor&& visit) {
  visit(
      check::tet_deviator_xx, [](auto& b) -> auto& { return b.deviator[0]; });
  visit(
      check::tet_deviator_yy, [](auto& b) -> auto& { return b.deviator[1]; });
  visit(
      check::tet_deviator_xy, [](auto& b) -> auto& { return b.deviator[2]; });
  visit(
      check::tet_deviator_yz, [](auto& b) -> auto& { return b.deviator[3]; });
  visit(
      check::tet_deviator_zx, [](auto& b) -> auto& { return b.deviator[4]; });
  visit(
      check::tet_flow_stress, [](auto& b) -> auto& { return b.flow_stress; });
  visit(
      check::tet_plastic_strain, [](auto& b) -> auto& { return b.plastic_strain; });
  visit(
      check::tet_length, [](auto& b) -> auto& { return b.length; });
}

/// Of the order of nodes and tets, in which arrays stand in a checkpoint.
std::uint64_t numbering_hash(const Model& model) {
  return hash_values(std::span<const std::int32_t>(model.file_tet),
                     hash_values(std::span<const std::int32_t>(model.file_node)));
}

constexpr std::size_t anchor_values = 6, walls = 6;

/// Where what rigid surfaces and nodes have between them stands.
struct SurfaceDatasets {
  const decltype(check::wall_friction_node)& node;
  const decltype(check::wall_friction_side)& surface;
  const decltype(check::wall_friction_values)& values;
};
constexpr SurfaceDatasets wall_anchors{check::wall_friction_node, check::wall_friction_side,
                                       check::wall_friction_values};
constexpr SurfaceDatasets tool_anchors{check::tool_friction_node, check::tool_friction_tool,
                                       check::tool_friction_values};
constexpr SurfaceDatasets tool_bonds{check::tool_adhesion_node, check::tool_adhesion_tool, check::tool_adhesion_values};

void append_anchor(std::vector<double>& values, const SurfaceAnchor& anchor) {
  for (const Vector3<double>& v : {anchor.place, anchor.force}) values.insert(values.end(), {v.x, v.y, v.z});
}

SurfaceAnchor anchor_of(std::int32_t node, const double* v) {
  return {node, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

constexpr std::size_t tool_bond_values = 6;

void append_tool_bond(std::vector<double>& values, const SurfaceBond& bond) {
  values.insert(values.end(),
                {bond.place.x, bond.place.y, bond.place.z, bond.state.initiation, bond.state.largest, bond.remaining});
}

SurfaceBond tool_bond_of(std::int32_t node, const double* v) {
  SurfaceBond bond;
  bond.node = node;
  bond.place = {v[0], v[1], v[2]};
  bond.state = {v[3], v[4]};
  bond.remaining = v[5];
  return bond;
}

/// One file while it is written.
class Writer {
public:
  explicit Writer(const std::string& path)
      : file_(path, schema::FileKind::checkpoint, fmt::format("mpfem {}", version_and_commit())) {}

  template <class Dataset, class Vector>
  void write(const Dataset& dataset, const Vector& values, std::size_t rows) {
    using T = typename Vector::value_type;
    file_.write(dataset, std::span<const T>(values.data(), values.size()), rows);
  }
  template <class Dataset, class Vector>
  void write(const Dataset& dataset, const Vector& values) {
    write(dataset, values, values.size());
  }
  void write_identity(const Model& model, const std::string& scenario_text);
  void write_record(const RunRecord& record);
  void write_fields(const FieldValues& fields);
  void write_tets(const Model& model);
  void write_bonds(const Contact& contact);
  void write_friction(const Contact& contact);
  template <class Friction>
  void write_anchors(const SurfaceDatasets& datasets, const Friction& friction, std::size_t surfaces);
  void write_tool_bonds(const Tools& tools);
  void write_grips(const Grips& grips);
  void commit() { file_.commit(); }

private:
  schema::FileWriter file_;
};

void Writer::write_identity(const Model& model, const std::string& scenario_text) {
  file_.write_scalar(check::scenario, scenario_text);
  file_.write_scalar(check::packing_hash, hash_text(model.mesh_hash));
  file_.write_scalar(check::numbering_hash, hash_text(numbering_hash(model)));
  file_.write_scalar(check::smooth_grains, std::int32_t{model.smooth_grains});
  file_.write_scalar(check::lanes, std::int32_t{native_lanes});
}

void Writer::write_record(const RunRecord& record) {
  std::vector<std::string> stage_name, stage_end;
  std::vector<double> stage_values, stage_hold_rms;
  for (const StageResult& stage : record.stages) {
    stage_name.push_back(stage.name);
    stage_end.push_back(stage.ended_by);
    stage_values.insert(stage_values.end(), {stage.overshoot, stage.hold_error, stage.hold_stress});
    stage_hold_rms.push_back(stage.hold_rms);
  }
  write(check::run_snapshots, record.snapshot_files);
  write(check::run_stage_name, stage_name);
  write(check::run_stage_end, stage_end);
  write(check::run_stage_values, stage_values, stage_name.size());
  write(check::run_stage_hold_rms, stage_hold_rms);
  write(check::run_history, flatten(record.history));
  if (!record.tool_history.empty()) write(check::run_tool_history, flatten(record.tool_history));
  if (!record.from.empty()) file_.write_scalar(check::run_from, record.from);
}

void Writer::write_fields(const FieldValues& fields) {
  write(check::run_field_names, fields.name);
  write(check::run_integers, fields.integer);
  write(check::run_numbers, fields.number);
}

void Writer::write_tets(const Model& model) {
  for_each_tet_array([&](const auto& dataset, const auto& place) {
    std::vector<double> values(static_cast<std::size_t>(model.tets()));
    for_each_tet(model, [&](const auto& block, int lane, std::size_t tet) { values[tet] = place(block)[lane]; });
    write(dataset, values);
  });
}

void Writer::write_bonds(const Contact& contact) {
  std::vector<std::int32_t> facet, law;
  std::vector<double> values;
  for (const PointBond& bond : contact.bond) {
    facet.push_back(bond.facet);
    law.push_back(bond.law);
    values.insert(values.end(),
                  {bond.weight1, bond.weight2, bond.state.initiation, bond.state.largest, bond.remaining, bond.spent});
  }
  write(check::bond_facet, facet);
  write(check::bond_values, values, facet.size());
  write(check::bond_laws, flatten(contact.bond_laws), contact.bond_laws.size());
  if (contact.bond_laws.size() > 1) write(check::bond_law, law);
}

void Writer::write_friction(const Contact& contact) {
  std::vector<std::int32_t> facet;
  std::vector<double> values;
  for (const PointFriction& point : contact.rubbing) {
    facet.push_back(point.facet);
    const Vector3<double>& force = point.force;
    values.insert(values.end(), {point.weight1, point.weight2, point.stiffness, force.x, force.y, force.z, point.stored,
                                 point.dissipated});
  }
  write(check::friction_facet, facet);
  write(check::friction_values, values, facet.size());
  std::vector<std::int32_t> grains;
  std::vector<double> lost;
  for (const auto& [pair, dissipated] : contact.friction_left_behind) {
    grains.insert(grains.end(), {pair.first, pair.second});
    lost.push_back(dissipated);
  }
  write(check::friction_left_grains, grains, lost.size());
  write(check::friction_left_behind, lost);
}

template <class Friction>
void Writer::write_anchors(const SurfaceDatasets& datasets, const Friction& friction, std::size_t surfaces) {
  std::vector<std::int32_t> node, surface_of_node;
  std::vector<double> values;
  for (int grain = 0; grain < friction.grains(); ++grain)
    for (std::size_t surface = 0; surface < surfaces; ++surface)
      for (const SurfaceAnchor& anchor : friction.anchors(grain, surface)) {
        node.push_back(anchor.node);
        surface_of_node.push_back(static_cast<std::int32_t>(surface));
        append_anchor(values, anchor);
      }
  write(datasets.node, node);
  write(datasets.surface, surface_of_node);
  write(datasets.values, values, node.size());
}

void Writer::write_tool_bonds(const Tools& tools) {
  std::vector<std::int32_t> node, tool_of_node;
  std::vector<double> values;
  for (int grain = 0; grain < tools.grains(); ++grain)
    for (std::size_t tool = 0; tool < tools.size(); ++tool)
      for (const SurfaceBond& bond : tools.bonds(grain, tool)) {
        node.push_back(bond.node);
        tool_of_node.push_back(static_cast<std::int32_t>(tool));
        append_tool_bond(values, bond);
      }
  write(tool_bonds.node, node);
  write(tool_bonds.surface, tool_of_node);
  write(tool_bonds.values, values, node.size());
}

void Writer::write_grips(const Grips& grips) {
  std::vector<std::int32_t> node, side;
  std::vector<double> reference;
  for (const GrippedNode& gripped : grips.node) {
    node.push_back(gripped.node);
    side.push_back(gripped.side);
    reference.insert(reference.end(), gripped.reference.begin(), gripped.reference.end());
  }
  write(check::grip_node, node);
  write(check::grip_side, side);
  write(check::grip_reference, reference, node.size());
}

} // namespace

void write_checkpoint(const std::string& path, const CheckpointState& state, const RunRecord& record,
                      const std::string& scenario_text) {
  const Model& model = state.model;
  const auto nodes = static_cast<std::size_t>(model.nodes()), grains = static_cast<std::size_t>(model.grains);
  Writer file(path);
  file.write_identity(model, scenario_text);
  file.write_record(record);
  file.write_fields(state.fields);
  for_each_node_array(model, [&](const auto& dataset, const auto& values) { file.write(dataset, values, nodes); });
  file.write_tets(model);
  const auto write = [&](const auto& dataset, const auto& values, std::size_t) { file.write(dataset, values); };
  for_each_step_array(state.grain_steps, grains, nodes, write);
  for_each_contact_array(state.contact, grains, write);
  if (state.contact.bonding()) file.write_bonds(state.contact);
  if (state.contact.has_friction()) file.write_friction(state.contact);
  if (state.wall_friction.present()) file.write_anchors(wall_anchors, state.wall_friction, walls);
  if (state.tools.present()) file.write_anchors(tool_anchors, state.tools, state.tools.size());
  if (state.tools.adhere()) file.write_tool_bonds(state.tools);
  if (state.grips.present()) file.write_grips(state.grips);
  file.commit();
}

// ---------------------------------------------------------------------------------------------- reading

CheckpointReader::CheckpointReader(const std::string& path) : file_(path, schema::FileKind::checkpoint) {}

void CheckpointReader::fail_damaged() const {
  throw InputError(fmt::format("{}: the checkpoint is damaged: its numbers do not belong together", one_line(path())));
}

std::string CheckpointReader::content_hash() const {
  if (file_.checksums().empty())
    throw InputError(fmt::format(
        "{}: the checkpoint has no checksum, allowed: a file as this version of mpfem wrote it", one_line(path())));
  return file_.checksums();
}

std::string CheckpointReader::scenario_text() const {
  return file_.read_scalar(check::scenario);
}

std::string CheckpointReader::packing_hash() const {
  return file_.read_scalar(check::packing_hash);
}

std::string CheckpointReader::from() const {
  return file_.has(check::run_from) ? file_.read_scalar(check::run_from) : "";
}

std::int64_t CheckpointReader::step() const {
  const auto integers = file_.read(check::run_integers);
  if (integers.empty()) fail_damaged();
  return integers.front();
}

bool CheckpointReader::has_bonds() const {
  if (!file_.has(check::bond_facet)) return false;
  const auto facet = file_.read(check::bond_facet);
  if (std::any_of(facet.begin(), facet.end(), [](std::int32_t f) { return f >= 0; })) return true;
  const auto values = file_.read(check::bond_values); // broken and not formed again: what they spent is left
  for (std::size_t i = 5; i < values.size(); i += 6)
    if (values[i] > 0) return true;
  return false;
}

void CheckpointReader::check_model(const Model& model) const {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: the checkpoint {}", one_line(path()), what));
  };
  if (packing_hash() != hash_text(model.mesh_hash)) fail("belongs to another packing than the scenario's");
  // Arrays stand in the order of nodes and tets, which versions may choose otherwise.
  if (file_.read_scalar(check::numbering_hash) != hash_text(numbering_hash(model)))
    fail("was written by a version of mpfem that orders nodes and tets otherwise");
  if (const auto lanes = file_.read_scalar(check::lanes); lanes != native_lanes)
    fail(fmt::format("was written by a build with {} lanes, this one has {}: nodes and tets would not go on bitwise",
                     lanes, native_lanes));
  // All contacts would open or close by the height of the smooth surface at once.
  if (const auto smooth = file_.read_scalar(check::smooth_grains); smooth != model.smooth_grains)
    fail(fmt::format("has {} of {} grains that touch by their smooth surface, the scenario {}; allowed the same "
                     "contact.surface",
                     smooth, model.grains, model.smooth_grains));
}

RunRecord CheckpointReader::record() const {
  RunRecord record;
  try {
    record.history = unflatten(file_.read(check::run_history));
    if (file_.has(check::run_tool_history)) record.tool_history = tool_rows_of(file_.read(check::run_tool_history));
  } catch (const std::length_error&) {
    throw InputError(
        fmt::format("{}: the checkpoint was written by a build with other history columns", one_line(path())));
  }
  record.snapshot_files = file_.read(check::run_snapshots);
  const auto name = file_.read(check::run_stage_name), end = file_.read(check::run_stage_end);
  const auto values = file_.read(check::run_stage_values), rms = file_.read(check::run_stage_hold_rms);
  if (end.size() != name.size() || values.size() != 3 * name.size() || rms.size() != name.size()) fail_damaged();
  for (std::size_t i = 0; i < name.size(); ++i)
    record.stages.push_back({name[i], end[i], values[3 * i], values[3 * i + 1], values[3 * i + 2], rms[i]});
  record.from = from();
  return record;
}

FieldValues CheckpointReader::fields() const {
  if (!file_.has(check::run_field_names))
    throw InputError(fmt::format("{}: the checkpoint was written by another version of mpfem", one_line(path())));
  return {.name = file_.read(check::run_field_names),
          .number = file_.read(check::run_numbers),
          .integer = file_.read(check::run_integers)};
}

void CheckpointReader::take_arrays(Model& model, Contact& contact, WallFriction& wall_friction, Tools& tools,
                                   GrainSteps& grain_steps, Grips* grips,
                                   const std::optional<BondParameters>& bond_parameters) const {
  const auto nodes = static_cast<std::size_t>(model.nodes()), grains = static_cast<std::size_t>(model.grains);
  for_each_node_array(model, [&](const auto& dataset, LazyArray<double>& into) {
    const auto values = file_.read(dataset); // one array at a time is in memory beside the model
    if (values.size() != 4 * nodes) fail_damaged();
    std::copy(values.begin(), values.end(), into.begin());
  });
  take_tets(model);
  for_each_step_array(grain_steps, grains, nodes, [&](const auto& dataset, auto& values, std::size_t rows) {
    const auto found = file_.read(dataset);
    if (found.size() != rows) fail_damaged();
    values = std::decay_t<decltype(values)>(rows);
    std::copy(found.begin(), found.end(), values.begin());
  });
  take_candidates(model, contact);
  if (contact.bonding()) {
    // A checkpoint without bonds goes on with them: they form where grains touch.
    const std::size_t points = contact.point_facet.size();
    contact.bond.assign(points, {});
    contact.bond_force.resize(points);
    contact.pulling.assign(contact.candidates.pair_first.size(), 0);
    if (bond_parameters) take_bonds(model, contact, *bond_parameters);
  }
  if (contact.has_friction()) take_friction(model, contact);
  if (wall_friction.present() && file_.has(check::wall_friction_node))
    take_anchors(model, wall_anchors, walls,
                 [&](int grain, std::size_t wall) { return &wall_friction.anchors(grain, wall); });
  if (tools.present() && file_.has(check::tool_friction_node))
    take_anchors(model, tool_anchors, tools.size(), [&](int grain, std::size_t tool) {
      return tools[tool].friction > 0 ? &tools.anchors(grain, tool) : nullptr;
    });
  if (tools.adhere() && file_.has(check::tool_adhesion_node)) take_tool_bonds(model, tools);
  if (grips && file_.has(check::grip_node)) take_grips(model, *grips);
}

void CheckpointReader::take_tets(Model& model) const {
  for_each_tet_array([&](const auto& dataset, const auto& place) {
    const auto values = file_.read(dataset);
    if (values.size() != static_cast<std::size_t>(model.tets())) fail_damaged();
    for_each_tet(model, [&](auto& block, int lane, std::size_t tet) {
      auto& number = place(block)[lane];
      number = static_cast<std::remove_reference_t<decltype(number)>>(values[tet]);
    });
  });
  fill_unused_lanes(model);
}

void CheckpointReader::take_candidates(const Model& model, Contact& contact) const {
  // In this order: what was read before tells how many rows follow.
  for_each_contact_array(contact, static_cast<std::size_t>(model.grains),
                         [&](const auto& dataset, auto& values, std::size_t rows) {
                           values = file_.read(dataset);
                           if (rows > 0 && values.size() != rows) fail_damaged();
                         });
  index_pairs(contact.candidates, model.grains);
  contact.force.resize(contact.point_facet.size());
  contact.active.assign(contact.candidates.pair_first.size(), 0);
}

void CheckpointReader::take_bonds(const Model& model, Contact& contact, const BondParameters& parameters) const {
  const BondLaw coming = contact.bond_laws.back();
  contact.bond_laws = unflatten_bond_laws(file_.read(check::bond_laws), parameters.normal_only);
  const std::size_t points = contact.bond.size(), laws = contact.bond_laws.size();
  const auto facet = file_.read(check::bond_facet);
  const auto values = file_.read(check::bond_values);
  const auto law = file_.has(check::bond_law) ? file_.read(check::bond_law) : std::vector<std::int32_t>(points, 0);
  if (laws == 0 || facet.size() != points || values.size() != 6 * points || law.size() != points) fail_damaged();
  for (std::size_t i = 0; i < points; ++i) {
    const double* v = &values[6 * i];
    if (law[i] < 0 || static_cast<std::size_t>(law[i]) >= laws || facet[i] < -1 || facet[i] >= model.facets())
      fail_damaged();
    PointBond& bond = contact.bond[i];
    bond.facet = facet[i];
    bond.law = law[i];
    bond.weight1 = v[0], bond.weight2 = v[1];
    bond.state = {v[2], v[3]};
    bond.remaining = v[4];
    bond.spent = v[5];
  }
  if (contact.bond_laws.back() != coming) contact.bond_laws.push_back(coming);
}

void CheckpointReader::take_friction(const Model& model, Contact& contact) const {
  const std::size_t points = contact.point_facet.size();
  contact.rubbing.assign(points, {});
  if (!file_.has(check::friction_facet)) return;
  const auto facet = file_.read(check::friction_facet);
  const auto values = file_.read(check::friction_values);
  if (facet.size() != points || values.size() != 8 * points) fail_damaged();
  for (std::size_t i = 0; i < points; ++i) {
    const double* v = &values[8 * i];
    if (facet[i] < -1 || facet[i] >= model.facets()) fail_damaged();
    contact.rubbing[i] = {facet[i], v[0], v[1], v[2], {v[3], v[4], v[5]}, v[6], v[7]};
  }
  const auto grains = file_.read(check::friction_left_grains);
  const auto lost = file_.read(check::friction_left_behind);
  if (grains.size() != 2 * lost.size()) fail_damaged();
  for (std::size_t i = 0; i < lost.size(); ++i)
    contact.friction_left_behind[{grains[2 * i], grains[2 * i + 1]}] = lost[i];
}

/// What stands by grain, surface and node: calls `make(node, values)` for each and puts what it gives into
/// `list_of(grain, surface)`, a pointer, or null where it is left out.
template <class Datasets, class Lists, class Make>
void CheckpointReader::take_by_surface(const Model& model, const Datasets& datasets, std::size_t surfaces,
                                       std::size_t width, Lists&& list_of, Make&& make) const {
  const auto node = file_.read(datasets.node), surface = file_.read(datasets.surface);
  const auto values = file_.read(datasets.values);
  if (surface.size() != node.size() || values.size() != width * node.size()) fail_damaged();
  const auto& first = model.node_offset;
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (node[i] < 0 || node[i] >= model.nodes() || surface[i] < 0 || static_cast<std::size_t>(surface[i]) >= surfaces)
      fail_damaged();
    const auto grain = static_cast<int>(std::upper_bound(first.begin(), first.end(), node[i]) - first.begin()) - 1;
    auto* list = list_of(grain, static_cast<std::size_t>(surface[i]));
    if (list == nullptr) continue;
    if (!list->empty() && list->back().node >= node[i]) fail_damaged();
    list->push_back(make(node[i], &values[width * i]));
  }
}

template <class Datasets, class Anchors>
void CheckpointReader::take_anchors(const Model& model, const Datasets& datasets, std::size_t surfaces,
                                    Anchors&& anchors_of) const {
  take_by_surface(model, datasets, surfaces, anchor_values, anchors_of, anchor_of);
}

void CheckpointReader::take_tool_bonds(const Model& model, Tools& tools) const {
  take_by_surface(
      model, tool_bonds, tools.size(), tool_bond_values,
      [&](int grain, std::size_t tool) { return tools[tool].adhesion ? &tools.bonds(grain, tool) : nullptr; },
      tool_bond_of);
}

void CheckpointReader::take_grips(const Model& model, Grips& grips) const {
  const auto node = file_.read(check::grip_node), side = file_.read(check::grip_side);
  const auto reference = file_.read(check::grip_reference);
  if (side.size() != node.size() || reference.size() != 3 * node.size()) fail_damaged();
  for (std::size_t i = 0; i < node.size(); ++i)
    grips.node.push_back({node[i], side[i], {reference[3 * i], reference[3 * i + 1], reference[3 * i + 2]}});
  grips.make_offsets(model.node_offset);
}

std::string checkpoint_checksum(const std::string& path) {
  return CheckpointReader(path).content_hash();
}

void verify_checkpoint(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  file.verify();
}

} // namespace mpfem
