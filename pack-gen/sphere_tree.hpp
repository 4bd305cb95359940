#pragma once
// A tree of spheres that finds the pair with the smallest gap, however much their sizes differ and wherever they crowd.

#include <vector>

#include "pack-gen/packing.hpp"

namespace mpfem {

/// The smallest gap between the surfaces of two spheres; infinity and no pair if there are fewer than two. The search
/// ends early at the first pair whose gap is below `enough`: if all spheres overlapped, each would have to be compared
/// with each.
SphereGap smallest_gap_of_pairs(const std::vector<Point>& center, const std::vector<double>& radius, double enough);

} // namespace mpfem
