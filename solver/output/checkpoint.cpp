#include "solver/output/checkpoint.hpp"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/table_reader.hpp"
#include "common/version.hpp"
#include "results-schema/descriptors.hpp"
#include "results-schema/file.hpp"
#include "solver/output/history.hpp"

namespace mpfem {

namespace {

namespace check = schema::checkpoint;

std::vector<std::int64_t> integers(const RunState& s) {
  return {
      s.step,     s.stage,       s.rows_in_stage, s.snapshots_passed,  s.steps_since_estimate, s.controlled_by_contact,
      s.searches, s.stage_ended, s.absent_axes,   s.checkpoints_passed};
}

void set_integers(RunState& s, const std::vector<std::int64_t>& v) {
  s.step = v[0], s.stage = v[1], s.rows_in_stage = v[2], s.snapshots_passed = v[3], s.steps_since_estimate = v[4],
  s.controlled_by_contact = v[5], s.searches = v[6], s.stage_ended = v[7], s.absent_axes = v[8],
  s.checkpoints_passed = v[9];
}

/// Calls f(double&) for every number of state and record, always in the same order.
template <class State, class Record, class F>
void for_each_number(State& s, Record& r, F&& f) {
  for (auto* value :
       {&s.time, &s.stage_time, &s.stable_step, &s.last_step, &s.strain_since_estimate, &s.strain_rate,
        &s.initial_energy, &s.plastic_dissipation, &s.viscous_dissipation, &s.damping_dissipation, &s.external_work,
        &s.grip_work_ahead, &s.damping_force, &s.mean_stress, &s.stage_mean_stress, &r.wall_time})
    f(*value);
  for (auto* values : {&s.initial_lengths, &s.stage_low, &s.stage_high, &s.low, &s.high})
    for (auto& value : *values) f(value);
  for (auto* values : {&s.last_wall_force, &s.last_wall_move})
    for (auto& value : *values) f(value);
  for (auto& value : r.profile_seconds) f(value);
  // A loading's state is numbers and nothing else.
  auto loading = std::bit_cast<std::array<double, sizeof(LoadingState) / sizeof(double)>>(s.loading);
  for (double& value : loading) f(value);
  if constexpr (!std::is_const_v<State>) s.loading = std::bit_cast<LoadingState>(loading);
}

/// The tets' state without lanes, in block order.
struct TetState {
  std::vector<double> deviator, flow_stress, plastic_strain, length;
};

/// Calls f(block, lane, tet) for every tet of the model.
template <class ModelType, class F>
void for_each_tet(ModelType& model, F&& f) {
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b)
      for (int lane = 0; lane < model.tets_in_block(grain, b); ++lane)
        f(model.block[static_cast<std::size_t>(b)], lane,
          static_cast<std::size_t>(model.tet_offset[g] + (b - model.block_offset[g]) * TetBlock::lanes + lane));
  }
}

TetState tet_state(const Model& model) {
  const auto tets = static_cast<std::size_t>(model.tets());
  TetState s{std::vector<double>(5 * tets), std::vector<double>(tets), std::vector<double>(tets),
             std::vector<double>(tets)};
  for_each_tet(model, [&](const TetBlock& block, int lane, std::size_t tet) {
    for (std::size_t c = 0; c < 5; ++c) s.deviator[5 * tet + c] = block.deviator[c][lane];
    s.flow_stress[tet] = block.flow_stress[lane];
    s.plastic_strain[tet] = block.plastic_strain[lane];
    s.length[tet] = block.length[lane];
  });
  return s;
}

template <class Vector>
std::uint64_t add(const Vector& values, std::uint64_t hash) {
  return hash_values(std::span<const typename Vector::value_type>(values.data(), values.size()), hash);
}

struct Contents {
  std::vector<std::int64_t> integers;
  std::vector<double> numbers, history;
  std::vector<double> position, velocity, force;
  TetState tet;
  std::vector<double> travel, travel_at_search;
  std::vector<std::int32_t> pair_first, pair_second, pair_point_offset, point_node, point_facet_offset, candidate_facet,
      point_facet;
  std::vector<double> point_wake, point_sure;
  std::vector<std::int32_t> bond_facet, grip_node, grip_side;
  std::vector<double> bond_values, grip_reference, stage_values;

  std::uint64_t checksum() const {
    std::uint64_t hash = add(integers, hash_seed);
    for (const auto* v : {&numbers, &history, &position, &velocity, &force, &tet.deviator, &tet.flow_stress,
                          &tet.plastic_strain, &tet.length, &travel, &travel_at_search, &point_wake, &point_sure,
                          &bond_values, &grip_reference, &stage_values})
      hash = add(*v, hash);
    for (const auto* v : {&pair_first, &pair_second, &pair_point_offset, &point_node, &point_facet_offset,
                          &candidate_facet, &point_facet, &bond_facet, &grip_node, &grip_side})
      hash = add(*v, hash);
    return hash;
  }
};

} // namespace

