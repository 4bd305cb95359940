// Speed against error with friction: two caps that are dragged to and fro, and a column in a die that rubs. Prints the
// tables of docs/speed-against-error/README.md. Usage: friction-accuracy [largest number of cells, default 18]

#include <chrono>
#include <cstdlib>

#include <fmt/format.h>

#include "tests/support/die_column.hpp"
#include "tests/support/partial_slip.hpp"

namespace {

using namespace mpfem;
using namespace mpfem::test;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Tets of a block of n^3 cells.
int tets_of_cube(int n) {
  return 6 * n * n * n;
}

void print_partial_slip(int largest) {
  fmt::print("| element | elements in the contact's radius | tets | shear force out | back | loss per cycle | s |\n"
             "|---|---|---|---|---|---|---|\n");
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp})
    for (int n = 10; n <= largest; n += 4) {
      const auto start = Clock::now();
      const partial_slip::Errors e = partial_slip::errors({n, element}, 0.3);
      // Of the half edge's n/2 cells six tenths span 1.4 radii.
      fmt::print("| `{}` | {:.1f} | {} | {:.1f} % | {:.1f} % | {:+.1f} % | {:.3g} |\n", element_name(element),
                 0.6 * n / 2 / 1.4, 2 * tets_of_cube(n), 100 * e.out, 100 * e.back, 100 * e.loss, seconds_since(start));
      std::fflush(stdout);
    }
}

void print_die_column(int largest) {
  // nu, mu, transmission by finite elements (tests/reference/die_transmission.csv).
  constexpr std::array<std::array<double, 3>, 2> cases = {{{0.3, 0.1, 0.8422}, {0.4, 0.3, 0.4657}}};
  fmt::print("\n| element | R/h | tets | transmission, nu = 0.3, mu = 0.1 | nu = 0.4, mu = 0.3 | s |\n"
             "|---|---|---|---|---|---|\n");
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp})
    for (const int n : {4, 6, 8, 12, 16}) {
      if (n > largest) continue;
      const auto start = Clock::now();
      fmt::print("| `{}` | {} | {} ", element_name(element), n, tets_of_cube(n));
      for (const auto& [nu, mu, reference] : cases)
        fmt::print("| {:+.2f} % ", 100 * (die_column::press({n, element}, nu, mu).transmission / reference - 1));
      fmt::print("| {:.3g} |\n", seconds_since(start));
      std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 18;
  print_partial_slip(largest);
  print_die_column(largest);
}
