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
  double youngs() const { return 9.0 * bulk * shear / (3.0 * bulk + shear); }
};

/// K = E/(3 (1 - 2 nu)), G = E/(2 (1 + nu)). `youngs_modulus` E in MPa, `poissons_ratio` nu in (-1, 0.5).
inline ElasticModuli elastic_moduli(double youngs_modulus, double poissons_ratio) {
  return {youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)), youngs_modulus / (2.0 * (1.0 + poissons_ratio))};
}

namespace detail {

/// True if J is within a tenth of 1, as in solids under pressure. Then z = (J - 1)/(J + 1) is below 0.0527, and series
/// in z give ln J to the last digit.
template <class S>
bool near_reference(const S& volume_ratio) {
  const S distance = volume_ratio - S(1.0);
  return !any(!(max(distance, -distance) < S(0.1)));
}

/// t of   artanh z = z (1 + w t),   w = z^2:   1/3 + w/5 + w^2/7 + …; the first term left out is below 1e-19 of ln J.
template <class S>
S artanh_tail(const S& w) {
  const S series = S(1.0 / 7) + w * (S(1.0 / 9) + w * (S(1.0 / 11) + w * S(1.0 / 13)));
  return S(1.0 / 3) + w * (S(1.0 / 5) + w * series);
}

} // namespace detail

/// ln J = 2 artanh z; its series takes a quarter of the time of the general logarithm.
template <class S>
S log_of_volume_ratio(const S& volume_ratio) {
  if (!detail::near_reference(volume_ratio)) return log(volume_ratio);
  const S z = (volume_ratio - S(1.0)) / (volume_ratio + S(1.0)), w = z * z;
  return S(2.0) * z * (S(1.0) + w * detail::artanh_tail(w));
}

/// Cauchy mean stress (tension positive, MPa) at the volume ratio J.
template <class S>
S mean_stress(const ElasticModuli& moduli, const S& volume_ratio) {
  return S(moduli.bulk) * log_of_volume_ratio(volume_ratio);
}

/// Energy per reference volume (MPa) whose derivative with respect to J is K ln J:   K (J ln J - J + 1). Near J = 1 its
/// terms cancel; there the series of the logarithm gives   K 2 w (1 + z (1 + z) t) / (1 - z).
template <class S>
S volumetric_energy(const ElasticModuli& moduli, const S& volume_ratio) {
  const S bulk(moduli.bulk);
  if (!detail::near_reference(volume_ratio)) return bulk * (volume_ratio * log(volume_ratio) - volume_ratio + S(1.0));
  const S z = (volume_ratio - S(1.0)) / (volume_ratio + S(1.0)), w = z * z;
  return bulk * S(2.0) * w * (S(1.0) + z * (S(1.0) + z) * detail::artanh_tail(w)) / (S(1.0) - z);
}

/// Elastic distortion energy per current volume (MPa), s:s/(4G).
template <class S>
S distortion_energy(const ElasticModuli& moduli, const Deviator<S>& s) {
  return S(0.25 / moduli.shear) * double_contraction(s);
}

/// Work per current volume (MPa) of a volume change that the distortion energy V s:s/(4G) does not return. The rate
/// form of s, 2 G dev(d), is not derived from a potential: the stress power V s:d of elastic strain and the rate of
/// that energy differ by V' s:s/(4G), which is the work of no force. Positive in compression; smaller steps do not
/// change it.
template <class S>
S hypoelastic_work(const ElasticModuli& moduli, const Deviator<S>& s, const S& volumetric_strain) {
  return -(volumetric_strain * distortion_energy(moduli, s));
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
