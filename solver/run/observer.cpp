#include "solver/run/observer.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/index.hpp"
#include "solver/parallel/totals.hpp"
#include "solver/run/energy_terms.hpp"

namespace mpfem {

namespace {

/// What is measured on every grain for a row.
struct GrainObservation {
  double kinetic = 0, elastic = 0;           ///< mJ
  double volume = 0;                         ///< mm^3, current
  double surface_area = 0, contact_area = 0; ///< mm^2
  MassMoments mass;                          ///< about the cell's centre
  std::int64_t touched = 0;                  ///< grains of larger number that it touches

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.kinetic), visit.sum(s.elastic), visit.sum(s.volume);
    visit.sum(s.surface_area), visit.sum(s.contact_area), visit.count(s.touched);
    MassMoments::for_each_term(s.mass, visit);
  }
};

/// What is measured on every grain for the control of the loading rate.
struct LoadingOfGrain {
  double kinetic = 0, elastic = 0; ///< mJ
  ForceMoments moments;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.kinetic), visit.sum(s.elastic);
    ForceMoments::for_each_term(s.moments, visit);
  }
};

std::array<double, 3> centre_of(const Cell& cell) {
  return {cell.centre(0), cell.centre(1), cell.centre(2)};
}

/// How many grains with a larger number a grain touches, by points of either grain.
std::int64_t touched_later_grains(const Contact& contact, std::int32_t grain) {
  const ContactCandidates& c = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  std::set<std::int32_t> touched;
  const auto look = [&](std::int32_t pair, const std::vector<std::int32_t>& other) {
    const auto p = static_cast<std::size_t>(pair);
    if (contact.active[p] > 0 && other[p] > grain) touched.insert(other[p]);
  };
  for (std::int32_t pair = c.outgoing_offset[g]; pair < c.outgoing_offset[g + 1]; ++pair) look(pair, c.pair_second);
  for (std::int32_t i = c.incoming_offset[g]; i < c.incoming_offset[g + 1]; ++i)
    look(c.incoming_pair[static_cast<std::size_t>(i)], c.pair_first);
  return static_cast<std::int64_t>(touched.size());
}

/// Collective. The total of what observe(grain) returns for the grains of all ranks.
template <class Observe>
auto total_of_grains(const Simulation& simulation, ThreadTeam& team, Observe&& observe) {
  using Sums = decltype(observe(0));
  const Model& model = simulation.model();
  std::vector<Sums> values(static_cast<std::size_t>(model.grains));
  team.for_each(static_cast<int>(model.own().size()), [&](int item, int) {
    const std::int32_t grain = model.own()[static_cast<std::size_t>(item)];
    values[static_cast<std::size_t>(grain)] = observe(grain);
  });
  return total_of<Sums>(simulation.ranks(), model.own(), values);
}

GrainObservation observe_grains(const Simulation& simulation, double step_mean, ThreadTeam& team) {
  const Model& model = simulation.model();
  const Contact& contact = simulation.contact();
  const std::array<double, 3> centre = centre_of(simulation.box().cell());
  return total_of_grains(simulation, team, [&](std::int32_t grain) {
    return GrainObservation{.kinetic = kinetic_energy(model, grain, step_mean),
                            .elastic = elastic_energy(model, grain),
                            .volume = current_volume(model, grain),
                            .surface_area = surface_area(model, grain),
                            .contact_area = contact_area(model, contact, grain),
                            .mass = mass_moments(model, centre, grain),
                            .touched = touched_later_grains(contact, grain)};
  });
}

/// Standard deviation (mm) of all mass along each axis.
std::array<double, 3> mass_spread(const MassMoments& all) {
  std::array<double, 3> spread{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double mean = all.first[axis] / all.mass;
    spread[axis] = std::sqrt(std::max(0.0, all.second[axis] / all.mass - mean * mean));
  }
  return spread;
}

