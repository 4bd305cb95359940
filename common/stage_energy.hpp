#pragma once
// The internal energy with which kinetic energy is compared: that of the stage itself.
//
// A stage that begins with a compact has the plastic work of the compaction behind it. That is many times the energy of
// the stage itself, and shows nothing about how slowly the stage loads. The energy stored when the stage begins counts:
// it belongs to the stress that the grains bear, and inertia has to be small beside it. It also keeps the ratio finite
// in the first rows of a stage, where little has been gained yet. A stage that begins with grains that do not touch has
// neither; its rows are judged only once there is load.

#include <span>
#include <vector>

namespace mpfem {

/// Of a row of the history.
struct StageEnergyRow {
  double stage = 0;      ///< number of the row's stage
  double stored = 0;     ///< mJ: elastic energy of the grains, energy of bonds, contact penalty and friction
  double dissipated = 0; ///< mJ: by plastic flow, damage and friction, since the run began
};

/// Internal energy (mJ) of each row's stage: what was stored when the stage began, and what it has gained since; that
/// is, what is stored now and what the stage has dissipated so far. A stage begins in the state of the row before its
/// own first row; if the history begins with it (a branch), in its own first row.
std::vector<double> stage_internal_energy(std::span<const StageEnergyRow> rows);

} // namespace mpfem
