#include "solver/output/run_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"
#include "common/physical_host.hpp"
#include "common/version.hpp"
#include "results-schema/descriptors.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/tool_geometry.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

/// Rows of four doubles in the solver's order to rows of three floats in file order.
std::vector<float> in_file_order(const Model& model, const LazyArray<double>& rows) {
  std::vector<float> result(3 * static_cast<std::size_t>(model.nodes()));
  for (std::size_t n = 0; n < model.file_node.size(); ++n)
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[3 * static_cast<std::size_t>(model.file_node[n]) + axis] = static_cast<float>(rows[4 * n + axis]);
  return result;
}

/// Normal traction at surface nodes: the sum of contact, bond and wall forces along the inward normal over the
/// tributary area.
std::vector<float> contact_pressure(const SnapshotState& state) {
  const Model& model = state.model;
  const Contact& contact = state.contact;
  std::vector<double> force(static_cast<std::size_t>(model.nodes()), 0.0);
  const auto add = [&](std::int32_t node, double share, const ContactForce& point) {
    const double* normal = &model.normal[4 * static_cast<std::size_t>(node)];
    for (std::size_t axis = 0; axis < 3; ++axis)
      force[static_cast<std::size_t>(node)] -= share * point.force[axis] * normal[axis];
  };
  for (std::size_t pair = 0; pair < contact.active.size(); ++pair)
    for (const auto points : {contact.active_points(static_cast<std::int32_t>(pair)),
                              contact.pulling_bonds(static_cast<std::int32_t>(pair))})
      for (const ContactForce& point : points) {
        add(point.node, 1.0, point);
        for (int c = 0; c < 3; ++c) add(point.facet_node[c], -point.weight(c), point);
      }
  std::vector<float> pressure(force.size(), 0.0F);
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t n = model.node_offset[g]; n < model.node_offset[g] + model.surface_node_count[g]; ++n) {
      const auto node = static_cast<std::size_t>(n);
      const double area = model.normal[4 * node + 3];
      const double push =
          force[node] + state.box.wall_force_on_node(model, node, grain) + state.tools.push_on_node(model, node, grain);
      pressure[static_cast<std::size_t>(model.file_node[node])] = area > 0 ? static_cast<float>(push / area) : 0.0F;
    }
  }
  return pressure;
}

template <class Dataset, class Values>
void write_rows(schema::FileWriter& file, const std::string& name, const Dataset& dataset, const Values& values,
                std::size_t rows) {
  file.write(dataset, std::span<const typename Values::value_type>(values), rows, name);
}

/// Writes what the bonds of each pair of grains come to.
void write_bonds_of_pairs(schema::FileWriter& file, const std::string& name, const std::vector<PairContact>& pairs) {
  std::vector<double> bonded_area, pair_damage, energy, dissipation;
  for (const PairContact& pair : pairs) {
    const BondSums& b = pair.bonds;
    bonded_area.push_back(0.5 * b.bonded_area);
    pair_damage.push_back(b.formed_area > 0 ? b.damaged_area / b.formed_area : -1.0);
    energy.push_back(b.stored);
    dissipation.push_back(b.dissipated);
  }
  write_rows(file, name, run::snapshots_pair_bonded_area, bonded_area, pairs.size());
  write_rows(file, name, run::snapshots_pair_damage, pair_damage, pairs.size());
  write_rows(file, name, run::snapshots_pair_bond_energy, energy, pairs.size());
  write_rows(file, name, run::snapshots_pair_damage_dissipation, dissipation, pairs.size());
}

/// Writes what friction stores and has dissipated between the grains of each pair.
void write_friction_of_pairs(schema::FileWriter& file, const std::string& name, const std::vector<PairContact>& pairs) {
  std::vector<double> stored, dissipated;
  for (const PairContact& pair : pairs) {
    stored.push_back(pair.friction.stored);
    dissipated.push_back(pair.friction.dissipated);
  }
  write_rows(file, name, run::snapshots_pair_friction_energy, stored, pairs.size());
  write_rows(file, name, run::snapshots_pair_friction_dissipation, dissipated, pairs.size());
}

/// Writes what the walls bear of each grain.
void write_wall_forces(schema::FileWriter& file, const std::string& name, const Model& model, const Box& box) {
  std::vector<double> force;
  for (int grain = 0; grain < model.grains; ++grain) {
    const std::array<double, 6> of_grain = box.wall_forces_on_grain(model, grain);
    force.insert(force.end(), of_grain.begin(), of_grain.end());
  }
  write_rows(file, name, run::snapshots_wall_force, force, static_cast<std::size_t>(model.grains));
}

/// Writes the friction of the walls on each grain.
void write_wall_friction(schema::FileWriter& file, const std::string& name, const WallFriction& friction) {
  std::vector<double> force;
  for (int grain = 0; grain < friction.grains(); ++grain) {
    const std::array<double, 12> of_grain = friction.forces_on_grain(grain);
    force.insert(force.end(), of_grain.begin(), of_grain.end());
  }
  write_rows(file, name, run::snapshots_wall_friction, force, static_cast<std::size_t>(friction.grains()));
}

