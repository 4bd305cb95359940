// Error of the contact force against Hertz, over mesh size: prints the table of studies/contact-surface/README.md.
// Usage: hertz-convergence [largest R/h, default 10] [penalty factor, default 10]

#include <cstdlib>

#include <fmt/format.h>

#include "tests/support/hertz_column.hpp"

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 10;
  const double stiffness_factor = argc > 2 ? std::atof(argv[2]) : 10;
  fmt::print("penalty K = {} E/h\n{:>6} {:>8} {:>10} {:>8} {:>8} {:>14} {:>15} {:>9} {:>9}\n", stiffness_factor, "R/h",
             "tets", "approach/R", "spheres", "a/h", "on wall, error", "on sphere, error", "KE/elast", "residual");
  for (const double approach : {0.002, 0.004})
    for (const double size_ratio : {5.0, 7.0, 10.0, 14.0, 20.0})
      for (const int spheres : {1, 2}) {
        if (size_ratio > largest) continue;
        const auto r = mpfem::test::press_column(spheres, size_ratio, approach, stiffness_factor);
        fmt::print("{:>6} {:>8} {:>10.3f} {:>8} {:>8.2f} {:>13.1f} % {:>14} {:>9.1e} {:>9.1e}\n", size_ratio, r.tets,
                   approach / 0.1, spheres, r.contact_radius_over_size, 100 * r.wall_error,
                   spheres == 2 ? fmt::format("{:.1f} %", 100 * r.sphere_error) : "-", r.kinetic_over_elastic,
                   r.residual_over_work);
        std::fflush(stdout);
      }
}
