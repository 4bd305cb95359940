#pragma once
// Flow curves and the scalar equation of the radial return for each of them.
//
// A law gives, for a trial von Mises stress above the flow stress, the flow stress and plastic strain at the end of the
// increment, i.e. the solution of   3G (eps_p - eps_p,n) + sigma(eps_p) = q_trial.
// The state of a point holds both sigma and eps_p, so that no power has to be evaluated if the increment is small.

#include <array>
#include <cassert>
#include <cmath>

#include "solver/physics/pack.hpp"

namespace mpfem {

/// Where a point is on its flow curve.
template <class S>
struct HardeningState {
  S flow_stress;    ///< MPa
  S plastic_strain; ///< equivalent plastic strain
};

/// Never yields.
struct ElasticLaw {
  static constexpr bool yields = false;
  double initial_flow_stress() const { return 0.0; }
};

/// sigma = sigma_y + k eps_p^m (paper Eq. 1), 0 < m <= 1. Its slope at eps_p = 0 is infinite for m < 1.
struct PowerLaw {
  static constexpr bool yields = true;
  double yield_stress; ///< sigma_y, MPa
  double coefficient;  ///< k, MPa
  double exponent;     ///< m

  double initial_flow_stress() const { return yield_stress; }

  template <class S>
  HardeningState<S> end_of_increment(const S& trial, const HardeningState<S>& old, double three_shear) const {
    const S excess = trial - old.flow_stress;
    const S hardening = old.flow_stress - S(yield_stress); // y = k eps_p^m
    const S slope_strain = S(exponent) * hardening;        // H' eps_p
    const S elastic = S(three_shear) * old.plastic_strain; // 3G eps_p
    const S tiny(Resolution<S>::tiny);
    const S inverse = S(1.0) / max(elastic + slope_strain, tiny);
    const S first = excess * inverse; // relative increment r = d eps_p / eps_p, explicit
    // Lanes that do not yield keep their state and do not affect how the others are returned. While a packing jams,
    // most packs that yield also contain points that have not yielded yet; if these took part, such packs would take
    // ten times as long.
    const auto loaded = excess > S(0.0);
    // Points without plastic strain take the second way. So do points whose strain was too small for the number type
    // (small exponents in floats): exp() ends near 1e-38, and an r based on that would stay wrong.
    if (!any(loaded & !((first < S(0.02)) & (old.plastic_strain > tiny))))
      return small_increment(trial, old, three_shear, first, slope_strain * inverse);
    return any_increment(trial, old, three_shear);
  }

private:
  /// Small relative increments r, the usual case: with (1 + r)^m as its binomial series the equation is
  /// r + b2 r^2 + b3 r^3 + … = first. Its inverted series gives r to the fourth power, and one Newton step the rest to
  /// rounding. `a`: H' / (3G + H').
  template <class S>
  HardeningState<S> small_increment(const S& trial, const HardeningState<S>& old, double three_shear, const S& first,
                                    const S& a) const {
    const S b2 = c2() * a, b3 = c3() * b2, b4 = c4() * b3, square = b2 * b2;
    S r =
        first * (S(1.0) - first * (b2 - first * (S(2.0) * square - b3 - first * (b2 * (S(5.0) * (square - b3)) + b4))));
    const S tail = c4() * r * (S(1.0) + c5() * r * (S(1.0) + c6() * r * (S(1.0) + c7() * r)));
    const S residual = r * (S(1.0) + b2 * r * (S(1.0) + c3() * r * (S(1.0) + tail))) - first;
    const S slope = r * (S(2.0) * b2 + S(3.0) * b3 * r); // below 0.015: 1/(1 + slope) by its series
    r = r - residual * (S(1.0) - slope * (S(1.0) - slope * (S(1.0) - slope)));
    const S increment = old.plastic_strain * r;
    return {trial - S(three_shear) * increment, old.plastic_strain + increment};
  }

  /// Any increment, from eps_p = 0 too: Newton on the hardening stress, whose equation
  /// 3G ((y/k)^(1/m) - eps_p,n) + y - (q_trial - sigma_y) = 0 is convex with slope >= 1; started above the root.
  template <class S>
  HardeningState<S> any_increment(const S& trial, const HardeningState<S>& old, double three_shear) const {
    const S excess = trial - old.flow_stress, tiny(Resolution<S>::tiny);
    const auto loaded = excess > S(0.0);
    const S distance = trial - S(yield_stress);
    const S bound = old.plastic_strain + excess / S(three_shear);
    S y = min(max(distance, tiny), S(coefficient) * exp(S(exponent) * log(max(bound, tiny))));
    y = max(y, tiny);
    for (int iteration = 0; iteration < 12; ++iteration) {
      const S strain = exp(log(y * S(1.0 / coefficient)) * S(1.0 / exponent));
      const S residual = S(three_shear) * (strain - old.plastic_strain) + y - distance;
      const S step = residual / (S(three_shear / exponent) * strain / y + S(1.0));
      y = max(y - step, tiny);
      if (!any(loaded & (max(step, -step) > S(Resolution<S>::settled) * y))) break;
    }
    // The strain, from the more exact side of the equation. The difference of stresses is rounded to the last digit of
    // the stresses, the curve to that of the strain over m. Early on a curve with small m the strain may be less than
    // any digit of the stress.
    const S on_curve = exp(log(y * S(1.0 / coefficient)) * S(1.0 / exponent));
    const S strain = select(S(three_shear) * on_curve < S(exponent) * y, max(on_curve, old.plastic_strain),
                            old.plastic_strain + (distance - y) * S(1.0 / three_shear));
    return {select(loaded, y + S(yield_stress), old.flow_stress), select(loaded, strain, old.plastic_strain)};
  }