/// Writes every bond of a snapshot, and the mean damage at nodes.
void write_bonds(schema::FileWriter& file, const std::string& name, const Model& model, const Contact& contact) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  std::vector<double> sum(nodes, 0.0), count(nodes, 0.0);
  std::vector<std::int32_t> node, grain, law;
  std::vector<float> damage, separation;
  std::vector<double> area, dissipation;
  const ContactCandidates& candidates = contact.candidates;
  for (std::size_t p = 0; p < candidates.pair_first.size(); ++p)
    for (std::int32_t i = candidates.pair_point_offset[p]; i < candidates.pair_point_offset[p + 1]; ++i) {
      const PointBond& bond = contact.bond[static_cast<std::size_t>(i)];
      if (!bond.exists() && bond.spent == 0) continue;
      const auto n = static_cast<std::size_t>(candidates.point_node[static_cast<std::size_t>(i)]);
      const auto file_node = static_cast<std::size_t>(model.file_node[n]);
      const double d = bond.exists() ? 1.0 - bond.remaining : 1.0;
      sum[file_node] += d;
      count[file_node] += 1.0;
      node.push_back(model.file_node[n]);
      grain.push_back(candidates.pair_second[p]);
      damage.push_back(static_cast<float>(d));
      area.push_back(model.reference_area[n]);
      law.push_back(bond.law);
      dissipation.push_back(bond_dissipation(model, contact, static_cast<std::int32_t>(p), i));
      const double sliding = std::sqrt(std::max(bond.separation * bond.separation - bond.opening * bond.opening, 0.0));
      separation.insert(separation.end(), {static_cast<float>(bond.opening), static_cast<float>(sliding)});
    }
  std::vector<float> nodal(nodes, -1.0F);
  for (std::size_t n = 0; n < nodes; ++n)
    if (count[n] > 0) nodal[n] = static_cast<float>(sum[n] / count[n]);
  write_rows(file, name, run::snapshots_damage, nodal, nodes);
  write_rows(file, name, run::snapshots_bond_node, node, node.size());
  write_rows(file, name, run::snapshots_bond_grain, grain, node.size());
  write_rows(file, name, run::snapshots_bond_damage, damage, node.size());
  write_rows(file, name, run::snapshots_bond_area, area, node.size());
  write_rows(file, name, run::snapshots_bond_dissipation, dissipation, node.size());
  write_rows(file, name, run::snapshots_bond_separation, separation, node.size());
  if (contact.bond_laws.size() > 1) {
    write_rows(file, name, run::snapshots_bond_law, law, node.size());
    write_rows(file, name, run::snapshots_bond_laws, flatten(contact.bond_laws), contact.bond_laws.size());
  }
}

/// Connectivity, back in file order.
void write_mesh(schema::FileWriter& file, const Model& model) {
  std::vector<std::int32_t> tet(4 * static_cast<std::size_t>(model.tets()));
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t t = model.tet_offset[g]; t < model.tet_offset[g + 1]; ++t) {
      const auto corner = model.nodes_of_tet(grain, t - model.tet_offset[g]);
      for (std::size_t c = 0; c < 4; ++c)
        tet[4 * static_cast<std::size_t>(model.file_tet[static_cast<std::size_t>(t)]) + c] =
            model.file_node[static_cast<std::size_t>(model.node_offset[g] + corner[c])];
    }
  }
  file.write(run::mesh_tet, std::span<const std::int32_t>(tet), static_cast<std::size_t>(model.tets()));
  file.write(run::mesh_grain_node_offset, std::span<const std::int32_t>(model.node_offset), model.node_offset.size());
  file.write(run::mesh_grain_tet_offset, std::span<const std::int32_t>(model.tet_offset), model.tet_offset.size());
}

void write_stages(schema::FileWriter& file, const std::vector<StageResult>& stages) {
  std::vector<std::string> name, end;
  std::vector<double> overshoot, hold_error, hold_rms;
  for (const StageResult& stage : stages) {
    name.push_back(stage.name);
    end.push_back(stage.ended_by);
    overshoot.push_back(stage.overshoot);
    hold_error.push_back(stage.hold_error);
    hold_rms.push_back(stage.hold_rms);
  }
  file.write(run::provenance_stage_name, std::span<const std::string>(name), name.size());
  file.write(run::provenance_stage_end, std::span<const std::string>(end), end.size());
  file.write(run::provenance_stage_overshoot, std::span<const double>(overshoot), overshoot.size());
  file.write(run::provenance_stage_hold_error, std::span<const double>(hold_error), hold_error.size());
  file.write(run::provenance_stage_hold_rms, std::span<const double>(hold_rms), hold_rms.size());
}

