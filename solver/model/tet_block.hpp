#pragma once
// How the tets of a grain lie in memory. Kernels stream through these blocks; apart from them only
// solver/model/tets.hpp knows that tets come in packs.

#include <cstdint>
#include <variant>

#include "solver/model/lazy_array.hpp"
#include "solver/physics/pack.hpp"

namespace mpfem {

/// One pack of tetrahedra: connectivity and state side by side, so that an element pass streams through memory once.
/// 88 bytes per tetrahedron in doubles, 52 in floats. The last block of a grain repeats its last tet in unused lanes.
template <class Real>
struct alignas(native_lanes_of<Real> * sizeof(Real)) TetBlock {
  static constexpr int lanes = native_lanes_of<Real>;
  std::int32_t node[4][lanes]; ///< relative to the grain's first node
  Real inverse_volume[lanes];  ///< 1/mm^3, of the reference volume
  Real deviator[5][lanes];     ///< Cauchy deviator xx, yy, xy, yz, zx, MPa
  Real flow_stress[lanes];     ///< MPa
  Real plastic_strain[lanes];
  Real length[lanes]; ///< c_d times the undamped critical step 2/omega_e, mm; set at each step estimate
};

/// In double precision, or in single where the scenario's precision is mixed.
using TetBlocks = std::variant<LazyArray<TetBlock<double>>, LazyArray<TetBlock<float>>>;

} // namespace mpfem
