#pragma once
// Parts of scenarios for tests: packing.h5 of grains of microcrystalline cellulose, and their compaction.

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

/// A stage in which eight grains come to touch each other.
inline const std::string compaction_text = R"([[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.62
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
)";

} // namespace mpfem::test