void write_checkpoint(const std::string& path, const Simulation& simulation, const RunRecord& record,
                      const std::string& scenario_text) {
  const Model& model = simulation.model();
  const Contact& contact = simulation.contact();
  const ContactCandidates& candidates = contact.candidates;
  Contents c;
  c.integers = integers(simulation.state());
  for_each_number(simulation.state(), record, [&](double value) { c.numbers.push_back(value); });
  c.history = flatten(record.history);
  c.position.assign(model.position.begin(), model.position.end());
  c.velocity.assign(model.velocity.begin(), model.velocity.end());
  c.force.assign(model.force.begin(), model.force.end());
  c.tet = tet_state(model);
  c.travel = contact.travel, c.travel_at_search = contact.travel_at_search;
  c.pair_first = candidates.pair_first, c.pair_second = candidates.pair_second;
  c.pair_point_offset = candidates.pair_point_offset, c.point_node = candidates.point_node;
  c.point_facet_offset = candidates.point_facet_offset, c.candidate_facet = candidates.point_facet;
  c.point_facet = contact.point_facet, c.point_wake = contact.point_wake, c.point_sure = contact.point_sure;
  for (const PointBond& bond : contact.bond) {
    c.bond_facet.push_back(bond.facet);
    c.bond_values.insert(c.bond_values.end(), {bond.weight1, bond.weight2, bond.state.initiation, bond.state.largest,
                                               bond.remaining, bond.spent});
  }
  for (const GrippedNode& gripped : simulation.grips().node) {
    c.grip_node.push_back(gripped.node);
    c.grip_side.push_back(gripped.side);
    c.grip_reference.insert(c.grip_reference.end(), gripped.reference.begin(), gripped.reference.end());
  }

  std::vector<std::string> stage_name, stage_end;
  for (const StageResult& stage : record.stages) {
    stage_name.push_back(stage.name);
    stage_end.push_back(stage.ended_by);
    c.stage_values.insert(c.stage_values.end(), {stage.overshoot, stage.hold_error, stage.hold_stress});
  }

  schema::FileWriter file(path, schema::FileKind::checkpoint, fmt::format("mpfem {}", version()));
  const auto write = [&file](const auto& dataset, const auto& values, std::size_t rows) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    file.write(dataset, std::span<const T>(values), rows);
  };
  file.write_scalar(check::checksum, hash_text(c.checksum()));
  file.write_scalar(check::scenario, scenario_text);
  file.write_scalar(check::packing_hash, hash_text(model.mesh_hash));
  file.write_scalar(check::lanes, std::int32_t{TetBlock::lanes});
  write(check::run_integers, c.integers, c.integers.size());
  write(check::run_numbers, c.numbers, c.numbers.size());
  write(check::run_history, c.history, c.history.size());
  write(check::run_stage_name, stage_name, stage_name.size());
  write(check::run_stage_end, stage_end, stage_end.size());
  write(check::run_stage_values, c.stage_values, stage_name.size());
  write(check::run_snapshots, record.snapshot_files, record.snapshot_files.size());
  const auto nodes = static_cast<std::size_t>(model.nodes()), tets = static_cast<std::size_t>(model.tets());
  write(check::node_position, c.position, nodes);
  write(check::node_velocity, c.velocity, nodes);
  write(check::node_force, c.force, nodes);
  write(check::tet_deviator, c.tet.deviator, tets);
  write(check::tet_flow_stress, c.tet.flow_stress, tets);
  write(check::tet_plastic_strain, c.tet.plastic_strain, tets);
  write(check::tet_length, c.tet.length, tets);
  write(check::grain_travel, c.travel, c.travel.size());
  write(check::grain_travel_at_search, c.travel_at_search, c.travel_at_search.size());
  write(check::contact_pair_first, c.pair_first, c.pair_first.size());
  write(check::contact_pair_second, c.pair_second, c.pair_second.size());
  write(check::contact_pair_point_offset, c.pair_point_offset, c.pair_point_offset.size());
  write(check::contact_point_node, c.point_node, c.point_node.size());
  write(check::contact_point_facet_offset, c.point_facet_offset, c.point_facet_offset.size());
  write(check::contact_candidate_facet, c.candidate_facet, c.candidate_facet.size());
  write(check::contact_point_facet, c.point_facet, c.point_facet.size());
  write(check::contact_point_wake, c.point_wake, c.point_wake.size());
  write(check::contact_point_sure, c.point_sure, c.point_sure.size());
  if (contact.bonding) {
    write(check::bond_facet, c.bond_facet, c.bond_facet.size());
    write(check::bond_values, c.bond_values, c.bond_facet.size());
  }
  if (simulation.grips().present()) {
    write(check::grip_node, c.grip_node, c.grip_node.size());
    write(check::grip_side, c.grip_side, c.grip_side.size());
    write(check::grip_reference, c.grip_reference, c.grip_node.size());
  }
  file.commit();
}

