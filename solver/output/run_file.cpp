#include "solver/output/run_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "common/one_line.hpp"
#include "common/physical_host.hpp"
#include "common/version.hpp"
#include "results-schema/descriptors.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/model/normals.hpp"
#include "solver/output/bond_laws.hpp"
#include "solver/output/gathered_file.hpp"
#include "solver/output/tool_geometry.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

using Index = std::int32_t;
using Counts = std::vector<std::int64_t>; ///< [grains]

/// Place of a node in the packing file among the nodes of its grain.
std::size_t place_in_grain(const Model& model, Index grain, std::size_t node) {
  return at(model.file_node[node] - model.node_offset[at(grain)]);
}

/// Writes rows of four doubles in the solver's order as rows of three floats in file order.
template <class Dataset>
void write_node_rows(GatheredFile& file, const std::string& name, const Dataset& dataset, const Model& model,
                     const LazyArray<double>& rows) {
  file.write_grains(
      dataset, rows_of_grains(model.node_offset),
      [&](Index grain, std::span<float> values) {
        for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n)
          for (std::size_t axis = 0; axis < 3; ++axis)
            values[3 * place_in_grain(model, grain, n) + axis] = static_cast<float>(rows[4 * n + axis]);
      },
      name);
}

/// Calls visit(pair) for the pairs that have a grain's nodes or facets, in ascending order.
template <class Visit>
void for_pairs_of(const ContactCandidates& candidates, Index grain, Visit&& visit) {
  const Index first = candidates.outgoing_offset[at(grain)], end = candidates.outgoing_offset[at(grain) + 1];
  Index incoming = candidates.incoming_offset[at(grain)];
  const Index incoming_end = candidates.incoming_offset[at(grain) + 1];
  for (; incoming < incoming_end && candidates.incoming_pair[at(incoming)] < first; ++incoming)
    visit(candidates.incoming_pair[at(incoming)]);
  for (Index pair = first; pair < end; ++pair) visit(pair);
  for (; incoming < incoming_end; ++incoming) visit(candidates.incoming_pair[at(incoming)]);
}

/// N, the sum of contact and bond forces on the nodes of a grain along their inward normals, opposite to `normals`.
std::vector<double> contact_push(const Model& model, const SurfaceNormals& normals, const Contact& contact,
                                 Index grain) {
  const Index first = model.node_offset[at(grain)];
  std::vector<double> push(at(model.node_offset[at(grain) + 1] - first), 0.0);
  const auto add = [&](Index node, double share, const ContactForce& point) {
    const Vector3<double> normal = normals.normal(at(node));
    for (std::size_t axis = 0; axis < 3; ++axis) push[at(node - first)] -= share * point.force[axis] * normal[axis];
  };
  for_pairs_of(contact.candidates, grain, [&](Index pair) {
    const bool of_nodes = contact.candidates.pair_first[at(pair)] == grain;
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points) {
        if (of_nodes)
          add(point.node, 1.0, point);
        else
          for (int c = 0; c < 3; ++c) add(point.facet_node[c], -point.weight(c), point);
      }
  });
  return push;
}

/// Writes the normal traction at surface nodes: the sum of contact, bond, wall and tool forces along the inward normal
/// over the tributary area.
void write_contact_pressure(GatheredFile& file, const std::string& name, const SnapshotState& state) {
  const Model& model = state.model;
  file.write_grains(
      run::snapshots_contact_pressure, rows_of_grains(model.node_offset),
      [&](Index grain, std::span<float> pressure) {
        std::ranges::fill(pressure, 0.0F);
        const SurfaceNormals normals(model, grain);
        const std::vector<double> contact = contact_push(model, normals, state.contact, grain);
        const std::size_t first = model.first_node(grain);
        for (std::size_t node = first; node < first + at(model.surface_node_count[at(grain)]); ++node) {
          const double area = normals.area(node);
          const double push = contact[node - first] + state.box.wall_force_on_node(model, node, grain) +
                              state.tools.push_on_node(model, node, grain);
          pressure[place_in_grain(model, grain, node)] = area > 0 ? static_cast<float>(push / area) : 0.0F;
        }
      },
      name);
}

