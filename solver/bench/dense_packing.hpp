#pragma once
// A packing for measurements, made without a mesher: grains on a face-centred cubic lattice, pressed flat against each
// other as in a dense compact. Every contact exists from the first steps on, so the cost of the dense state can be
// measured at any size without compaction.

#include <cstdint>

#include "solver/model/model.hpp"

namespace mpfem {

/// A meshed packing and its density.
struct DensePacking {
  MeshedPacking packing;
  double relative_density = 0; ///< at the start
};

/// About `tets` tetrahedra in about `grains` grains of radius 0.1 mm, each turned at random (`seed`). A grain is eight
/// octants of n^3 tetrahedra each (Freudenthal's subdivision), mapped onto the ball and cut flat by 8 % of the radius
/// towards its neighbours and walls, with a gap of 1e-4 of the radius.
DensePacking make_dense_packing(std::int64_t tets, int grains, std::uint64_t seed);

} // namespace mpfem