void read_checkpoint(const std::string& path, Simulation& simulation, RunRecord& record,
                     const std::string& scenario_text, bool any_scenario) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  Contents c;
  c.integers = file.read(check::run_integers);
  c.numbers = file.read(check::run_numbers);
  c.history = file.read(check::run_history);
  c.position = file.read(check::node_position);
  c.velocity = file.read(check::node_velocity);
  c.force = file.read(check::node_force);
  c.tet = {file.read(check::tet_deviator), file.read(check::tet_flow_stress), file.read(check::tet_plastic_strain),
           file.read(check::tet_length)};
  c.travel = file.read(check::grain_travel);
  c.travel_at_search = file.read(check::grain_travel_at_search);
  c.pair_first = file.read(check::contact_pair_first);
  c.pair_second = file.read(check::contact_pair_second);
  c.pair_point_offset = file.read(check::contact_pair_point_offset);
  c.point_node = file.read(check::contact_point_node);
  c.point_facet_offset = file.read(check::contact_point_facet_offset);
  c.candidate_facet = file.read(check::contact_candidate_facet);
  c.point_facet = file.read(check::contact_point_facet);
  c.point_wake = file.read(check::contact_point_wake);
  c.point_sure = file.read(check::contact_point_sure);
  if (file.has(check::run_stage_values)) c.stage_values = file.read(check::run_stage_values);
  const bool bonded = file.has(check::bond_facet);
  if (bonded) {
    c.bond_facet = file.read(check::bond_facet);
    c.bond_values = file.read(check::bond_values);
  }
  if (file.has(check::grip_node)) {
    c.grip_node = file.read(check::grip_node);
    c.grip_side = file.read(check::grip_side);
    c.grip_reference = file.read(check::grip_reference);
  }
  if (file.read_scalar(check::checksum) != hash_text(c.checksum()))
    throw InputError(fmt::format("{}: the checkpoint is damaged: its numbers do not match its checksum", path));

  Model& model = simulation.model();
  if (file.read_scalar(check::packing_hash) != hash_text(model.mesh_hash))
    throw InputError(fmt::format("{}: the checkpoint belongs to another packing than the scenario's", path));
  if (!any_scenario && file.read_scalar(check::scenario) != scenario_text)
    throw InputError(
        fmt::format("{}: the checkpoint belongs to another scenario; run without --resume to begin anew", path));
  if (file.read_scalar(check::lanes) != TetBlock::lanes)
    throw InputError(
        fmt::format("{}: the checkpoint was written by a build with {} lanes, this one has {}: nodes and tets "
                    "would not go on bitwise",
                    path, file.read_scalar(check::lanes), TetBlock::lanes));

  // A branch goes on with the same matter: its stresses and strains mean nothing in another material.
  if (any_scenario) {
    const std::string earlier = file.read_scalar(check::scenario);
    const Scenario before = read_scenario(TomlDocument::from_text(earlier, path)),
                   now = read_scenario(TomlDocument::from_text(scenario_text, path));
    if (before.material != now.material)
      throw InputError(
          fmt::format("{}: the checkpoint's material differs from the scenario's, allowed the same [material]", path));
    // Bonds that are whole hold nothing but their places, so that the law may still be chosen.
    bool damaged = false;
    for (std::size_t i = 0; i < c.bond_facet.size(); ++i)
      damaged = damaged || (c.bond_facet[i] >= 0 && c.bond_values[6 * i + 4] < 1) || c.bond_values[6 * i + 5] > 0;
    if (bonded && before.bond != now.bond && (damaged || !now.bond))
      throw InputError(fmt::format(
          "{}: the checkpoint has bonds of another law than the scenario's, allowed the same [bond]", path));
    if (bonded && before.contact.penalty_differs(now.contact)) // a damaged bond's separations belong to its stiffness
      throw InputError(fmt::format(
          "{}: the checkpoint has bonds of another penalty than the scenario's, allowed the same contact.stiffness "
          "and contact.stiffness_factor",
          path));
  }
  std::size_t numbers = 0;
  for_each_number(simulation.state(), record, [&](double&) { ++numbers; });
  if (c.integers.size() != integers(simulation.state()).size() || c.numbers.size() != numbers)
    throw InputError(fmt::format("{}: the checkpoint was written by another version of mpfem", path));
  set_integers(simulation.state(), c.integers);
  std::size_t next = 0;
  for_each_number(simulation.state(), record, [&](double& value) { value = c.numbers.at(next++); });
  if (any_scenario) { // its state is the beginning of the first stage
    RunState& state = simulation.state();
    state.stage = 0;
    state.stage_low = state.low, state.stage_high = state.high;
    state.stage_mean_stress = state.mean_stress;
  }
  try {
    record.history = unflatten(c.history);
  } catch (const std::length_error&) {
    throw InputError(fmt::format("{}: the checkpoint was written by a build with other history columns", path));
  }
  record.snapshot_files = file.read(check::run_snapshots);
  if (file.has(check::run_stage_values)) {
    const auto name = file.read(check::run_stage_name), end = file.read(check::run_stage_end);
    for (std::size_t i = 0; i < name.size(); ++i)
      record.stages.push_back(
          {name[i], end[i], c.stage_values[3 * i], c.stage_values[3 * i + 1], c.stage_values[3 * i + 2], 0});
  }
  model.position.assign(c.position.begin(), c.position.end());
  model.velocity.assign(c.velocity.begin(), c.velocity.end());
  model.force.assign(c.force.begin(), c.force.end());
  for_each_tet(model, [&](TetBlock& block, int lane, std::size_t tet) {
    for (std::size_t k = 0; k < 5; ++k) block.deviator[k][lane] = c.tet.deviator[5 * tet + k];
    block.flow_stress[lane] = c.tet.flow_stress[tet];
    block.plastic_strain[lane] = c.tet.plastic_strain[tet];
    block.length[lane] = c.tet.length[tet];
  });
  // Unused lanes of a grain's last block repeat its last tet.
  for (int grain = 0; grain < model.grains; ++grain) {
    const std::int32_t last = model.block_offset[static_cast<std::size_t>(grain) + 1] - 1;
    TetBlock& block = model.block[static_cast<std::size_t>(last)];
    const int used = model.tets_in_block(grain, last);
    for (int lane = used; lane < TetBlock::lanes; ++lane) {
      for (auto& component : block.deviator) component[lane] = component[used - 1];
      block.flow_stress[lane] = block.flow_stress[used - 1];
      block.plastic_strain[lane] = block.plastic_strain[used - 1];
      block.length[lane] = block.length[used - 1];
    }
  }

  Contact& contact = simulation.contact();
  ContactCandidates& k = contact.candidates;
  k.pair_first = c.pair_first, k.pair_second = c.pair_second, k.pair_point_offset = c.pair_point_offset;
  k.point_node = c.point_node, k.point_facet_offset = c.point_facet_offset, k.point_facet = c.candidate_facet;
  index_pairs(k, model.grains);
  contact.travel = c.travel, contact.travel_at_search = c.travel_at_search;
  contact.point_facet = c.point_facet, contact.point_wake = c.point_wake, contact.point_sure = c.point_sure;
  contact.force.resize(k.point_node.size());
  contact.active.assign(k.pair_first.size(), 0);
  if (contact.bonding) {
    // A checkpoint without bonds goes on with them: they form where grains touch.
    contact.bond.assign(k.point_node.size(), {});
    contact.bond_force.resize(k.point_node.size());
    contact.pulling.assign(k.pair_first.size(), 0);
    for (std::size_t i = 0; i < c.bond_facet.size(); ++i) {
      const double* v = &c.bond_values[6 * i];
      contact.bond[i] = {.facet = c.bond_facet[i],
                         .weight1 = v[0],
                         .weight2 = v[1],
                         .state = {v[2], v[3]},
                         .remaining = v[4],
                         .spent = v[5],
                         .opening = 0,
                         .separation = 0};
    }
  }
  Grips grips;
  if (const auto& grip = simulation.stage().grip; grip && !c.grip_node.empty()) {
    grips = {
        .axis = static_cast<std::size_t>(grip->axis), .lateral_fixed = grip->lateral_fixed, .node = {}, .offset = {}};
    for (std::size_t i = 0; i < c.grip_node.size(); ++i)
      grips.node.push_back({c.grip_node[i],
                            c.grip_side[i],
                            {c.grip_reference[3 * i], c.grip_reference[3 * i + 1], c.grip_reference[3 * i + 2]}});
    grips.make_offsets(model.node_offset);
  }
  simulation.restored(std::move(grips));
}

} // namespace mpfem
