#include "solver/output/checkpoint.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "common/table_reader.hpp"
#include "common/version.hpp"
#include "results-schema/descriptors.hpp"
#include "results-schema/file.hpp"
#include "solver/model/tets.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/history.hpp"
#include "solver/output/other_scenario.hpp"

namespace mpfem {

namespace {

namespace check = schema::checkpoint;

std::vector<std::int64_t> integers(const RunState& s) {
  return {s.step,
          s.stage,
          s.rows_in_stage,
          s.snapshots_passed,
          s.steps_since_estimate,
          s.controlled_by_contact,
          s.searches,
          s.stage_ended,
          s.absent_axes,
          s.checkpoints_passed,
          s.estimates_since_spectrum};
}

void set_integers(RunState& s, const std::vector<std::int64_t>& v) {
  s.step = v[0], s.stage = v[1], s.rows_in_stage = v[2], s.snapshots_passed = v[3], s.steps_since_estimate = v[4],
  s.controlled_by_contact = v[5], s.searches = v[6], s.stage_ended = v[7], s.absent_axes = v[8],
  s.checkpoints_passed = v[9], s.estimates_since_spectrum = v[10];
}

/// Calls f(double&) for every number of state and record, always in the same order.
template <class State, class Record, class F>
void for_each_number(State& s, Record& r, F&& f) {
  for (auto* value :
       {&s.time, &s.stage_time, &s.stable_step, &s.last_step, &s.strain_since_estimate, &s.strain_rate,
        &s.spectrum_rate, &s.initial_energy, &s.plastic_dissipation, &s.viscous_dissipation, &s.damping_dissipation,
        &s.external_work, &s.grip_work_ahead, &s.damping_force, &s.mean_stress, &s.stage_mean_stress, &r.wall_time})
    f(*value);
  for (auto* values : {&s.initial_lengths, &s.stage_low, &s.stage_high, &s.low, &s.high})
    for (auto& value : *values) f(value);
  for (auto* values : {&s.last_wall_force, &s.last_wall_move})
    for (auto& value : *values) f(value);
  for (auto& value : r.profile_seconds) f(value);
  // These states are numbers and nothing else.
  const auto each_of = [&]<class Numbers>(Numbers& state) {
    using Plain = std::remove_const_t<Numbers>;
    auto values = std::bit_cast<std::array<double, sizeof(Plain) / sizeof(double)>>(state);
    for (double& value : values) f(value);
    if constexpr (!std::is_const_v<Numbers>) state = std::bit_cast<Plain>(values);
  };
  each_of(s.loading), each_of(s.pace);
}

/// Of a tet's deviator, in the order of TetBlock. One array each: a copy of all five would be the most that a run holds.
constexpr std::array deviator_components = {check::tet_deviator_xx, check::tet_deviator_yy, check::tet_deviator_xy,
                                            check::tet_deviator_yz, check::tet_deviator_zx};

/// The hash that files of before every dataset had a checksum hold in /checksum. One array is in memory at a time: a
/// checkpoint may be as large as the model.
std::uint64_t earlier_checksum(const schema::FileReader& file) {
  std::uint64_t hash = hash_seed;
  const auto add = [&](const auto&... datasets) {
    const auto add_one = [&](const auto& dataset) {
      if (!file.has(dataset)) return; // of bonds and grips
      const auto values = file.read(dataset);
      hash = hash_values(std::span(values), hash);
    };
    (add_one(datasets), ...);
  };
  add(check::run_integers, check::run_numbers, check::run_history, check::run_stage_values, check::run_stage_hold_rms,
      check::node_position, check::node_velocity, check::node_force);
  for (const auto& component : deviator_components) add(component);
  add(check::tet_flow_stress, check::tet_plastic_strain, check::tet_length, check::grain_step, check::grain_step_growth,
      check::node_step_contact, check::grain_travel, check::grain_travel_at_search, check::contact_point_wake,
      check::contact_point_sure, check::contact_pair_first, check::contact_pair_second,
      check::contact_pair_point_offset, check::contact_point_node, check::contact_point_facet_offset,
      check::contact_candidate_facet, check::contact_point_facet, check::bond_facet, check::bond_values,
      check::bond_laws, check::bond_law, check::grip_node, check::grip_side, check::grip_reference);
  return hash;
}

/// Of the order of nodes and tets, in which arrays stand in a checkpoint.
std::uint64_t numbering_hash(const Model& model) {
  return hash_values(std::span<const std::int32_t>(model.file_tet),
                     hash_values(std::span<const std::int32_t>(model.file_node)));
}

/// One number of every tet, in block order; `values(block)` gives its lanes.
template <class Values>
std::vector<double> of_tets(const Model& model, Values&& values) {
  std::vector<double> result(static_cast<std::size_t>(model.tets()));
  for_each_tet(model, [&](const auto& block, int lane, std::size_t tet) { result[tet] = values(block)[lane]; });
  return result;
}

} // namespace

void write_checkpoint(const std::string& path, const Simulation& simulation, const RunRecord& record,
                      const std::string& scenario_text) {
  const Model& model = simulation.model();
  const Contact& contact = simulation.contact();
  const ContactCandidates& candidates = contact.candidates;
  schema::FileWriter file(path, schema::FileKind::checkpoint, fmt::format("mpfem {}", version_and_commit()));
  file.write_scalar(check::scenario, scenario_text);
  file.write_scalar(check::packing_hash, hash_text(model.mesh_hash));
  file.write_scalar(check::numbering_hash, hash_text(numbering_hash(model)));
  file.write_scalar(check::smooth_grains, std::int32_t{model.smooth_grains});
  file.write_scalar(check::lanes, std::int32_t{native_lanes});
  const auto write_texts = [&file](const auto& dataset, const std::vector<std::string>& texts) {
    file.write(dataset, std::span<const std::string>(texts), texts.size());
  };
  std::vector<std::string> stage_name, stage_end;
  std::vector<double> stage_values, stage_hold_rms;
  for (const StageResult& stage : record.stages) {
    stage_name.push_back(stage.name);
    stage_end.push_back(stage.ended_by);
    stage_values.insert(stage_values.end(), {stage.overshoot, stage.hold_error, stage.hold_stress});
    stage_hold_rms.push_back(stage.hold_rms);
  }
  write_texts(check::run_snapshots, record.snapshot_files);
  write_texts(check::run_stage_name, stage_name);
  write_texts(check::run_stage_end, stage_end);
  if (!record.from.empty()) file.write_scalar(check::run_from, record.from);

  std::vector<double> numbers;
  for_each_number(simulation.state(), record, [&](double value) { numbers.push_back(value); });
  const auto nodes = static_cast<std::size_t>(model.nodes());
  const auto write_rows = [&file](const auto& dataset, const auto& values, std::size_t rows) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    file.write(dataset, std::span<const T>(values.data(), values.size()), rows);
  };
  const auto write = [&](const auto& dataset, const auto& values) { write_rows(dataset, values, values.size()); };
  write(check::run_integers, integers(simulation.state()));
  write(check::run_numbers, numbers);
  write(check::run_history, flatten(record.history));
  write_rows(check::run_stage_values, stage_values, stage_name.size());
  write(check::run_stage_hold_rms, stage_hold_rms);
  write_rows(check::node_position, model.position, nodes);
  write_rows(check::node_velocity, model.velocity, nodes);
  write_rows(check::node_force, model.force, nodes);
  for (std::size_t c = 0; c < deviator_components.size(); ++c)
    write(deviator_components[c], of_tets(model, [c](const auto& b) { return b.deviator[c]; }));
  write(check::tet_flow_stress, of_tets(model, [](const auto& b) { return b.flow_stress; }));
  write(check::tet_plastic_strain, of_tets(model, [](const auto& b) { return b.plastic_strain; }));
  write(check::tet_length, of_tets(model, [](const auto& b) { return b.length; }));
  write(check::grain_step, simulation.grain_steps().whole);
  write(check::grain_step_growth, simulation.grain_steps().growth);
  write(check::node_step_contact, simulation.grain_steps().contact);
  write(check::grain_travel, contact.travel);
  write(check::grain_travel_at_search, contact.travel_at_search);
  write(check::contact_point_wake, contact.point_open_until);
  write(check::contact_point_sure, contact.point_facet_until);
  write(check::contact_pair_first, candidates.pair_first);
  write(check::contact_pair_second, candidates.pair_second);
  write(check::contact_pair_point_offset, candidates.pair_point_offset);
  write(check::contact_point_node, candidates.point_node);
  write(check::contact_point_facet_offset, candidates.point_facet_offset);
  write(check::contact_candidate_facet, candidates.point_facet);
  write(check::contact_point_facet, contact.point_facet);
  if (contact.bonding()) {
    std::vector<std::int32_t> facet, number;
    std::vector<double> values;
    for (const PointBond& bond : contact.bond) {
      facet.push_back(bond.facet);
      number.push_back(bond.law);
      values.insert(values.end(), {bond.weight1, bond.weight2, bond.state.initiation, bond.state.largest,
                                   bond.remaining, bond.spent});
    }
    write(check::bond_facet, facet);
    write_rows(check::bond_values, values, facet.size());
    write_rows(check::bond_laws, flatten(contact.bond_laws), contact.bond_laws.size());
    if (contact.bond_laws.size() > 1) write(check::bond_law, number);
  }
  if (simulation.grips().present()) {
    std::vector<std::int32_t> node, side;
    std::vector<double> reference;
    for (const GrippedNode& gripped : simulation.grips().node) {
      node.push_back(gripped.node);
      side.push_back(gripped.side);
      reference.insert(reference.end(), gripped.reference.begin(), gripped.reference.end());
    }
    write(check::grip_node, node);
    write(check::grip_side, side);
    write_rows(check::grip_reference, reference, node.size());
  }
  file.commit();
}

