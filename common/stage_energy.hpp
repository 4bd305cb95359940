#pragma once
// The internal energy that kinetic energy is held against: that of the stage itself.
//
// A stage that begins at a compact has the plastic work of the compaction behind it. That is many times what the stage
// itself works with, and says nothing of how slowly the stage loads. What is stored when it begins counts: grains that
// bear a stress hold it by that energy, which inertia has to be small beside, and which keeps the ratio from dividing
// by nothing in the first rows of a stage, where little has been gained yet. A stage that begins at grains which touch
// nowhere has neither; its rows are judged only from a load on.

#include <span>
#include <vector>

namespace mpfem {

/// Of a row of the history.
struct StageEnergyRow {
  double stage = 0;      ///< number of the stage that it belongs to
  double stored = 0;     ///< mJ: elastic energy of the grains, energy of bonds, contact penalty and friction
  double dissipated = 0; ///< mJ: by plastic flow, damage and friction, since the run began
};

/// Internal energy (mJ) of each row's stage: what was stored when the stage began, and what it has gained since; that
/// is what is stored now and what the stage has dissipated so far. A stage begins in the state of the row before its
/// own first row; where the history begins with it (a branch), in its own first row.
std::vector<double> stage_internal_energy(std::span<const StageEnergyRow> rows);

} // namespace mpfem
