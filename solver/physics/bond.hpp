#pragma once
// The traction-separation law of a bond at one point of a contact, per unit of area (paper Eqs. 2-7).
//
// While undamaged, the traction is K times the separation, normal and tangential alike, until the tractions meet a
// quadratic criterion. From then on it softens: t = (1 - D) K delta with the effective separation delta =
// sqrt(<delta_n>^2 + delta_t^2). D is a function of the largest delta so far. Both laws are in closed form, so that the
// area under the curve is exactly G^c, whatever the size of a step. Unloading goes to the origin. Closing is resisted
// by the contact's own penalty, which is not damaged. The bond's K may differ from that penalty.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace mpfem {

/// Two readings of the paper's Eq. 5. With delta_0 = T_0/K, G_0 = T_0 delta_0 / 2 and b = G^c - G_0:
enum class SofteningLaw {
  exponential, ///< T = T_0 exp(-T_0 (delta - delta_0)/b): the peak is the strength, as the paper's Fig. 3 draws it
  energy, ///< 1 - D = exp(-K (delta^2 - delta_0^2)/(2 b)): Eq. 5, literally; the traction rises beyond the strength
};
/// All of them. Code that chooses between laws is a switch without default, so that the compiler asks for the case of a
/// new law. Not so in this file, which kernels inline: there a switch changes which products the compiler fuses with
/// sums, and so the last digits of results.
inline constexpr SofteningLaw softening_laws[] = {SofteningLaw::exponential, SofteningLaw::energy};
static_assert(std::size(softening_laws) == 2, "softening_exponent and remaining_stiffness choose between two");

/// Constants of a bond.
struct BondLaw {
  double stiffness = 0;        ///< K, MPa/mm; 0 if it follows the penalty of the contact point
  double tensile_strength = 0; ///< t_n^m, MPa
  double shear_strength = 0;   ///< t_s^m = t_t^m, MPa (Table 1 has one value for both directions)
  double fracture_energy = 0;  ///< G^c, N/mm; must exceed smallest_fracture_energy()
  SofteningLaw softening = SofteningLaw::exponential;
  bool normal_only = false; ///< no traction against sliding (for comparison with theories of adhesion)
  double penalty_ratio = 1; ///< K over the penalty of the contact point, if K follows that penalty
  bool operator==(const BondLaw&) const = default;
};

/// The law with its K set for a contact point with this penalty (MPa/mm, > 0).
inline BondLaw law_at_point(BondLaw law, double penalty) {
  if (law.stiffness == 0) law.stiffness = law.penalty_ratio * penalty;
  return law;
}

/// Stiffness to which bonds between grains raise a contact with this penalty (MPa/mm), over that penalty, at least 1: a
/// closed, intact bond with the stiffness ratio r counts |1 - r| + r.
inline double raised_by_bonds(std::span<const BondLaw> laws, double penalty) {
  double largest = 1;
  for (const BondLaw& law : laws) largest = std::max(largest, 2 * law_at_point(law, penalty).stiffness / penalty - 1);
  return largest;
}

/// The largest strength (MPa) in the directions in which the law holds.
inline double governing_strength(const BondLaw& law) {
  return law.normal_only ? law.tensile_strength : std::max(law.tensile_strength, law.shear_strength);
}

/// t^2/(2 K), N/mm: the area under the branch before damage, for the governing strength. `law` with its K set.
inline double energy_before_damage(const BondLaw& law) {
  const double strength = governing_strength(law);
  return 0.5 * strength * strength / law.stiffness;
}

/// The fracture energy (N/mm) that a law must exceed: a little more than the energy before damage, or nothing is left
/// for the softening.
inline double smallest_fracture_energy(const BondLaw& law) {
  return 1.01 * energy_before_damage(law);
}

/// What a bond remembers.
struct BondState {
  double initiation = 0; ///< delta_0 of the mode in which damage began, mm; 0: undamaged so far
  double largest = 0;    ///< largest effective separation, mm; counts from delta_0 on
};