namespace {

/// Grains that touch by their smooth surface in a checkpoint. Those of before the number was kept had all of them where
/// the scenario said so, and none where it did not.
int smooth_grains_before(const schema::FileReader& file, const Scenario& before, const Model& model) {
  if (file.has(check::smooth_grains)) return file.read_scalar(check::smooth_grains);
  return before.contact.surface == ContactSurface::smooth ? model.grains : 0;
}

/// Laws by which the bonds in a checkpoint formed. In files of before they were kept it was the scenario's for all.
std::vector<BondLaw> bond_laws_before(const schema::FileReader& file, const BondParameters& bond) {
  if (!file.has(check::bond_laws)) return {law_of_bonds(bond)};
  return unflatten_bond_laws(file.read(check::bond_laws), bond.normal_only);
}

/// Takes the bonds of a checkpoint into `bonds` [points], whose laws are so many. False where the file is damaged.
bool take_bonds(const schema::FileReader& file, std::int32_t facets, std::size_t laws, std::vector<PointBond>& bonds) {
  const std::size_t points = bonds.size();
  const auto facet = file.read(check::bond_facet);
  const auto values = file.read(check::bond_values);
  const auto law = file.has(check::bond_law) ? file.read(check::bond_law) : std::vector<std::int32_t>(points, 0);
  if (facet.size() != points || values.size() != 6 * points || law.size() != points) return false;
  for (std::size_t i = 0; i < points; ++i) {
    const double* v = &values[6 * i];
    if (law[i] < 0 || static_cast<std::size_t>(law[i]) >= laws || facet[i] < -1 || facet[i] >= facets) return false;
    bonds[i] = {.facet = facet[i],
                .law = law[i],
                .weight1 = v[0],
                .weight2 = v[1],
                .state = {v[2], v[3]},
                .remaining = v[4],
                .spent = v[5],
                .opening = 0,
                .separation = 0};
  }
  return true;
}

/// What tells a checkpoint's content from others: the hash of its list of datasets or, in files of before there was
/// one, of its numbers.
std::string content_hash(const schema::FileReader& file) {
  if (!file.checksums().empty()) return file.checksums();
  if (file.has(check::checksum)) return file.read_scalar(check::checksum);
  throw InputError(
      fmt::format("{}: the checkpoint has no checksum, allowed: a file as mpfem wrote it", one_line(file.path())));
}

/// Throws InputError where the numbers of an earlier version's file do not match its checksum.
void check_content_hash(const schema::FileReader& file) {
  if (const std::string hash = content_hash(file);
      hash != file.checksums() && hash != hash_text(earlier_checksum(file)))
    throw InputError(fmt::format("{}: the checkpoint is damaged: its numbers do not match its checksum",
                                 one_line(file.path())));
}

/// Whether a bond has formed by the checkpoint.
bool has_bonds(const schema::FileReader& file) {
  if (!file.has(check::bond_facet)) return false;
  const auto facet = file.read(check::bond_facet);
  if (std::any_of(facet.begin(), facet.end(), [](std::int32_t f) { return f >= 0; })) return true;
  const auto values = file.read(check::bond_values); // broken and not formed again: what they spent is left
  for (std::size_t i = 5; i < values.size(); i += 6)
    if (values[i] > 0) return true;
  return false;
}

} // namespace

