// Two elastic spheres that bond where they touch, by an axisymmetric boundary-element solution: the reference of fig04
// for bonds of finite strength. Prints one row an approach: case, approach and force.
//
// The pair is one frictionless half-space of modulus E* pressed by a paraboloid of curvature 1/Rbar. A ring of uniform
// pressure moves the surface by the difference of two discs (Johnson, Contact Mechanics, 1985, section 3.4):
//   u(r) = 4 p b/(pi E*) E(r/b)                                    inside a disc of radius b,
//   u(r) = 4 p r/(pi E*) (E(b/r) - (1 - b^2/r^2) K(b/r))           outside.
// The gap g = r^2/(2 Rbar) - h + u and the pressure p(g) - penalty where closed, minus the bond's traction where open,
// nothing where no contact was ever made - are solved together by Newton's method at every approach h. The bond is that
// of solver/physics/bond.hpp on its envelope: gaps of bonded rings only grow while the spheres are pulled apart.

#include <cmath>
#include <cstdio>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "solver/physics/bond.hpp"

namespace {

using namespace mpfem;

constexpr double radius = 0.1, youngs_modulus = 5000, poissons_ratio = 0.3;
constexpr double mean_radius = 0.5 * radius;
const double reduced = youngs_modulus / (2 * (1 - poissons_ratio * poissons_ratio));

/// Displacement (mm) at r by unit pressure on a disc of radius b.
double disc(double r, double b) {
  if (b == 0) return 0;
  const double factor = 4 / (M_PI * reduced);
  if (r <= b) return factor * b * std::comp_ellint_2(r / b);
  const double k = b / r;
  return factor * r * (std::comp_ellint_2(k) - (1 - k * k) * std::comp_ellint_1(k));
}

struct Rings {
  std::vector<double> middle, area;
  Eigen::MatrixXd influence; ///< mm/MPa
  explicit Rings(double outer, int count)
      : middle(static_cast<std::size_t>(count)), area(middle), influence(count, count) {
    const double width = outer / count;
    for (int j = 0; j < count; ++j) {
      const double inner = j * width, end = inner + width;
      middle[static_cast<std::size_t>(j)] = inner + 0.5 * width;
      area[static_cast<std::size_t>(j)] = M_PI * (end * end - inner * inner);
      for (int i = 0; i < count; ++i) {
        const double r = (i + 0.5) * width;
        influence(i, j) = disc(r, end) - disc(r, inner);
      }
    }
  }
};

/// Pressure and its slope at a gap: penalty where closed, the bond's envelope where open (nothing where unbonded).
struct Response {
  double pressure, slope;
};
Response response(const BondLaw& law, double gap, bool bonded) {
  if (gap < 0) return {-law.stiffness * gap, -law.stiffness};
  if (!bonded) return {0, 0};
  BondState state;
  const double traction = bond_traction(law, state, gap, 0, 0).normal;
  if (state.initiation == 0) return {-traction, -law.stiffness};
  // exponential law: T' = -T T_0/b; energy law: T = K g exp(-K (g^2 - d0^2)/(2 b))
  const double peak = law.stiffness * state.initiation, b = law.fracture_energy - 0.5 * peak * state.initiation;
  const double slope = law.softening == SofteningLaw::exponential ? -traction * peak / b
                                                                  : traction * (1 / gap - law.stiffness * gap / b);
  return {-traction, -slope};
}

/// Solves for the gaps at an approach, from the gaps given. False where Newton's method does not converge.
bool solve(const Rings& rings, const BondLaw& law, bool bonded, double approach, Eigen::VectorXd& gap) {
  const auto count = gap.size();
  for (int iteration = 0; iteration < 60; ++iteration) {
    Eigen::VectorXd pressure(count), slope(count), residual(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Response r = response(law, gap(i), bonded);
      pressure(i) = r.pressure;
      slope(i) = r.slope;
    }
    residual = gap - rings.influence * pressure;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double r = rings.middle[static_cast<std::size_t>(i)];
      residual(i) -= r * r / (2 * mean_radius) - approach;
    }
    if (residual.cwiseAbs().maxCoeff() < 1e-12) return true;
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(count, count) - rings.influence * slope.asDiagonal();
    Eigen::VectorXd change = jacobian.partialPivLu().solve(residual);
    // Across the kinks of the law, small moves only.
    const double largest = change.cwiseAbs().maxCoeff(), limit = 0.5 * law.fracture_energy / law.tensile_strength;
    if (!std::isfinite(largest)) return false;
    gap -= (largest > limit ? limit / largest : 1.0) * change;
  }
  return false;
}

double force(const Rings& rings, const BondLaw& law, bool bonded, const Eigen::VectorXd& gap) {
  double sum = 0;
  for (Eigen::Index i = 0; i < gap.size(); ++i)
    sum += response(law, gap(i), bonded).pressure * rings.area[static_cast<std::size_t>(i)];
  return sum;
}

} // namespace

int main() {
  const double energies[] = {0.01, 0.1, 0.5};
  const auto strength_of = [](double lambda, double energy) {
    const double k = 4 * reduced / 3;
    return lambda / 2 * std::cbrt(M_PI * energy * k * k / mean_radius);
  };
  fmt::print("energy [N/mm],lambda,softening,approach_of_half_spaces [R],force [E R^2]\n");
  const auto run = [&](double energy, double lambda, SofteningLaw softening, int count) {
    // As the cases of studies/fig04: pressed until the contact radius is 1.25 times that of JKR's pull-off.
    const double pull_off_radius = std::cbrt(9 * M_PI * energy * mean_radius * mean_radius / (8 * reduced));
    const double largest = 1.25 * pull_off_radius, top = largest * largest / mean_radius;
    const Rings rings(largest, count);
    const double strength = strength_of(lambda, energy);
    // Stiff enough not to matter: the area before damage is a thousandth of G^c.
    const BondLaw law{strength * strength / (2e-3 * energy), strength, strength, energy, softening, true};
    Eigen::VectorXd gap = Eigen::VectorXd::Constant(count, -1e-9);
    double step = top / 200;
    const double jkr = 1.5 * M_PI * energy * mean_radius;
    double lowest = 0, at = 0;
    for (double approach = top; approach > -3 * top;) {
      Eigen::VectorXd trial = gap;
      if (!solve(rings, law, true, approach, trial)) {
        // Closer to the end of the branch, or over it.
        approach += step;
        step *= 0.25;
        if (step < 1e-6 * top) break;
        approach -= step;
        continue;
      }
      gap = trial;
      const double f = force(rings, law, true, gap);
      if (f < lowest) lowest = f, at = approach;
      fmt::print("{},{},{},{:.6e},{:.6e}\n", energy, lambda,
                 softening == SofteningLaw::exponential ? "exponential" : "energy", approach / radius,
                 f / (youngs_modulus * radius * radius));
      approach -= step;
    }
    fmt::print(
        stderr,
        "G^c {:5} N/mm, lambda {:5}, {} rings, {}: strength {:.1f} MPa, pull-off {:.4f} of JKR at h/R = {:.5f}\n",
        energy, lambda, count, softening == SofteningLaw::exponential ? "exponential" : "energy", strength,
        -lowest / jkr, at / radius);
  };
  for (const int count : {200, 400}) run(0.1, 2, SofteningLaw::exponential, count);
  for (const double energy : energies) run(energy, 2, SofteningLaw::exponential, 300);
  for (const double lambda : {0.114, 0.25, 0.5, 1.0, 4.0}) run(0.1, lambda, SofteningLaw::exponential, 300);
  run(0.1, 2, SofteningLaw::energy, 300);
}