/// Writes stresses and plastic strain.
void write_tet_fields(GatheredFile& file, const std::string& name, const Model& model) {
  const Counts tets = rows_of_grains(model.tet_offset);
  // Computed again for each field: keeping them for all tets would add a tenth to what a rank holds.
  const auto write = [&](const auto& dataset, std::vector<float> TetFields::*field) {
    file.write_grains(
        dataset, tets,
        [&](Index grain, std::span<float> values) {
          std::ranges::copy(tet_fields(model, grain).*field, values.begin());
        },
        name);
  };
  write(run::snapshots_von_mises, &TetFields::von_mises);
  write(run::snapshots_pressure, &TetFields::pressure);
  write(run::snapshots_plastic_strain, &TetFields::plastic_strain);
}

/// Writes one or several values for each of a grain's entries: set(entry, values).
template <class T, int Rank, class Entries, class Set>
void write_entries(GatheredFile& file, const std::string& name, const schema::Dataset<T, Rank>& dataset,
                   const Counts& counts, Entries&& entries_of, Set&& set) {
  const std::size_t columns = Rank == 2 ? dataset.extent[1].fixed : 1;
  file.write_grains(
      dataset, counts,
      [&](Index grain, std::span<T> values) {
        for (const auto& entry : entries_of(grain)) {
          set(entry, values.first(columns));
          values = values.subspan(columns);
        }
      },
      name);
}

/// Writes the contact of each pair of grains: force, area and, with bonds, their sums.
void write_pairs(GatheredFile& file, const std::string& name, const Model& model, const Contact& contact) {
  const auto pairs = pair_contacts(model, contact, file.ranks());
  const auto of_grain = [&](Index grain) {
    return std::ranges::equal_range(pairs, grain, {}, [](const PairContact& pair) { return pair.first; });
  };
  const Counts counts = count_of_grains(file.ranks(), model, [&](Index grain) { return of_grain(grain).size(); });
  const auto write = [&](const auto& dataset, auto&& set) {
    write_entries(file, name, dataset, counts, of_grain, set);
  };
  const auto write_number = [&](const auto& dataset, auto&& number) {
    write(dataset, [&](const PairContact& pair, std::span<double> value) { value[0] = number(pair); });
  };
  write(run::snapshots_pair_grains,
        [](const PairContact& pair, std::span<Index> grains) { grains[0] = pair.first, grains[1] = pair.second; });
  write(run::snapshots_pair_force,
        [](const PairContact& pair, std::span<double> force) { std::ranges::copy(pair.force, force.begin()); });
  write_number(run::snapshots_pair_area, [](const PairContact& pair) { return pair.area; });
  if (contact.has_friction()) {
    write_number(run::snapshots_pair_friction_energy, [](const PairContact& pair) { return pair.friction.stored; });
    write_number(run::snapshots_pair_friction_dissipation,
                 [](const PairContact& pair) { return pair.friction.dissipated; });
  }
  if (!contact.bonding()) return;
  write_number(run::snapshots_pair_bonded_area, [](const PairContact& pair) { return 0.5 * pair.bonds.bonded_area; });
  write_number(run::snapshots_pair_damage, [](const PairContact& pair) {
    return pair.bonds.formed_area > 0 ? pair.bonds.damaged_area / pair.bonds.formed_area : -1.0;
  });
  write_number(run::snapshots_pair_bond_energy, [](const PairContact& pair) { return pair.bonds.stored; });
  write_number(run::snapshots_pair_damage_dissipation, [](const PairContact& pair) { return pair.bonds.dissipated; });
}

/// Writes the force of each grain on the walls.
void write_wall_forces(GatheredFile& file, const std::string& name, const Model& model, const Box& box) {
  file.write_grains(
      run::snapshots_wall_force, Counts(at(model.grains), 1),
      [&](Index grain, std::span<double> force) {
        std::ranges::copy(box.wall_forces_on_grain(model, grain), force.begin());
      },
      name);
}

/// Writes the friction of the walls on each grain.
void write_wall_friction(GatheredFile& file, const std::string& name, const WallFriction& friction) {
  file.write_grains(
      run::snapshots_wall_friction, Counts(at(friction.grains()), 1),
      [&](Index grain, std::span<double> force) { std::ranges::copy(friction.forces_on_grain(grain), force.begin()); },
      name);
}

/// A point that has, or had, a bond.
struct PointOfBond {
  Index pair, point;
};

