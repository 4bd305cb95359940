#pragma once
// Inertia of a loading, row by row: the inertial number, and the largest kinetic over internal energy.

#include <optional>
#include <span>
#include <vector>

#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// The grains' properties that the inertial number needs.
struct GrainInertia {
  double density = 0;  ///< tonne/mm^3, of their material, mass scaling included
  double diameter = 0; ///< mm, of the sphere with the grains' mean volume
};

/// From the scenario in the run file, and the grains' volume in the first row. Empty where there is no single density:
/// grains of several densities, or masses scaled to a step (ScenarioFacts).
std::optional<GrainInertia> grain_inertia(const schema::FileReader& file, const HistoryTable& history);

/// [rows], I = |strain rate| d sqrt(density / p) (GDR MiDi, Eur. Phys. J. E 14 (2004) 341; Agnolin and Roux, Phys. Rev.
/// E 76 (2007) 061302): the time in which p moves a grain by its own size, over the time in which the box strains by
/// one. The strain rate is logarithmic, since the row before, on the axis that strains fastest; p is the mean stress of
/// the row. 0 where it has no meaning: in a stage's first row, and where p is not positive.
std::vector<double> inertial_numbers(const HistoryTable& history, const GrainInertia& grains);

/// Values over a set of rows.
struct Inertia {
  double kinetic_over_internal = 0; ///< largest; internal energy of the row's stage (common/stage_energy.hpp)
  std::optional<double> inertial_number, largest_inertial_number; ///< median and largest of the rows that have one
};

/// Inertia over these rows of the history. The inertial numbers are empty where `grains` are not known.
Inertia inertia_of_rows(const HistoryTable& history, std::span<const std::size_t> rows,
                        const std::optional<GrainInertia>& grains);

} // namespace mpfem
