#pragma once
// Flow curves and the scalar equation of the radial return for each of them.
//
// A law gives, for a trial von Mises stress above the flow stress, the flow stress and plastic strain at the end of the
// increment, i.e. the solution of   3G (eps_p - eps_p,n) + sigma(eps_p) = q_trial.
// The state of a point is both sigma and eps_p, so that no power has to be evaluated where the increment is small.

#include <array>
#include <cassert>
#include <cmath>

#include "solver/physics/pack.hpp"

namespace mpfem {

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
    const S first = excess / (elastic + slope_strain);     // relative increment r = d eps_p / eps_p, explicit
    // 1. Small relative increments, nearly always: (1 + r)^m by its binomial series, Newton on
    //    3G eps_p r + y ((1 + r)^m - 1) = excess. Comparison is false for 0/0, so fresh points take the other way.
    if (!any(!(first < S(0.02)))) {
      S r = first;
      for (int iteration = 0; iteration < 2; ++iteration) {
        const S power = power_series(r);
        const S residual = elastic * r + hardening * power - excess;
        r = r - residual / (elastic + slope_strain * (S(1.0) + power) / (S(1.0) + r));
      }
      return {old.flow_stress + hardening * power_series(r), old.plastic_strain * (S(1.0) + r)};
    }
    // 2. Any increment, from eps_p = 0 too: Newton on the hardening stress, whose equation
    //    3G ((y/k)^(1/m) - eps_p,n) + y - (q_trial - sigma_y) = 0 is convex with slope >= 1; started above the root.
    const S distance = trial - S(yield_stress);
    const S bound = old.plastic_strain + excess / S(three_shear);
    const S tiny(1e-300);
    S y = min(max(distance, tiny), S(coefficient) * exp(S(exponent) * log(max(bound, tiny))));
    y = max(y, tiny);
    for (int iteration = 0; iteration < 12; ++iteration) {
      const S strain = exp(log(y * S(1.0 / coefficient)) * S(1.0 / exponent));
      const S residual = S(three_shear) * (strain - old.plastic_strain) + y - distance;
      const S step = residual / (S(three_shear / exponent) * strain / y + S(1.0));
      y = max(y - step, tiny);
      if (!any(max(step, -step) > S(1e-15) * y)) break;
    }
    // Points without excess (other lanes of a pack) keep their state exactly.
    const auto loaded = excess > S(0.0);
    return {select(loaded, y + S(yield_stress), old.flow_stress),
            select(loaded, old.plastic_strain + (distance - y) * S(1.0 / three_shear), old.plastic_strain)};
  }

private:
  /// (1 + r)^m - 1 for 0 <= r < 0.02 to rounding: seven terms, the next is below 0.02^8.
  template <class S>
  S power_series(const S& r) const {
    const double m = exponent;
    const double c2 = (m - 1) / 2, c3 = (m - 2) / 3, c4 = (m - 3) / 4, c5 = (m - 4) / 5, c6 = (m - 5) / 6,
                 c7 = (m - 6) / 7;
    const S one(1.0);
    return S(m) * r *
           (one +
            S(c2) * r *
                (one + S(c3) * r * (one + S(c4) * r * (one + S(c5) * r * (one + S(c6) * r * (one + S(c7) * r))))));
  }
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
    S stress = trial;
    for (int iteration = 0; iteration < 40; ++iteration) {
      const S strain = exp(log(stress * S(1.0 / coefficient)) * S(1.0 / exponent));
      const S residual =
          S(three_shear) * (strain - stress * S(1.0 / youngs_modulus) - old.plastic_strain) + stress - trial;
      const S slope = S(three_shear) * (S(1.0 / exponent) * strain / stress - S(1.0 / youngs_modulus)) + S(1.0);
      const S step = residual / slope;
      stress = max(stress - step, old.flow_stress);
      if (!any(max(step, -step) > S(1e-15) * stress)) break;
    }
    const auto loaded = trial > old.flow_stress;
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
