#pragma once
// Bounds of the stable time step of central differences, and bulk viscosity, which uses the same length.

#include <algorithm>

#include "solver/physics/elasticity.hpp"
#include "solver/physics/kinematics.hpp"

namespace mpfem {

/// Upper bound of the largest eigenfrequency squared (1/s^2) of a linear tetrahedron with lumped mass rho V/4 a node:
///   omega^2 <= (4/rho) (lambda tr M + 2 mu lambda_max(M)),   M = sum over nodes of grad N (x) grad N.
/// Derivation: for nodal displacements u_a with gradient L = sum u_a (x) grad N_a, the smallest kinetic norm is
/// sum |u_a|^2 = tr(L M^-1 L^T); in the eigenbasis of M the diagonal part of sym L gives at most lambda tr M + 2 mu
/// m_max and the shear part at most 2 mu m_max. lambda_max is bounded from tr M and tr M^2 (tight when two eigenvalues
/// agree). `density` in tonne/mm^3 as used for the mass, referred to the current volume.
template <class S>
S largest_frequency_squared(const ElasticModuli& moduli, const S& density, const TetGeometry<S>& geometry) {
  const S inverse = S(1.0) / (geometry.det * geometry.det);
  const Vector3<S>* a = geometry.area;
  const Vector3<S> b = -(a[0] + a[1] + a[2]);
  const S mxx = a[0].x * a[0].x + a[1].x * a[1].x + a[2].x * a[2].x + b.x * b.x;
  const S myy = a[0].y * a[0].y + a[1].y * a[1].y + a[2].y * a[2].y + b.y * b.y;
  const S mzz = a[0].z * a[0].z + a[1].z * a[1].z + a[2].z * a[2].z + b.z * b.z;
  const S mxy = a[0].x * a[0].y + a[1].x * a[1].y + a[2].x * a[2].y + b.x * b.y;
  const S myz = a[0].y * a[0].z + a[1].y * a[1].z + a[2].y * a[2].z + b.y * b.z;
  const S mzx = a[0].z * a[0].x + a[1].z * a[1].x + a[2].z * a[2].x + b.z * b.x;
  const S trace = mxx + myy + mzz;
  const S squares = mxx * mxx + myy * myy + mzz * mzz + S(2.0) * (mxy * mxy + myz * myz + mzx * mzx);
  const S spread = max(squares - trace * trace * S(1.0 / 3.0), S(0.0));
  const S largest_eigenvalue = S(1.0 / 3.0) * trace + sqrt(S(2.0 / 3.0) * spread);
  return S(4.0) * (S(std::max(moduli.lame(), 0.0)) * trace + S(2.0 * moduli.shear) * largest_eigenvalue) * inverse /
         density;
}

/// Damping of volumetric oscillations.
struct BulkViscosity {
  double linear;    ///< b1
  double quadratic; ///< b2, acts in compression only
};

/// Viscous pressure (compression positive, MPa): -b1 rho c L rate + (b2 L rate)^2 rho where rate < 0.
/// `rate` volumetric strain rate 1/s; `length` mm; `wave_speed` mm/s; `density` tonne/mm^3.
template <class S>
S viscous_pressure(const BulkViscosity& viscosity, double wave_speed, const S& density, const S& length,
                   const S& rate) {
  const S compression = min(rate, S(0.0));
  const S quadratic = S(viscosity.quadratic) * length * compression;
  return density * (quadratic * quadratic - S(viscosity.linear * wave_speed) * length * rate);
}

/// Factor sqrt(1 + xi^2) - xi by which a damping ratio xi lowers the stable step 2/omega.
template <class S>
S damped_step_factor(const S& damping_ratio) {
  return sqrt(S(1.0) + damping_ratio * damping_ratio) - damping_ratio;
}

} // namespace mpfem
