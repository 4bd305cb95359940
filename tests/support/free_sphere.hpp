#pragma once
// Eigenfrequencies of a free, homogeneous, isotropic elastic sphere (Lamb 1882), from its frequency equations.
// Derivation: tests/reference/README.md.

#include <cmath>
#include <stdexcept>

namespace mpfem::test {

/// Modes of the sphere by the order l of their spherical harmonic.
enum class SphereMode {
  spheroidal, ///< l = 0 breathing, l = 2 the ellipsoidal modes
  torsional,  ///< l = 2: one half turns against the other; depends on the shear modulus alone
};

/// Left-hand side of the frequency equation at eta = omega R/c_s.
inline double sphere_frequency_function(SphereMode mode, int l, double eta, double poissons_ratio) {
  const auto order = static_cast<unsigned>(l);
  const auto j = [](unsigned n, double x) { return std::sph_bessel(n, x); };
  if (mode == SphereMode::torsional) return (l - 1) * j(order, eta) - eta * j(order + 1, eta);
  // c_s/c_d
  const double ratio = std::sqrt((1 - 2 * poissons_ratio) / (2 - 2 * poissons_ratio)), xi = eta * ratio;
  const double phi = j(order, xi), phi_slope = l * phi - xi * j(order + 1, xi);
  const double psi = j(order, eta), psi_slope = l * psi - eta * j(order + 1, eta);
  const double degree = l * (l + 1), square = eta * eta;
  const double normal_by_pressure = (2 * degree - square) * phi - 4 * phi_slope;
  if (l == 0) return normal_by_pressure;
  const double normal_by_shear = 2 * degree * (psi_slope - psi);
  const double tangential_by_pressure = 2 * (phi_slope - phi);
  const double tangential_by_shear = (2 * degree - square - 2) * psi - 2 * psi_slope;
  return normal_by_pressure * tangential_by_shear - normal_by_shear * tangential_by_pressure;
}

/// omega R/c_s of the lowest mode above rigid motion (l = 0 or l >= 2).
inline double sphere_eigenvalue(SphereMode mode, int l, double poissons_ratio) {
  if (l == 1) throw std::invalid_argument("l = 1 begins with rigid motion");
  const auto f = [&](double eta) { return sphere_frequency_function(mode, l, eta, poissons_ratio); };
  double low = 0.5;
  while (f(low) * f(low + 0.01) > 0) {
    low += 0.01;
    if (low > 20) throw std::runtime_error("no eigenvalue found");
  }
  double high = low + 0.01;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(low) * f(middle) <= 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Angular frequency (1/s) of a sphere of a radius (mm), Young's modulus (MPa) and density (tonne/mm^3).
inline double sphere_frequency(SphereMode mode, int l, double radius, double youngs_modulus, double poissons_ratio,
                               double density) {
  const double shear_speed = std::sqrt(youngs_modulus / (2 * (1 + poissons_ratio)) / density);
  return sphere_eigenvalue(mode, l, poissons_ratio) * shear_speed / radius;
}

} // namespace mpfem::test