/// Stresses and strains of the box.
void observe_box(HistoryRow& row, const Box& box, const RunState& state) {
  row.box_lengths = box.cell().lengths();
  row.section_share = box.cell().section_share;
  row.wall_stress = box.stress();
  row.mean_stress = box.mean_stress();
  const auto& s = row.wall_stress;
  row.deviatoric_stress = 0.5 * (s[4] + s[5]) - 0.25 * (s[0] + s[1] + s[2] + s[3]);
  row.axial_strain = std::log(state.initial_lengths[2] / row.box_lengths[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    row.volumetric_strain += std::log(state.initial_lengths[axis] / row.box_lengths[axis]);
}

void observe_bonds(HistoryRow& row, const BondSums& bonds) {
  row.bond_energy = bonds.stored;
  row.damage_dissipation = bonds.dissipated;
  row.bonded_area = bonds.bonded_area;
  row.bonds = static_cast<double>(bonds.bonds);
  row.mean_damage = bonds.formed_area > 0 ? bonds.damaged_area / bonds.formed_area : 0.0;
}

void take_over_sums(HistoryRow& row, const EnergyLedger& energies) {
  row.plastic_dissipation = energies.plastic_dissipation;
  row.viscous_dissipation = energies.viscous_dissipation;
  row.hypoelastic_dissipation = energies.hypoelastic_dissipation;
  row.damping_dissipation = energies.damping_dissipation;
  row.friction_dissipation = energies.friction_dissipation;
  row.external_work = energies.external_work;
}

} // namespace

BondSums total_bonds(const Simulation& simulation, ThreadTeam& team) {
  const Contact& contact = simulation.contact();
  if (!contact.bonding()) return {};
  const ContactCandidates& candidates = contact.candidates;
  return total_of_grains(simulation, team, [&](std::int32_t g) {
    BondSums sums;
    for (std::int32_t pair = candidates.outgoing_offset[at(g)]; pair < candidates.outgoing_offset[at(g) + 1]; ++pair)
      add_terms(sums, bond_sums(simulation.model(), contact, pair));
    return sums;
  });
}

HistoryRow observe_row(const Simulation& simulation, const ForceSums& sums, ThreadTeam& team) {
  const Model& model = simulation.model();
  const RunState& state = simulation.state();
  const double next_step = simulation.stage_run().next_step(simulation.step_estimate().stable_step(), state.last_step);
  // At the very first time level the velocity is that of the level itself.
  const double step_mean = state.last_step > 0 ? 0.5 * (state.last_step + next_step) : 0.0;
  const GrainObservation grains = observe_grains(simulation, step_mean, team);

  HistoryRow row{};
  row.time = state.time;
  row.step = static_cast<double>(state.step);
  row.stage = static_cast<double>(state.stage);
  row.time_step = state.last_step;
  row.kinetic_energy = grains.kinetic;
  row.elastic_energy = grains.elastic;
  row.surface_area = grains.surface_area;
  row.contact_area = grains.contact_area;
  const ToolLoad of_tools = simulation.tools().total();
  row.contact_energy = sums.contact.energy + sums.box.energy + of_tools.energy;
  row.friction_energy = sums.contact.friction_energy + sums.wall_friction.stored() + of_tools.friction_energy;
  row.max_penetration = std::max({sums.contact.penetration, sums.box.penetration(), of_tools.penetration});
  row.mass_spread = mass_spread(grains.mass);
  observe_box(row, simulation.box(), state);
  const double cell_volume = simulation.box().cell().volume();
  row.relative_density = model.total_reference_volume() / cell_volume;
  row.relative_density_current = grains.volume / cell_volume;
  observe_bonds(row, total_bonds(simulation, team));
  row.bond_energy += of_tools.adhesion_energy;
  row.damage_dissipation += simulation.tools().adhesion_dissipation();
  take_over_sums(row, simulation.energies());
  row.energy_residual = energy_residual(row, simulation.energies().initial);
  row.coordination_number = 2.0 * static_cast<double>(grains.touched) / static_cast<double>(model.grains);
  double wall_force = 0;
  for (const double force : simulation.box().force()) wall_force += force;
  row.damping_drag_ratio = wall_force > 0 ? state.damping_force / wall_force : 0.0;
  return row;
}

std::vector<ToolRow> observe_tools(const Tools& tools) {
  std::vector<ToolRow> rows;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const ToolLoad& load = tools.load(i);
    rows.push_back({.displacement = tools[i].moved,
                    .force = array_of(load.force),
                    .moment = array_of(load.moment),
                    .normal_force = load.normal_force,
                    .work = tools[i].work,
                    .friction_energy = load.friction_energy,
                    .friction_dissipation = tools[i].friction_dissipation,
                    .adhesion_energy = load.adhesion_energy,
                    .adhesion_dissipation = tools[i].adhesion_dissipation,
                    .bonded_area = load.bonded_area});
  }
  return rows;
}

LoadingRateObservation observe_loading_rate(const Simulation& simulation, ThreadTeam& team) {
  const Model& model = simulation.model();
  const Cell& cell = simulation.box().cell();
  const RunState& state = simulation.state();
  const std::array<double, 3> centre = centre_of(cell);
  const LoadingOfGrain grains = total_of_grains(simulation, team, [&](std::int32_t grain) {
    return LoadingOfGrain{kinetic_energy(model, grain, state.last_step), elastic_energy(model, grain),
                          force_moments(model, centre, grain)};
  });
  LoadingRateObservation seen;
  seen.elapsed = LoadingRateControl::steps_between_observations * state.last_step;
  seen.plastic_dissipation = simulation.energies().plastic_dissipation;
  const double cell_volume = cell.volume();
  const std::array<double, 6> stress = simulation.box().stress();
  seen.kinetic_energy = grains.kinetic;
  seen.elastic_energy = grains.elastic;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    seen.imbalance[axis] = grains.moments.force[axis] * cell.length(axis) / cell_volume;
    seen.dynamic[axis] = grains.moments.moment[axis] / cell_volume;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) seen.wall_stress[axis] = 0.5 * (stress[2 * axis] + stress[2 * axis + 1]);
  seen.stopping = simulation.stage_run().is_stopping(simulation.box().mean_stress());
  return seen;
}

} // namespace mpfem