/// The points of a grain's nodes.
std::vector<PointOfBond> bonds_of(const Contact& contact, Index grain) {
  std::vector<PointOfBond> bonds;
  const ContactCandidates& candidates = contact.candidates;
  for (Index pair = candidates.outgoing_offset[at(grain)]; pair < candidates.outgoing_offset[at(grain) + 1]; ++pair)
    for (Index i = candidates.pair_point_offset[at(pair)]; i < candidates.pair_point_offset[at(pair) + 1]; ++i)
      if (const PointBond& bond = contact.bond[at(i)]; bond.exists() || bond.dissipated_before != 0)
        bonds.push_back({pair, i});
  return bonds;
}

double damage_of(const PointBond& bond) {
  return bond.exists() ? 1.0 - bond.remaining : 1.0;
}

/// Writes the mean damage of the bonds at each node, -1 where it has none.
void write_nodal_damage(GatheredFile& file, const std::string& name, const Model& model, const Contact& contact) {
  file.write_grains(
      run::snapshots_damage, rows_of_grains(model.node_offset),
      [&](Index grain, std::span<float> nodal) {
        std::vector<double> sum(nodal.size(), 0.0), count(nodal.size(), 0.0);
        for (const PointOfBond& of_bond : bonds_of(contact, grain)) {
          const std::size_t place = place_in_grain(model, grain, at(contact.candidates.point_node[at(of_bond.point)]));
          sum[place] += damage_of(contact.bond[at(of_bond.point)]);
          count[place] += 1.0;
        }
        for (std::size_t n = 0; n < nodal.size(); ++n)
          nodal[n] = count[n] > 0 ? static_cast<float>(sum[n] / count[n]) : -1.0F;
      },
      name);
}

/// Writes every bond of a snapshot.
void write_bonds(GatheredFile& file, const std::string& name, const Model& model, const Contact& contact) {
  const ContactCandidates& candidates = contact.candidates;
  const auto of_grain = [&](Index grain) { return bonds_of(contact, grain); };
  const auto node_of = [&](const PointOfBond& of_bond) { return at(candidates.point_node[at(of_bond.point)]); };
  const auto bond_of = [&](const PointOfBond& of_bond) -> const auto& {
    return contact.bond[at(of_bond.point)];
  };
  const Counts counts = count_of_grains(file.ranks(), model, [&](Index grain) { return of_grain(grain).size(); });
  const auto write = [&](const auto& dataset, auto&& set) {
    write_entries(file, name, dataset, counts, of_grain, set);
  };
  write(run::snapshots_bond_node,
        [&](const PointOfBond& of_bond, std::span<Index> node) { node[0] = model.file_node[node_of(of_bond)]; });
  write(run::snapshots_bond_grain, [&](const PointOfBond& of_bond, std::span<Index> grain) {
    grain[0] = candidates.pair_second[at(of_bond.pair)];
  });
  write(run::snapshots_bond_damage, [&](const PointOfBond& of_bond, std::span<float> damage) {
    damage[0] = static_cast<float>(damage_of(bond_of(of_bond)));
  });
  write(run::snapshots_bond_area,
        [&](const PointOfBond& of_bond, std::span<double> area) { area[0] = model.reference_area[node_of(of_bond)]; });
  write(run::snapshots_bond_dissipation, [&](const PointOfBond& of_bond, std::span<double> dissipation) {
    dissipation[0] = bond_dissipation(model, contact, of_bond.pair, of_bond.point);
  });
  write(run::snapshots_bond_separation, [&](const PointOfBond& of_bond, std::span<float> separation) {
    const PointBond& bond = bond_of(of_bond);
    const double sliding = std::sqrt(std::max(bond.separation * bond.separation - bond.opening * bond.opening, 0.0));
    separation[0] = static_cast<float>(bond.opening), separation[1] = static_cast<float>(sliding);
  });
  if (contact.bond_laws.size() > 1) {
    write(run::snapshots_bond_law,
          [&](const PointOfBond& of_bond, std::span<Index> law) { law[0] = bond_of(of_bond).law; });
    file.write(run::snapshots_bond_laws, flatten(contact.bond_laws), contact.bond_laws.size(), name);
  }
}

/// Connectivity, back in file order.
void write_mesh(GatheredFile& file, const Model& model) {
  file.write_grains(run::mesh_tet, rows_of_grains(model.tet_offset), [&](Index grain, std::span<Index> corners) {
    const Index first = model.tet_offset[at(grain)];
    for (Index t = first; t < model.tet_offset[at(grain) + 1]; ++t) {
      const auto corner = model.nodes_of_tet(grain, t - first);
      for (std::size_t c = 0; c < 4; ++c)
        corners[4 * at(model.file_tet[at(t)] - first) + c] =
            model.file_node[at(model.node_offset[at(grain)] + corner[c])];
    }
  });
  file.write(run::mesh_grain_node_offset, model.node_offset, model.node_offset.size());
  file.write(run::mesh_grain_tet_offset, model.tet_offset, model.tet_offset.size());
}

