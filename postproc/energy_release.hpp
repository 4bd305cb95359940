#pragma once
// What becomes of a compact's elastic energy when it is unloaded.

#include <optional>

#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

/// By what energies are made dimensionless: E R^3 with the grains' Young's modulus and their mean radius.
struct EnergyScale {
  std::optional<double> youngs_modulus; ///< MPa
  std::optional<double> mean_radius;    ///< mm
  std::optional<double> energy() const; ///< mJ, where both are known
};

/// Elastic energy at the beginning and at the end of the unloading stage `number` (default: choose_unloading), the
/// value being their difference, the elastic energy released (paper, Fig. 11); with plastic and damage dissipation, all
/// in mJ and over E R^3 where `scale` gives both. Uncertainties: energy_uncertainty of states,
/// energy_change_uncertainty of changes. Without an unloading the value is 0 and a note says so; energies at the end
/// are given all the same.
Measurement measure_energy(const schema::FileReader& file, std::optional<int> number, const EnergyScale& scale);

} // namespace mpfem
