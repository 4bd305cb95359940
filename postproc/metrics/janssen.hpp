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

/// Axial stress (MPa) at a height z (mm) above the lower punch: sigma_B (sigma_T / sigma_B)^(z/H).
double axial_stress_in_die(const DieSlice& slice, double z);

/// Mean of that stress over the height, MPa: (sigma_T - sigma_B) / ln(sigma_T / sigma_B).
double mean_axial_stress_in_die(const DieSlice& slice);

/// Coefficient of wall friction from the radial stress (MPa) at one height z:
/// mu = D sigma_z(z) ln(sigma_T / sigma_B) / (4 H sigma_r(z)). All stresses > 0.
double wall_friction_at(const DieSlice& slice, double radial_stress, double z);

/// The same from the mean radial stress (MPa) over the height, mu = D (sigma_T - sigma_B) / (4 H sigma_r): the
/// equilibrium of the whole tablet, which needs no exponential.
double wall_friction(const DieSlice& slice, double mean_radial_stress);

} // namespace mpfem
