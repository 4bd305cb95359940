#pragma once
// Orders in which neighbours in space become neighbours in memory.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Orders tets so that every eight consecutive ones lie together. The set is halved into whole groups of eight across
/// the longest side of the box of its centres, and so are the halves, down to single groups. Only the last group may
/// have fewer.
void order_in_patches(std::span<std::int32_t> tets, const std::function<const Vector3<double>&(std::int32_t)>& centre);

/// The grains along a Morton curve through the box. Contact, which reads every grain's neighbours, finds them in the
/// cache when it takes the grains in this order. Collective.
std::vector<std::int32_t> spatial_order(const Model& model, const Communicator& ranks);

} // namespace mpfem
