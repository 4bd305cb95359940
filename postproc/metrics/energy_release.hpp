#pragma once
// The elastic energy of a compact that is released when it is unloaded.

#include <optional>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Scale of energies, E R^3: the grains' Young's modulus and their mean radius.
struct EnergyScale {
  std::optional<double> youngs_modulus; ///< MPa
  std::optional<double> mean_radius;    ///< mm
  std::optional<double> energy() const; ///< mJ; empty unless both are known
};

/// Elastic energy at the beginning and at the end of the unloading stage `number` (default: choose_unloading). The
/// value is their difference, the elastic energy released (paper, Fig. 11). The details also hold plastic and damage
/// dissipation, all in mJ and, where `scale` is known, over E R^3. Uncertainties: energy_uncertainty for states,
/// energy_change_uncertainty for changes. Without an unloading the value is 0, a note says so, and the energies are
/// those at the run's end. Throws InputError where there is no stage `number`.
Measurement measure_energy(const schema::FileReader& file, std::optional<int> number, const EnergyScale& scale);

} // namespace mpfem
