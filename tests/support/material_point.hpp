#pragma once
// Mesh-free driver of one material point: the same constitutive step as the element kernel's, under prescribed
// velocity gradients or with lateral stresses kept at zero.

#include "solver/physics/plasticity.hpp"

namespace mpfem::test {

/// Displacement-gradient increment H over one step, at the half step.
struct Gradient {
  double h[3][3] = {};
};

inline Increment<double> increment_of(const Gradient& g) {
  const auto& h = g.h;
  return {{h[0][0], h[1][1], h[2][2], 0.5 * (h[0][1] + h[1][0]), 0.5 * (h[1][2] + h[2][1]), 0.5 * (h[2][0] + h[0][2])},
          {0.5 * (h[2][1] - h[1][2]), 0.5 * (h[0][2] - h[2][0]), 0.5 * (h[1][0] - h[0][1])}};
}

template <class Law>
struct MaterialPoint {
  Law law;
  ElasticModuli moduli;
  Deviator<double> deviator{0, 0, 0, 0, 0};
  HardeningState<double> hardening{};
  double logarithmic_volume = 0;
  double plastic_work = 0; ///< per volume, MPa

  MaterialPoint(Law flow_law, ElasticModuli elastic) : law(flow_law), moduli(elastic) {
    hardening.flow_stress = law.initial_flow_stress();
  }

  double mean() const { return mean_stress(moduli, std::exp(logarithmic_volume)); }
  double stress_xx() const { return deviator.xx + mean(); }
  double stress_yy() const { return deviator.yy + mean(); }
  double stress_zz() const { return deviator.zz() + mean(); }

  /// One step; the trace of a half-step gradient is the logarithmic volume increment to third order, and exactly for
  /// the logarithmic strains that the drivers below prescribe.
  void step(const Gradient& gradient) {
    const auto increment = increment_of(gradient);
    const auto returned = update_deviator(law, moduli, deviator, hardening, increment);
    deviator = returned.deviator;
    hardening = returned.hardening;
    plastic_work += returned.plastic_work;
    logarithmic_volume += increment.strain.xx + increment.strain.yy + increment.strain.zz;
  }

  /// Stretches along x by a logarithmic strain increment while both lateral stresses stay zero (secant iteration on the
  /// lateral strain).
  void step_uniaxial_stress(double strain) {
    const MaterialPoint start = *this;
    const auto lateral_stress = [&](double lateral) {
      *this = start;
      Gradient gradient;
      gradient.h[0][0] = strain, gradient.h[1][1] = lateral, gradient.h[2][2] = lateral;
      step(gradient);
      return stress_yy();
    };
    double a = -0.5 * strain, b = -0.3 * strain;
    double fa = lateral_stress(a), fb = lateral_stress(b);
    for (int i = 0; i < 60 && std::abs(fb) > 1e-11 && fa != fb; ++i) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb;
      b = c, fb = lateral_stress(b);
    }
  }
};

} // namespace mpfem::test
