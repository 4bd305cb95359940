// Speed against error with friction: two caps that are dragged to and fro, and a column in a die that rubs. Runs one
// case of studies/accuracy on one thread and prints its size, its steps and its values as CSV.
//
//   friction-accuracy partial-slip ELEMENT FINENESS     FINENESS: elements in the contact's radius
//   friction-accuracy die-column ELEMENT FINENESS       FINENESS: R/h
//
// ELEMENT: tet4, tet4-anp, tet4-patch.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "tests/support/die_column.hpp"
#include "tests/support/partial_slip.hpp"

namespace {

using namespace mpfem;
using namespace mpfem::test;

std::optional<ElementType> element_of(const std::string& name) {
  for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp, ElementType::tet4_patch})
    if (name == element_name(element)) return element;
  return {};
}

/// Tets of a block of n^3 cells.
int tets_of_cube(int n) {
  return 6 * n * n * n;
}

void print_size(int tets, std::int64_t steps) {
  fmt::print("quantity,value\ntets,{}\nsteps,{}\n", tets, steps);
}

/// Shear forces where they differ most from the theory: 1 and the difference over mu P. The loss is over the theory's.
void print_partial_slip(ElementType element, double fineness) {
  // Cells along an edge are even in number, so that a line of the mesh lies in the middle.
  const int n = 2 * static_cast<int>(std::lround(fineness / partial_slip::elements_in_radius(2)));
  const partial_slip::Errors errors = partial_slip::errors({.n = n, .element = element, .threads = 1}, 0.3);
  print_size(2 * tets_of_cube(n), errors.steps);
  fmt::print("shear-force-loading,{:.6e}\nshear-force-unloading,{:.6e}\nloss,{:.6e}\n", 1 + errors.out, 1 + errors.back,
             1 + errors.loss);
}

/// Transmission where the whole wall slides (mu = 0.1) and where a part of it sticks (0.3).
void print_die_column(ElementType element, double fineness) {
  const int n = static_cast<int>(std::lround(fineness));
  const die_column::Pressed slides = die_column::press({.n = n, .element = element}, 0.3, 0.1),
                            sticks = die_column::press({.n = n, .element = element}, 0.4, 0.3);
  print_size(tets_of_cube(n), slides.steps + sticks.steps);
  fmt::print("transmission-0.1,{:.6e}\ntransmission-0.3,{:.6e}\n", slides.transmission, sticks.transmission);
}

} // namespace

int main(int argc, char** argv) {
  const std::string scene = argc == 4 ? argv[1] : "";
  const std::optional<ElementType> element = argc == 4 ? element_of(argv[2]) : std::nullopt;
  const double fineness = argc == 4 ? std::atof(argv[3]) : 0;
  if (!element || !(fineness >= 1 && fineness <= 100) || (scene != "partial-slip" && scene != "die-column")) {
    fmt::print(stderr, "friction-accuracy partial-slip | die-column ELEMENT FINENESS\n");
    return 2;
  }
  if (scene == "partial-slip")
    print_partial_slip(*element, fineness);
  else
    print_die_column(*element, fineness);
}