void write_stages(schema::FileWriter& file, const std::vector<StageResult>& stages) {
  std::vector<std::string> name, end;
  std::vector<double> overshoot, hold_error, hold_root_mean_square;
  for (const StageResult& stage : stages) {
    name.push_back(stage.name);
    end.push_back(stage.ended_by);
    overshoot.push_back(stage.overshoot);
    hold_error.push_back(stage.hold_error);
    hold_root_mean_square.push_back(stage.hold_root_mean_square);
  }
  file.write(run::provenance_stage_name, std::span<const std::string>(name), name.size());
  file.write(run::provenance_stage_end, std::span<const std::string>(end), end.size());
  file.write(run::provenance_stage_overshoot, std::span<const double>(overshoot), overshoot.size());
  file.write(run::provenance_stage_hold_error, std::span<const double>(hold_error), hold_error.size());
  file.write(run::provenance_stage_hold_rms, std::span<const double>(hold_root_mean_square),
             hold_root_mean_square.size());
}

void write_provenance(schema::FileWriter& file, const Model& model, const Provenance& provenance) {
  file.write_scalar(run::provenance_version, std::string(version()));
  file.write_scalar(run::provenance_scenario, provenance.scenario_text);
  file.write_scalar(run::provenance_packing_hash, hash_text(model.mesh_hash));
  file.write_scalar(run::provenance_smooth_grains, std::int32_t{model.smooth_grains});
  file.write_scalar(run::provenance_seed, model.seed);
  file.write_scalar(run::provenance_host, physical_host());
  file.write_scalar(run::provenance_threads, std::int32_t{provenance.threads});
  file.write_scalar(run::provenance_ranks, std::int32_t{provenance.ranks});
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

void write_snapshot_file(const std::string& path, const SnapshotState& state, const Communicator& ranks) {
  const Model& model = state.model;
  const std::string name = "0000";
  GatheredFile file(ranks, model.ownership, path, schema::FileKind::run);
  file.at_root([&](schema::FileWriter& writer) {
    writer.write_scalar(run::snapshots_time, state.time, name);
    writer.write_scalar(run::snapshots_step, state.step, name);
    writer.write_scalar(run::snapshots_relative_density, state.relative_density, name);
    writer.write_scalar(run::snapshots_mean_stress, state.box.mean_stress(), name);
    writer.write(run::snapshots_box_low, std::span<const double>(state.box.cell().low), 3, name);
    writer.write(run::snapshots_box_high, std::span<const double>(state.box.cell().high), 3, name);
    write_placed_tools(writer, name, state.tools);
  });
  write_node_rows(file, name, run::snapshots_node, model, model.position);
  write_node_rows(file, name, run::snapshots_velocity, model, model.velocity);
  write_tet_fields(file, name, model);
  write_contact_pressure(file, name, state);
  write_pairs(file, name, model, state.contact);
  write_wall_forces(file, name, model, state.box);
  if (state.wall_friction.present()) write_wall_friction(file, name, state.wall_friction);
  if (state.contact.bonding()) {
    write_nodal_damage(file, name, model, state.contact);
    write_bonds(file, name, model, state.contact);
  }
  file.commit();
}

void write_run_file(const std::string& path, const Model& model, const RunHistory& history,
                    const std::vector<std::string>& snapshot_files, const Provenance& provenance,
                    const Communicator& ranks) {
  GatheredFile file(ranks, model.ownership, path, schema::FileKind::run);
  file.at_root([&](schema::FileWriter& writer) {
    write_history(writer, history.rows, provenance.columns);
    write_tool_history(writer, names_of(history.tools), history.tool_rows);
    write_tool_geometry(writer, history.tools);
  });
  write_mesh(file, model);
  file.at_root([&](schema::FileWriter& writer) {
    for (std::size_t i = 0; i < snapshot_files.size(); ++i) {
      const schema::FileReader from(snapshot_files[i], schema::FileKind::run);
      writer.copy_snapshot(from, "0000", fmt::format("{:04}", i));
    }
    write_provenance(writer, model, provenance);
  });
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
