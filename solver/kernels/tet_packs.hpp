#pragma once
// The tets of a block as packs: gathered, scattered, and weighted where lanes are unused.

#include <cstddef>
#include <cstdint>

#include "common/prefetch.hpp"
#include "solver/model/model.hpp"
#include "solver/model/row_pairs.hpp"
#include "solver/physics/tet4.hpp"

namespace mpfem {

/// A pack with one number for each tet of a block.
template <class Real>
using TetPack = Pack<TetBlock<Real>::lanes, Real>;

/// Deviators (MPa) of a block.
template <class Real>
Deviator<TetPack<Real>> load_deviator(const TetBlock<Real>& block) {
  using S = TetPack<Real>;
  return {S::load(block.deviator[0]), S::load(block.deviator[1]), S::load(block.deviator[2]),
          S::load(block.deviator[3]), S::load(block.deviator[4])};
}

/// Deviators, flow stresses (MPa) and plastic strains of a block.
template <class Real>
TetState<TetPack<Real>> load_state(const TetBlock<Real>& block) {
  using S = TetPack<Real>;
  return {load_deviator(block), {S::load(block.flow_stress), S::load(block.plastic_strain)}};
}

/// Writes deviators (MPa) to a block.
template <class Real>
void store_deviator(TetBlock<Real>& block, const Deviator<TetPack<Real>>& s) {
  s.xx.store(block.deviator[0]), s.yy.store(block.deviator[1]), s.xy.store(block.deviator[2]);
  s.yz.store(block.deviator[3]), s.zx.store(block.deviator[4]);
}

/// Geometry of a block's tets; `position` are the rows (mm) of the grain's nodes: of doubles, or row pairs of floats
/// (row_pairs.hpp), whose second rows are not used.
template <class Real>
TetGeometry<TetPack<Real>> current_geometry(const TetBlock<Real>& block, const double* position) {
  Vector3<TetPack<Real>> edge[3];
  load_edges<TetBlock<Real>::lanes, 3>(position, block.node, edge);
  return tet_geometry(edge[0], edge[1], edge[2]);
}
inline TetGeometry<TetPack<float>> current_geometry(const TetBlock<float>& block, const float* position) {
  Vector3<TetPack<float>> edge[3], unused[3];
  load_edge_pairs<TetBlock<float>::lanes, 3>(position, block.node, edge, unused);
  return tet_geometry(edge[0], edge[1], edge[2]);
}

/// Prefetches the block that follows some blocks after block `b`, if the model has it: for the first pass over the tets
/// of a grain. Where that pass computes nodal volumes, it reads a fifth of every block, which the hardware does not
/// predict: without this, it waits for memory half of its time.
template <class Real>
void prefetch_block_after(const Model& model, std::int32_t b) {
  constexpr std::int32_t blocks_ahead = 8;
  constexpr std::size_t line = 64;
  if (b + blocks_ahead >= model.block_offset.back()) return;
  const char* bytes = reinterpret_cast<const char*>(&model.block<Real>(b + blocks_ahead));
  for (std::size_t i = 0; i < sizeof(TetBlock<Real>); i += line) prefetch(bytes + i);
}

/// J = V/V_0 of a block's tets.
template <class Real>
TetPack<Real> volume_ratio(const TetBlock<Real>& block, const TetGeometry<TetPack<Real>>& geometry) {
  using S = TetPack<Real>;
  return S(1.0 / 6.0) * geometry.det * S::load(block.inverse_volume);
}

/// The same from the positions of the grain's nodes.
template <class Real>
TetPack<Real> current_volume_ratio(const TetBlock<Real>& block, const double* position) {
  return volume_ratio(block, current_geometry(block, position));
}

/// 1 in the lanes from `first` to before `end`, 0 in others.
template <class Real>
TetPack<Real> lane_weights(int first, int end) {
  TetPack<Real> weight(0.0);
  for (int i = first; i < end; ++i) weight.v[i] = 1;
  return weight;
}

} // namespace mpfem
