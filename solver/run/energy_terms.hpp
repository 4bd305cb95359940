#pragma once
// All energies of a row of the history, listed once: for the energy balance, its check and the internal energy.

#include <array>

#include "solver/output/history_row.hpp"

namespace mpfem {

/// Where external work and the energy at the start have gone (mJ):
///   kinetic_energy            motion of the grains
///   elastic_energy            elastic strain of the grains
///   plastic_dissipation       plastic flow of the grains
///   contact_energy            stored in the penalty of contacts, walls and tools
///   viscous_dissipation       bulk viscosity
///   hypoelastic_dissipation   what the elastic law does not return (solver/physics/elasticity.hpp)
///   damping_dissipation       mass-proportional damping
///   bond_energy               stored in bonds, between grains and to tools
///   damage_dissipation        damage of these bonds; a function of their states, not accumulated over time
///   friction_energy           stored in the stick springs of grains, walls and tools
///   friction_dissipation      slip between grains, at walls and on tools
/// The residual subtracts them in this order.
inline constexpr std::array energy_terms{
    &HistoryRow::kinetic_energy,      &HistoryRow::elastic_energy,       &HistoryRow::plastic_dissipation,
    &HistoryRow::contact_energy,      &HistoryRow::viscous_dissipation,  &HistoryRow::hypoelastic_dissipation,
    &HistoryRow::damping_dissipation, &HistoryRow::bond_energy,          &HistoryRow::damage_dissipation,
    &HistoryRow::friction_energy,     &HistoryRow::friction_dissipation,
};

/// mJ that the balance does not account for. `initial`: energy at the start, mJ.
inline double energy_residual(const HistoryRow& row, double initial) {
  double residual = row.external_work + initial;
  for (const auto term : energy_terms) residual -= row.*term;
  return residual;
}

/// The stored part of the internal energy (common/stage_energy.hpp), mJ: by elastic strain, bonds, the penalty of
/// contact and the stick springs of friction.
inline double stored_energy(const HistoryRow& row) {
  return row.elastic_energy + row.bond_energy + row.contact_energy + row.friction_energy;
}

/// The dissipated part of the internal energy, mJ: by plastic flow, damage and friction. What viscosity, the elastic
/// law and damping take belongs to the numerical method.
inline double dissipated_energy(const HistoryRow& row) {
  return row.plastic_dissipation + row.damage_dissipation + row.friction_dissipation;
}

} // namespace mpfem