/// Effective separation (mm) at which damage begins in a mode given by its share of opening: `opening` =
/// <delta_n>/delta.
inline double initiation_separation(const BondLaw& law, double opening) {
  const double normal = opening / law.tensile_strength;
  const double shear_square =
      law.normal_only ? 0.0 : (1 - opening * opening) / (law.shear_strength * law.shear_strength);
  return 1 / (law.stiffness * std::sqrt(normal * normal + shear_square));
}

/// Argument of the exponential function in the softening law, without its sign; 0 while undamaged.
inline double softening_exponent(const BondLaw& law, const BondState& state) {
  if (state.initiation == 0) return 0;
  const double d0 = state.initiation, d = state.largest, peak = law.stiffness * d0;
  const double b = law.fracture_energy - 0.5 * peak * d0;
  return law.softening == SofteningLaw::exponential ? peak * (d - d0) / b
                                                    : 0.5 * law.stiffness * (d - d0) * (d + d0) / b;
}

/// True when the bond has failed completely. The exponential never reaches 0: once less than e^-16 = 1.1e-7 of the
/// energy is left to spend, the rest counts as spent.
inline bool is_broken(const BondLaw& law, const BondState& state) {
  return softening_exponent(law, state) > 16;
}

/// 1 - D, in [0, 1].
inline double remaining_stiffness(const BondLaw& law, const BondState& state) {
  if (state.initiation == 0) return 1;
  if (is_broken(law, state)) return 0;
  const double remaining = std::exp(-softening_exponent(law, state));
  return law.softening == SofteningLaw::exponential ? state.initiation / state.largest * remaining : remaining;
}

/// Energy (mJ/mm^2 = N/mm) under the envelope up to the largest separation: the work of opening the bond so far.
inline double envelope_energy(const BondLaw& law, const BondState& state) {
  if (state.initiation == 0) return 0;
  if (is_broken(law, state)) return law.fracture_energy;
  const double before = 0.5 * law.stiffness * state.initiation * state.initiation;
  return before - (law.fracture_energy - before) * std::expm1(-softening_exponent(law, state));
}

/// Energy (N/mm) lost to damage so far.
inline double damage_dissipation(const BondLaw& law, const BondState& state) {
  if (state.initiation == 0) return 0;
  return envelope_energy(law, state) -
         0.5 * remaining_stiffness(law, state) * law.stiffness * state.largest * state.largest;
}

/// Updates the state for an effective separation (mm) whose opening part is `open` (mm). True if damage has grown.
inline bool advance_damage(const BondLaw& law, BondState& state, double open, double effective) {
  if (state.initiation == 0) {
    if (effective == 0) return false;
    const double begin = initiation_separation(law, open / effective);
    if (effective < begin) return false;
    state = {begin, effective};
    return true;
  }
  if (effective <= state.largest) return false;
  state.largest = effective;
  return true;
}

/// Tractions (MPa) that act against the separations, and the stored energy.
struct BondTraction {
  double normal = 0;    ///< opening only: 0 where the point is closed
  double shear[2] = {}; ///< along the two components of the tangential separation
  double stored = 0;    ///< N/mm, released by closing
};

/// Traction at a separation: normal (mm, > 0 open) and two tangential components (mm). Updates the state.
inline BondTraction bond_traction(const BondLaw& law, BondState& state, double normal, double shear1, double shear2) {
  const double open = normal > 0 ? normal : 0.0;
  const double slide1 = law.normal_only ? 0.0 : shear1, slide2 = law.normal_only ? 0.0 : shear2;
  const double effective = std::sqrt(open * open + slide1 * slide1 + slide2 * slide2);
  advance_damage(law, state, open, effective);
  const double k = remaining_stiffness(law, state) * law.stiffness;
  return {k * open, {k * slide1, k * slide2}, 0.5 * k * effective * effective};
}

} // namespace mpfem