void read_checkpoint(const std::string& path, Simulation& simulation, RunRecord& record,
                     const std::string& scenario_text, bool any_scenario) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  const auto damaged = [&path] {
    return InputError(fmt::format("{}: the checkpoint is damaged: its numbers do not belong together", path));
  };
  const bool bonded = has_bonds(file);

  Model& model = simulation.model();
  if (file.read_scalar(check::packing_hash) != hash_text(model.mesh_hash))
    throw InputError(fmt::format("{}: the checkpoint belongs to another packing than the scenario's", path));
  // Arrays stand in the order of nodes and tets, which versions may choose otherwise.
  if (!file.has(check::numbering_hash) || file.read_scalar(check::numbering_hash) != hash_text(numbering_hash(model)))
    throw InputError(
        fmt::format("{}: the checkpoint was written by a version of mpfem that orders nodes and tets otherwise", path));
  check_content_hash(file);
  if (!any_scenario && file.read_scalar(check::scenario) != scenario_text)
    throw InputError(fmt::format("{}: the checkpoint belongs to another scenario{}; run without --resume to begin anew",
                                 path, scenario_difference(file.read_scalar(check::scenario), scenario_text)));
  if (file.read_scalar(check::lanes) != native_lanes)
    throw InputError(
        fmt::format("{}: the checkpoint was written by a build with {} lanes, this one has {}: nodes and tets "
                    "would not go on bitwise",
                    path, file.read_scalar(check::lanes), native_lanes));

  const Scenario before = read_scenario(TomlDocument::from_text(file.read_scalar(check::scenario), path));
  if (bonded && !before.bond) throw damaged();

  // All contacts would open or close by the height of the smooth surface at once.
  if (const int smooth = smooth_grains_before(file, before, model); smooth != model.smooth_grains)
    throw InputError(fmt::format(
        "{}: in the checkpoint {} of {} grains touch by their smooth surface, in the scenario {}; allowed the same "
        "contact.surface (earlier versions took facets where a scenario does not say)",
        path, smooth, model.grains, model.smooth_grains));

  // A branch goes on with the same matter: its stresses and strains mean nothing in another material.
  if (any_scenario) {
    const Scenario now = read_scenario(TomlDocument::from_text(scenario_text, path));
    if (before.material != now.material || before.grain_materials != now.grain_materials)
      throw InputError(
          fmt::format("{}: the checkpoint's material differs from the scenario's, allowed the same [material]", path));
    if (now.initial_velocity != std::array<double, 3>{} || !now.grain_velocity.empty() ||
        !now.grain_angular_velocity.empty())
      throw InputError(fmt::format("{}: [initial] has no meaning in a run that begins at a checkpoint: its grains move "
                                   "as they moved there",
                                   path));
    // Bonds keep the law by which they formed, and [bond] is that of bonds to come. Whether bonds resist sliding
    // decides how all of them are followed.
    if (bonded && (!now.bond || before.bond->normal_only != now.bond->normal_only))
      throw InputError(fmt::format("{}: the checkpoint has bonds{}, allowed a [bond] with the same normal_only", path,
                                   now.bond ? " of the other bond.normal_only" : ", the scenario has none"));
    if (bonded && before.contact.penalty_differs(now.contact)) // a damaged bond's separations belong to its stiffness
      throw InputError(fmt::format(
          "{}: the checkpoint has bonds of another penalty than the scenario's, allowed the same contact.stiffness "
          "and contact.stiffness_factor",
          path));
  }
  std::size_t expected = 0;
  for_each_number(simulation.state(), record, [&](double&) { ++expected; });
  const auto counters = file.read(check::run_integers);
  const auto numbers = file.read(check::run_numbers);
  if (counters.size() != integers(simulation.state()).size() || numbers.size() != expected)
    throw InputError(fmt::format("{}: the checkpoint was written by another version of mpfem", path));
  set_integers(simulation.state(), counters);
  std::size_t next = 0;
  for_each_number(simulation.state(), record, [&](double& value) { value = numbers.at(next++); });
  if (any_scenario) { // its state is the beginning of the first stage
    RunState& state = simulation.state();
    state.stage = 0;
    state.stage_low = state.low, state.stage_high = state.high;
    state.stage_mean_stress = state.mean_stress;
  }
  try {
    record.history = unflatten(file.read(check::run_history));
  } catch (const std::length_error&) {
    throw InputError(fmt::format("{}: the checkpoint was written by a build with other history columns", path));
  }
  record.snapshot_files = file.read(check::run_snapshots);
  if (file.has(check::run_stage_values)) {
    const auto name = file.read(check::run_stage_name), end = file.read(check::run_stage_end);
    const auto values = file.read(check::run_stage_values);
    const auto rms = file.read(check::run_stage_hold_rms);
    if (end.size() != name.size() || values.size() != 3 * name.size() || rms.size() != name.size()) throw damaged();
    for (std::size_t i = 0; i < name.size(); ++i)
      record.stages.push_back({name[i], end[i], values[3 * i], values[3 * i + 1], values[3 * i + 2], rms[i]});
  }

  if (file.has(check::run_from)) record.from = file.read_scalar(check::run_from);

  // One array at a time is in memory beside the model.
  const auto take = [&](const auto& dataset, std::size_t count) {
    auto values = file.read(dataset);
    if (values.size() != count) throw damaged();
    return values;
  };
  const auto nodes = static_cast<std::size_t>(model.nodes()), tets = static_cast<std::size_t>(model.tets());
  const auto take_nodes = [&](const auto& dataset, AlignedVector<double>& into) {
    const auto values = take(dataset, 4 * nodes);
    std::copy(values.begin(), values.end(), into.begin());
  };
  take_nodes(check::node_position, model.position);
  take_nodes(check::node_velocity, model.velocity);
  take_nodes(check::node_force, model.force);
  const auto take_tets = [&](const auto& dataset, const auto& place) {
    const auto values = take(dataset, tets);
    for_each_tet(model, [&](auto& block, int lane, std::size_t tet) {
      auto& number = place(block)[lane];
      number = static_cast<std::remove_reference_t<decltype(number)>>(values[tet]);
    });
  };
  for (std::size_t c = 0; c < deviator_components.size(); ++c)
    take_tets(deviator_components[c], [c](auto& b) { return b.deviator[c]; });
  take_tets(check::tet_flow_stress, [](auto& b) { return b.flow_stress; });
  take_tets(check::tet_plastic_strain, [](auto& b) { return b.plastic_strain; });
  take_tets(check::tet_length, [](auto& b) { return b.length; });
  fill_unused_lanes(model);

  Contact& contact = simulation.contact();
  ContactCandidates& k = contact.candidates;
  k.pair_first = file.read(check::contact_pair_first);
  const std::size_t pairs = k.pair_first.size();
  k.pair_second = take(check::contact_pair_second, pairs);
  k.pair_point_offset = take(check::contact_pair_point_offset, pairs + 1);
  k.point_node = file.read(check::contact_point_node);
  const std::size_t points = k.point_node.size();
  k.point_facet_offset = take(check::contact_point_facet_offset, points + 1);
  k.point_facet = file.read(check::contact_candidate_facet);
  index_pairs(k, model.grains);
  const auto grains = static_cast<std::size_t>(model.grains);
  simulation.grain_steps() = {take(check::grain_step, grains), take(check::grain_step_growth, grains),
                              take(check::node_step_contact, nodes)};
  contact.travel = take(check::grain_travel, grains);
  contact.travel_at_search = take(check::grain_travel_at_search, grains);
  contact.point_facet = take(check::contact_point_facet, points);
  contact.point_open_until = take(check::contact_point_wake, points);
  contact.point_facet_until = take(check::contact_point_sure, points);
  contact.force.resize(points);
  contact.active.assign(pairs, 0);
  if (contact.bonding()) {
    // A checkpoint without bonds goes on with them: they form where grains touch.
    contact.bond.assign(points, {});
    contact.bond_force.resize(points);
    contact.pulling.assign(pairs, 0);
    if (bonded) {
      const BondLaw coming = contact.bond_laws.back();
      contact.bond_laws = bond_laws_before(file, *before.bond);
      if (contact.bond_laws.empty() || !take_bonds(file, model.facets(), contact.bond_laws.size(), contact.bond))
        throw damaged();
      if (contact.bond_laws.back() != coming) contact.bond_laws.push_back(coming);
    }
  }
  Grips grips;
  if (const auto& grip = simulation.stage().grip; grip && file.has(check::grip_node)) {
    const auto node = file.read(check::grip_node);
    const auto side = take(check::grip_side, node.size());
    const auto reference = take(check::grip_reference, 3 * node.size());
    grips = {
        .axis = static_cast<std::size_t>(grip->axis), .lateral_fixed = grip->lateral_fixed, .node = {}, .offset = {}};
    for (std::size_t i = 0; i < node.size(); ++i)
      grips.node.push_back({node[i], side[i], {reference[3 * i], reference[3 * i + 1], reference[3 * i + 2]}});
    grips.make_offsets(model.node_offset);
  }
  simulation.restored(std::move(grips));
}

void begin_branch(const std::string& path, Simulation& simulation, const std::string& scenario_text) {
  RunRecord earlier;
  read_checkpoint(path, simulation, earlier, scenario_text, true);
  simulation.begin_branch();
}

void verify_checkpoint(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::checkpoint);
  file.verify();
  check_content_hash(file);
}

std::string checkpoint_checksum(const std::string& path) {
  return content_hash(schema::FileReader(path, schema::FileKind::checkpoint));
}

} // namespace mpfem
