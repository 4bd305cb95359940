#pragma once
// Volume ratios of tets and around nodes, and how far the pressure of tets oscillates about that of their nodes.

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem::test {

/// Sums over grains, so that a packing is one sample.
struct VolumeState {
  double reference_volume = 0, volume = 0;      ///< mm^3
  double tet_lowest = 1e300, tet_highest = 0;   ///< extremes of J of single tets
  double node_lowest = 1e300, node_highest = 0; ///< of J around nodes
  double averaged_square = 0;                   ///< MPa^2 mm^3: sum of V0 (mean of the tet's nodal pressures)^2
  double mean_pressure = 0;                     ///< MPa mm^3: sum of V0 times the same
  double tet_square = 0;                        ///< MPa^2 mm^3: sum of V0 (that mean less the tet's own -K ln J)^2
  double node_square = 0; ///< MPa^2 mm^3: sum of V0 (nodal pressure less the mean of its neighbours')^2
  double pressure() const { return mean_pressure / reference_volume; }                  ///< MPa
  double pressure_rms() const { return std::sqrt(averaged_square / reference_volume); } ///< MPa
  double tet_oscillation() const { return std::sqrt(tet_square / reference_volume); }   ///< MPa
  double node_oscillation() const { return std::sqrt(node_square / reference_volume); } ///< MPa
};

/// The nodes with which each node shares a tet.
inline std::vector<std::vector<std::int32_t>> tet_neighbours(const Model& model) {
  std::vector<std::set<std::int32_t>> ring(static_cast<std::size_t>(model.nodes()));
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t tet = 0; tet < model.tet_offset[g + 1] - model.tet_offset[g]; ++tet) {
      const auto node = model.nodes_of_tet(grain, tet);
      for (const auto c : node)
        for (const auto d : node)
          if (c != d) ring[static_cast<std::size_t>(model.node_offset[g] + c)].insert(model.node_offset[g] + d);
    }
  }
  std::vector<std::vector<std::int32_t>> result;
  for (const auto& around : ring) result.emplace_back(around.begin(), around.end());
  return result;
}

/// A tet with its nodes, numbered through the model.
struct TetVolumes {
  std::int32_t node[4];
  double reference, now;                           ///< mm^3
  double ratio() const { return now / reference; } ///< J
};

inline TetVolumes tet_volumes(const Model& model, int grain, std::int32_t t) {
  const auto g = static_cast<std::size_t>(grain);
  const auto node = model.nodes_of_tet(grain, t);
  TetVolumes tet{};
  Vector3<double> x[4];
  for (std::size_t c = 0; c < 4; ++c) {
    tet.node[c] = model.node_offset[g] + node[c];
    const double* at = &model.position[4 * static_cast<std::size_t>(tet.node[c])];
    x[c] = {at[0], at[1], at[2]};
  }
  tet.now = dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]) / 6;
  tet.reference = with_tet_numbers(model, [&](auto number) {
    using Block = TetBlock<decltype(number)>;
    return 1.0 /
           model.block<decltype(number)>(model.block_offset[g] + t / Block::lanes).inverse_volume[t % Block::lanes];
  });
  return tet;
}

inline std::vector<TetVolumes> tet_volumes(const Model& model) {
  std::vector<TetVolumes> tets;
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t t = 0; t < model.tet_offset[g + 1] - model.tet_offset[g]; ++t)
      tets.push_back(tet_volumes(model, grain, t));
  }
  return tets;
}

/// A quarter of each of its tets belongs to a node.
struct NodeVolumes {
  std::vector<double> reference, now; ///< mm^3
};

inline NodeVolumes node_volumes(const std::vector<TetVolumes>& tets, std::size_t nodes) {
  NodeVolumes volumes{std::vector<double>(nodes, 0.0), std::vector<double>(nodes, 0.0)};
  for (const TetVolumes& tet : tets)
    for (const auto n : tet.node) {
      volumes.now[static_cast<std::size_t>(n)] += tet.now / 4;
      volumes.reference[static_cast<std::size_t>(n)] += tet.reference / 4;
    }
  return volumes;
}

inline void add_tets(VolumeState& state, const std::vector<TetVolumes>& tets, const std::vector<double>& pressure,
                     double bulk) {
  for (const TetVolumes& tet : tets) {
    state.volume += tet.now, state.reference_volume += tet.reference;
    state.tet_lowest = std::min(state.tet_lowest, tet.ratio());
    state.tet_highest = std::max(state.tet_highest, tet.ratio());
    double mean = 0;
    for (const auto n : tet.node) mean += 0.25 * pressure[static_cast<std::size_t>(n)];
    const double own = -bulk * std::log(tet.ratio());
    state.averaged_square += tet.reference * mean * mean;
    state.mean_pressure += tet.reference * mean;
    state.tet_square += tet.reference * (mean - own) * (mean - own);
  }
}

/// At the model's current positions, whatever its element: the nodal pressures of averaged tets, and of plain tets what
/// they would be.
inline VolumeState volume_state(const Model& model, const std::vector<std::vector<std::int32_t>>& neighbours) {
  const double bulk = model.material_of(0).moduli.bulk;
  const auto nodes = static_cast<std::size_t>(model.nodes());
  const std::vector<TetVolumes> tets = tet_volumes(model);
  const NodeVolumes volumes = node_volumes(tets, nodes);
  VolumeState result;
  std::vector<double> pressure(nodes);
  for (std::size_t n = 0; n < nodes; ++n) {
    const double ratio = volumes.now[n] / volumes.reference[n];
    result.node_lowest = std::min(result.node_lowest, ratio);
    result.node_highest = std::max(result.node_highest, ratio);
    pressure[n] = -bulk * std::log(ratio);
  }
  add_tets(result, tets, pressure, bulk);
  for (std::size_t n = 0; n < nodes; ++n) {
    double mean = 0;
    for (const auto m : neighbours[n]) mean += pressure[static_cast<std::size_t>(m)];
    mean /= static_cast<double>(neighbours[n].size());
    result.node_square += volumes.reference[n] * (pressure[n] - mean) * (pressure[n] - mean);
  }
  return result;
}

} // namespace mpfem::test
