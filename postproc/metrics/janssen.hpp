#pragma once
// Janssen's slices: how wall friction in a die divides the axial stress between upper and lower punch.
//
// Equilibrium of a slice of a cylinder that is pressed from above: d(sigma_z)/dz = 4 mu sigma_r / D, z from the lower
// punch (Janssen 1895; for dies Unckel 1945). With sigma_r = K sigma_z the solution is an exponential. Friction is
// taken as fully mobilised and in one direction everywhere: one punch moves, the other rests in the die.

namespace mpfem {

/// Punch stresses and size of a tablet in its die.
struct DieSlice {
  double upper_stress = 0, lower_stress = 0; ///< MPa, of the punches, compression positive
  double diameter = 0, height = 0;           ///< mm
};

/// Mean over the height of the axial stress sigma_B (sigma_T / sigma_B)^(z/H), MPa:
/// (sigma_T - sigma_B) / ln(sigma_T / sigma_B).
double mean_axial_stress_in_die(const DieSlice& slice);

/// Coefficient of wall friction from the mean radial stress (MPa) over the height,
/// mu = D (sigma_T - sigma_B) / (4 H sigma_r): the equilibrium of the whole tablet, which needs no exponential. All
/// stresses > 0.
double wall_friction(const DieSlice& slice, double mean_radial_stress);

} // namespace mpfem
