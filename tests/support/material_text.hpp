#pragma once
// The beginning of a scenario for tests: packing.h5 of grains of microcrystalline cellulose.

#include <string>

namespace mpfem::test {

/// Up to what follows the material: outputs, bonds, stages.
inline const std::string material_text = R"(packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25
coefficient = 125
exponent = 0.3
)";

} // namespace mpfem::test