  // (1 + r)^m - 1 = m r (1 + c2 r (1 + c3 r (1 + …))); after c7 the next term is below 0.02^8.
  double c2() const { return (exponent - 1) * (1.0 / 2); }
  double c3() const { return (exponent - 2) * (1.0 / 3); }
  double c4() const { return (exponent - 3) * (1.0 / 4); }
  double c5() const { return (exponent - 4) * (1.0 / 5); }
  double c6() const { return (exponent - 5) * (1.0 / 6); }
  double c7() const { return (exponent - 6) * (1.0 / 7); }
};

/// sigma = n eps^p on the total strain eps = eps_p + sigma/E, elastic until E eps = n eps^p (paper Eq. 8); 0 < p < 1.
struct TotalStrainLaw {
  static constexpr bool yields = true;
  double coefficient;    ///< n, MPa
  double exponent;       ///< p
  double youngs_modulus; ///< E, MPa

  /// (n/E)^(p/(1-p)) n, where the elastic line meets the curve.
  double initial_flow_stress() const {
    return coefficient * std::pow(coefficient / youngs_modulus, exponent / (1.0 - exponent));
  }

  template <class S>
  HardeningState<S> end_of_increment(const S& trial, const HardeningState<S>& old, double three_shear) const {
    // Newton on sigma from above: 3G ((sigma/n)^(1/p) - sigma/E - eps_p,n) + sigma - q_trial = 0. For sigma above the
    // initial flow stress the left side is convex and increasing (its slope there is 3G/E (1/p - 1) + 1 > 0).
    const auto loaded = trial > old.flow_stress;
    S stress = trial;
    for (int iteration = 0; iteration < 40; ++iteration) {
      const S strain = exp(log(stress * S(1.0 / coefficient)) * S(1.0 / exponent));
      const S residual =
          S(three_shear) * (strain - stress * S(1.0 / youngs_modulus) - old.plastic_strain) + stress - trial;
      const S slope = S(three_shear) * (S(1.0 / exponent) * strain / stress - S(1.0 / youngs_modulus)) + S(1.0);
      const S step = residual / slope;
      stress = max(stress - step, old.flow_stress);
      if (!any(loaded & (max(step, -step) > S(Resolution<S>::settled) * stress))) break;
    }
    return {select(loaded, stress, old.flow_stress),
            select(loaded, old.plastic_strain + (trial - stress) * S(1.0 / three_shear), old.plastic_strain)};
  }
};

/// Piecewise linear flow curve over eps_p, constant beyond its last point.
struct TableLaw {
  static constexpr bool yields = true;
  static constexpr int max_points = 64;
  int points = 0;
  std::array<double, max_points> strain{}; ///< increasing, first 0
  std::array<double, max_points> stress{}; ///< MPa

  double initial_flow_stress() const { return stress[0]; }

  template <class S>
  HardeningState<S> end_of_increment(const S& trial, const HardeningState<S>& old, double three_shear) const {
    // On each linear piece the equation is linear. A piece holds the answer when the answer lies inside it; for a
    // hardening curve (or one that softens less than 3G) there is exactly one.
    S strain_end = old.plastic_strain + (trial - S(stress[size_t(points - 1)])) * S(1.0 / three_shear);
    S flow = S(stress[size_t(points - 1)]);
    for (int i = points - 2; i >= 0; --i) {
      const auto k = size_t(i);
      const double slope = (stress[k + 1] - stress[k]) / (strain[k + 1] - strain[k]);
      const S candidate = (trial + S(three_shear) * old.plastic_strain - S(stress[k] - slope * strain[k])) *
                          S(1.0 / (three_shear + slope));
      const auto below = candidate < S(strain[k + 1]);
      strain_end = select(below, candidate, strain_end);
      flow = select(below, S(stress[k]) + S(slope) * (candidate - S(strain[k])), flow);
    }
    const auto loaded = trial > old.flow_stress;
    return {select(loaded, flow, old.flow_stress), select(loaded, strain_end, old.plastic_strain)};
  }

private:
  using size_t = std::size_t;
};

} // namespace mpfem
