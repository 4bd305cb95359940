#pragma once
// A tablet of eight grains, through all of its stages.

#include <string>

#include "tests/support/material_text.hpp"

namespace mpfem::test {

/// Eight grains in a round die: pressed from both sides, unloaded, ejected, crushed between plates.
inline const std::string tablet_text = material_text + R"([contact]
friction = 0.3
[bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.05
[gravity]
acceleration = [0, 0, -1e6]
[output]
history_rows = 20
[[tools]]
name = "die"
type = "cylinder"
radius = 0.29
extent = [-0.1, 0.4]
rounding = 0.03
friction = 0.1
[[tools]]
name = "lower"
type = "plane"
face = "-z"
friction = 0.2
[[tools]]
name = "upper"
type = "plane"
face = "+z"
[[tools]]
name = "plate"
type = "plane"
face = "+x"
[container]
wall = "die"
lower = "lower"
upper = "upper"
[[stages]]
name = "compaction"
type = "tools"
away = ["plate"]
relative_density = 0.45
drive.upper.speed = 20000
drive.lower.speed = 20000
[[stages]]
name = "hold"
type = "tools"
away = ["plate"]
duration = 1e-6
[[stages]]
name = "unload"
type = "tools"
away = ["plate"]
force = 0
watch = "upper"
drive.upper.speed = -10000
[[stages]]
name = "eject"
type = "tools"
away = ["plate", "upper"]
travel = 0.05
drive.lower.velocity = [0, 0, 20000]
[[stages]]
name = "crush"
type = "tools"
away = ["die", "upper"]
travel = 0.02
drive.plate.speed = 10000
)";

} // namespace mpfem::test
