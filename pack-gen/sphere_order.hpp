#pragma once
// The numbering of spheres.

#include <cstddef>

#include "pack-gen/packing.hpp"

namespace mpfem {

/// Up to so many spheres keep the numbers that they were packed with. Their contact data fit into caches, so a step
/// takes as long with any numbers (docs/performance.md); and as a grain's mesh is turned by its number, runs of small
/// packings would otherwise give other numbers than the results that are kept.
constexpr std::size_t any_order_up_to = 1000;

/// The same spheres, numbered along a Morton curve through the container. Grains that touch then lie near each other in
/// memory and in files: contact takes less time, and the grains of a rank share few pages of memory with other grains.
SpherePacking along_a_curve(const SpherePacking& packing);

/// The same, for more than `any_order_up_to` spheres; smaller packings as they are.
SpherePacking numbered(const SpherePacking& packing);

} // namespace mpfem
