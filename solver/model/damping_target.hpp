#pragma once
// The velocity towards which damping draws a grain.

#include <array>

#include "solver/model/model.hpp"
#include "solver/physics/damping.hpp"

namespace mpfem {

/// mm/s: the affine velocity field (solver/physics/damping.hpp) at the grain's centre of mass; 0 without damping. The
/// fourth number belongs to the spare column of the node rows and is 0.
std::array<double, 4> damping_target(const Model& model, int grain, const Advance& parameters);

} // namespace mpfem
