#pragma once
// How the tets of a grain get their mean stress: from the tet's own volume, the volumes around its nodes, or the volume
// of its patch.

#include <algorithm>
#include <cstdint>

#include "solver/kernels/tet_packs.hpp"
#include "solver/physics/tet4_anp.hpp"
#include "solver/physics/tet4_patch.hpp"

namespace mpfem {

/// Mean stress of a tet from its own volume. Nothing has read the blocks before, so they are prefetched.
template <class Real>
struct OwnPressure {
  const Model& model;
  ElasticModuli moduli;
  void enter(std::int32_t b) const { prefetch_block_after<Real>(model, b); }
  template <class Block, class S>
  S operator()(const Block&, const S& volume_ratio) const {
    return mean_stress(moduli, volume_ratio);
  }
};

/// Writes the volumes around the nodes of a grain, a quarter of every tet's, to `volume` [nodes of the grain].
/// `position`: as in current_geometry().
template <class Real, class Number>
MPFEM_FLATTEN void nodal_volumes(const Model& model, int grain, const Number* position, double* volume) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  std::fill(volume, volume + (model.end_node(grain) - model.first_node(grain)), 0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    prefetch_block_after<Real>(model, b);
    const TetBlock<Real>& block = model.block<Real>(b);
    const S quarter = S(1.0 / 24.0) * current_geometry(block, position).det;
    const int lanes = model.tets_in_block<Real>(grain, b);
    for (int lane = 0; lane < lanes; ++lane)
      for (const auto& node : block.node) volume[node[lane]] += quarter.v[lane];
  }
}

/// Mean stress of a tet: the mean over its nodes, mixed with a share of the tet's own.
struct AveragedPressure {
  const double* nodal; ///< MPa, of the grain's nodes
  double own = 0;      ///< share of the tet's own mean stress
  ElasticModuli moduli{};
  void enter(std::int32_t) {}
  template <class Real>
  TetPack<Real> operator()(const TetBlock<Real>& block, const TetPack<Real>& volume_ratio) const {
    using S = TetPack<Real>;
    const S mean = mean_of_nodes(load_numbers<Real>(nodal, block.node[0]), load_numbers<Real>(nodal, block.node[1]),
                                 load_numbers<Real>(nodal, block.node[2]), load_numbers<Real>(nodal, block.node[3]));
    if (own == 0) return mean;
    return S(1 - own) * mean + S(own) * mean_stress(moduli, volume_ratio);
  }
};

/// Writes the mean stresses at the nodes of a grain to `mean` [nodes of the grain].
template <class Real, class Number>
AveragedPressure average_pressure(const Model& model, int grain, const Number* position, double* mean) {
  nodal_volumes<Real>(model, grain, position, mean);
  const ElasticModuli moduli = model.material_of(grain).moduli;
  const std::size_t first = model.first_node(grain), count = model.end_node(grain) - first;
  for (std::size_t n = 0; n < count; ++n)
    mean[n] = nodal_mean_stress(moduli, mean[n], model.inverse_nodal_volume[first + n]);
  return {mean, model.own_pressure, moduli};
}

/// Volume of patch `patch` of a grain, mm^3. Its tets are those of consecutive blocks, or a part of one block.
/// `position`: as in current_geometry().
template <class Real, class Number>
double patch_volume(const Model& model, int grain, const Number* position, std::int32_t patch) {
  using S = TetPack<Real>;
  constexpr int W = TetBlock<Real>::lanes;
  static_assert(patch_tets % W == 0 || W % patch_tets == 0);
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_tet = patch * patch_tets;
  const std::int32_t first = model.block_offset[g] + first_tet / W,
                     end = std::min(first + std::max(patch_tets / W, 1), model.block_offset[g + 1]);
  const int lane = first_tet % W;
  S volume(0.0);
  for (std::int32_t b = first; b < end; ++b) {
    const S det = current_geometry(model.block<Real>(b), position).det;
    const int lanes = std::min(model.tets_in_block<Real>(grain, b), lane + patch_tets);
    volume += lanes - lane < W ? lane_weights<Real>(lane, lanes) * det : det;
  }
  return sum(volume) / 6.0;
}

/// Mean stress of a tet: that of its patch, mixed with a share of the tet's own.
template <class Real, class Number>
struct PatchPressure {
  using S = TetPack<Real>;
  const Model& model;
  int grain;
  const Number* position; ///< as in current_geometry()
  ElasticModuli moduli;
  S mean{0.0};
  /// To be called before the tets of block `b`.
  void enter(std::int32_t b) {
    constexpr int W = TetBlock<Real>::lanes;
    const std::int32_t tet = (b - model.block_offset[static_cast<std::size_t>(grain)]) * W;
    if (tet % patch_tets != 0) return;
    mean = S(mean_of(tet / patch_tets));
    if constexpr (W > patch_tets) {
      const std::int32_t end = tet + model.tets_in_block<Real>(grain, b);
      for (std::int32_t next = tet + patch_tets; next < end; next += patch_tets) {
        const double value = mean_of(next / patch_tets);
        for (int lane = next - tet; lane < W; ++lane) mean.v[lane] = static_cast<Real>(value);
      }
    }
  }
  S operator()(const TetBlock<Real>&, const S& volume_ratio) const {
    if (model.own_pressure == 0) return mean;
    return S(1 - model.own_pressure) * mean + S(model.own_pressure) * mean_stress(moduli, volume_ratio);
  }

private:
  double mean_of(std::int32_t patch) const {
    const auto g = static_cast<std::size_t>(grain);
    return patch_mean_stress(moduli, patch_volume<Real>(model, grain, position, patch),
                             model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]);
  }
};

/// Returns f(pressure), where `pressure` gives the tets of a grain their mean stress at the current positions. They are
/// read from `position`, as in current_geometry(). `nodal` [nodes of the grain] is written if nodes take part. Both
/// must live as long as f needs them.
template <class Real, class Number, class F>
auto with_pressure(const Model& model, int grain, const Number* position, double* nodal, F&& f) {
  const ElasticModuli moduli = model.material_of(grain).moduli;
  switch (model.element) {
  case ElementType::tet4_anp:
    return f(average_pressure<Real>(model, grain, position, nodal));
  case ElementType::tet4_patch:
    return f(PatchPressure<Real, Number>{model, grain, position, moduli});
  case ElementType::tet4:
    break;
  }
  return f(OwnPressure<Real>{model, moduli});
}

} // namespace mpfem
