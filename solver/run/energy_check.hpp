#pragma once
// Watches whether the energy balance of a run closes: an unstable step shows there first.

#include <optional>
#include <vector>

#include "solver/run/simulation.hpp"

namespace mpfem {

/// Takes in the rows of a history, one after the other.
///
/// The residual of a row is compared with the largest term of any row so far: energy that has been released again
/// (an elastic pair that has parted) must still be accounted for. While they are stable, explicit central differences
/// close the balance to some thousandths of that term (studies/hard-cases/README.md); when they are not, energy
/// appears from nothing and grows without limit. Terms below 1e-7 of the solid's volume times Young's modulus, the
/// energy of a strain of 3e-4, are ignored: with such small energies the residual consists of rounding and of the first
/// contacts, whose work is summed over whole steps although walls and nodes meet within one. That error is as large as
/// the contact's energy, occurs once, and is soon small in comparison. For the same reason the first steps of a run are
/// not judged: grips or walls that start at full speed do work within a step. An unstable motion grows from step to
/// step, and is found soon after.
class EnergyCheck {
public:
  static constexpr double allowed = 0.1;        ///< of the largest term: beyond, the run fails
  static constexpr double warning_limit = 0.01; ///< of the largest term: beyond, the run warns

  /// `stiffness`: Young's modulus times the volume of all grains, mJ.
  explicit EnergyCheck(double stiffness) : negligible_(1e-7 * stiffness) {}
  /// Of a run with these grains whose history so far is given.
  EnergyCheck(const Model& model, const std::vector<HistoryRow>& history);

  /// Residual over the largest term so far, 0 in the first steps and while that is negligible; NaN if a term is not
  /// finite.
  double take(const HistoryRow& row);
  /// The same; throws SimulationError if it is more than allowed: the run is meaningless.
  double require(const HistoryRow& row);

private:
  static constexpr double first_steps = 10;

  double negligible_;           ///< mJ
  std::optional<double> begin_; ///< step of the first row
  double largest_ = 0;          ///< mJ
};

} // namespace mpfem