void write_provenance(schema::FileWriter& file, const Model& model, const Provenance& provenance) {
  file.write_scalar(run::provenance_version, std::string(version()));
  file.write_scalar(run::provenance_scenario, provenance.scenario_text);
  file.write_scalar(run::provenance_packing_hash, hash_text(model.mesh_hash));
  file.write_scalar(run::provenance_smooth_grains, std::int32_t{model.smooth_grains});
  file.write_scalar(run::provenance_seed, model.seed);
  file.write_scalar(run::provenance_host, physical_host());
  file.write_scalar(run::provenance_threads, std::int32_t{provenance.threads});
  file.write_scalar(run::provenance_wall_time, provenance.wall_time);
  file.write(run::provenance_profile_name, std::span<const std::string>(provenance.profile_name),
             provenance.profile_name.size());
  file.write(run::provenance_profile_seconds, std::span<const double>(provenance.profile_seconds),
             provenance.profile_seconds.size());
  file.write_scalar(run::provenance_status, provenance.status);
  write_stages(file, provenance.stages);
  if (!provenance.from.empty()) file.write_scalar(run::provenance_from, provenance.from);
}

std::vector<NamedTool> names_of(const Tools& tools) {
  std::vector<NamedTool> names;
  for (std::size_t i = 0; i < tools.size(); ++i) names.push_back({tools[i].name, tools[i].adhesion.has_value()});
  return names;
}

} // namespace

void write_snapshot_file(const std::string& path, const SnapshotState& state) {
  const Model& model = state.model;
  const std::string name = "0000";
  schema::FileWriter file(path, schema::FileKind::run, fmt::format("mpfem {}", version_and_commit()));
  file.write_scalar(run::snapshots_time, state.time, name);
  file.write_scalar(run::snapshots_step, state.step, name);
  file.write_scalar(run::snapshots_relative_density, state.relative_density, name);
  file.write_scalar(run::snapshots_mean_stress, state.box.mean_stress(), name);
  file.write(run::snapshots_box_low, std::span<const double>(state.box.cell().low), 3, name);
  file.write(run::snapshots_box_high, std::span<const double>(state.box.cell().high), 3, name);
  const auto nodes = static_cast<std::size_t>(model.nodes()), tets = static_cast<std::size_t>(model.tets());
  const auto position = in_file_order(model, model.position), velocity = in_file_order(model, model.velocity);
  file.write(run::snapshots_node, std::span<const float>(position), nodes, name);
  file.write(run::snapshots_velocity, std::span<const float>(velocity), nodes, name);
  const TetFields fields = tet_fields(model);
  file.write(run::snapshots_von_mises, std::span<const float>(fields.von_mises), tets, name);
  file.write(run::snapshots_pressure, std::span<const float>(fields.pressure), tets, name);
  file.write(run::snapshots_plastic_strain, std::span<const float>(fields.plastic_strain), tets, name);
  const auto pressure = contact_pressure(state);
  file.write(run::snapshots_contact_pressure, std::span<const float>(pressure), nodes, name);
  std::vector<std::int32_t> grains;
  std::vector<double> force, area;
  const auto pairs = pair_contacts(model, state.contact);
  for (const PairContact& pair : pairs) {
    grains.insert(grains.end(), {pair.first, pair.second});
    force.insert(force.end(), std::begin(pair.force), std::end(pair.force));
    area.push_back(pair.area);
  }
  file.write(run::snapshots_pair_grains, std::span<const std::int32_t>(grains), area.size(), name);
  file.write(run::snapshots_pair_force, std::span<const double>(force), area.size(), name);
  file.write(run::snapshots_pair_area, std::span<const double>(area), area.size(), name);
  write_wall_forces(file, name, model, state.box);
  if (state.wall_friction.present()) write_wall_friction(file, name, state.wall_friction);
  write_placed_tools(file, name, state.tools);
  if (state.contact.has_friction()) write_friction_of_pairs(file, name, pairs);
  if (state.contact.bonding()) {
    write_bonds_of_pairs(file, name, pairs);
    write_bonds(file, name, model, state.contact);
  }
  file.commit();
}

void write_run_file(const std::string& path, const Model& model, const RunHistory& history,
                    const std::vector<std::string>& snapshot_files, const Provenance& provenance) {
  schema::FileWriter file(path, schema::FileKind::run, fmt::format("mpfem {}", version_and_commit()));
  write_history(file, history.rows, provenance.columns);
  write_tool_history(file, names_of(history.tools), history.tool_rows);
  write_tool_geometry(file, history.tools);

  write_mesh(file, model);
  for (std::size_t i = 0; i < snapshot_files.size(); ++i) {
    const schema::FileReader from(snapshot_files[i], schema::FileKind::run);
    file.copy_snapshot(from, "0000", fmt::format("{:04}", i));
  }

  write_provenance(file, model, provenance);
  file.commit();
}

RunSummary read_run_summary(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  const auto density = file.read(run::history_relative_density);
  if (density.empty()) throw InputError(fmt::format("{}: the history has no rows", one_line(path)));
  return {.status = file.read_scalar(run::provenance_status),
          .scenario_text = file.read_scalar(run::provenance_scenario),
          .packing_hash = file.read_scalar(run::provenance_packing_hash),
          .from = file.has(run::provenance_from) ? file.read_scalar(run::provenance_from) : "",
          .first_density = density.front(),
          .largest_density = *std::max_element(density.begin(), density.end())};
}

} // namespace mpfem
