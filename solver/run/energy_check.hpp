#pragma once
// Watches whether the energy balance of a run closes: what a run whose step is unstable shows first.

#include "solver/run/simulation.hpp"

namespace mpfem {

/// Takes in the rows of a history, one after the other.
///
/// The residual of a row is compared with the largest term of any row so far: energies that have been given back
/// (an elastic pair that has parted) must still be accounted for. Explicit central differences close the balance to
/// some thousandths of that term while they are stable (docs/numerics.md); energy out of nothing grows without limit
/// when they are not. Terms below 1e-7 of the solid's volume times Young's modulus, the energy of a strain of 3e-4, are
/// left alone: while little happens rounding decides the residual, and then the first touches, whose work is that of
/// whole steps although walls and nodes meet within one. That is off by as much as the contact's energy, once, and soon
/// nothing beside what follows.
class EnergyCheck {
public:
  static constexpr double allowed = 0.1;     ///< of the largest term: beyond, the run fails
  static constexpr double noteworthy = 0.01; ///< of the largest term: beyond, the run warns

  /// `stiffness`: Young's modulus times the volume of all grains, mJ.
  explicit EnergyCheck(double stiffness) : negligible_(1e-7 * stiffness) {}

  /// Residual over the largest term so far, 0 where that is negligible; NaN if a term is no finite number.
  double take(const HistoryRow& row);

private:
  double negligible_;  ///< mJ
  double largest_ = 0; ///< mJ
};

} // namespace mpfem
