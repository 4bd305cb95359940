#pragma once
// Isotropic elasticity: moduli, the volumetric law p = -K ln J in total form (no drift), hypoelastic deviator.

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Elastic moduli in MPa.
struct ElasticModuli {
  double bulk;
  double shear;
  /// Lame's first parameter.
  double lame() const { return bulk - 2.0 / 3.0 * shear; }
  /// lambda + 2 mu, the modulus of dilatational waves.
  double dilatational() const { return bulk + 4.0 / 3.0 * shear; }
};

inline ElasticModuli elastic_moduli(double youngs_modulus, double poissons_ratio) {
  return {youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)), youngs_modulus / (2.0 * (1.0 + poissons_ratio))};
}

/// Cauchy mean stress (tension positive, MPa) at the volume ratio J.
template <class S>
S mean_stress(const ElasticModuli& moduli, const S& volume_ratio) {
  return S(moduli.bulk) * log(volume_ratio);
}

/// Energy per reference volume (MPa) whose derivative with respect to J is K ln J.
template <class S>
S volumetric_energy(const ElasticModuli& moduli, const S& volume_ratio) {
  return S(moduli.bulk) * (volume_ratio * log(volume_ratio) - volume_ratio + S(1.0));
}

/// Elastic distortion energy per current volume (MPa), s:s/(4G).
template <class S>
S distortion_energy(const ElasticModuli& moduli, const Deviator<S>& s) {
  return S(0.25 / moduli.shear) * double_contraction(s);
}

/// Adds 2 G dev(strain increment) to the rotated deviator.
template <class S>
Deviator<S> elastic_predictor(const ElasticModuli& moduli, const Deviator<S>& s, const SymmetricTensor<S>& strain) {
  const S g2(2.0 * moduli.shear);
  const S third = S(1.0 / 3.0) * (strain.xx + strain.yy + strain.zz);
  return {s.xx + g2 * (strain.xx - third), s.yy + g2 * (strain.yy - third), s.xy + g2 * strain.xy,
          s.yz + g2 * strain.yz, s.zx + g2 * strain.zx};
}

} // namespace mpfem
