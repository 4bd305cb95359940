#include "solver/kernels/element_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/kernels/rows.hpp"
#include "solver/physics/tet4.hpp"
#include "solver/physics/tet4_anp.hpp"
#include "solver/physics/tet4_patch.hpp"

namespace mpfem {

namespace {

constexpr int W = TetBlock::lanes;
using S = Pack<W>;

Deviator<S> load_deviator(const TetBlock& block) {
  return {S::load(block.deviator[0]), S::load(block.deviator[1]), S::load(block.deviator[2]),
          S::load(block.deviator[3]), S::load(block.deviator[4])};
}

TetState<S> load_state(const TetBlock& block) {
  return {load_deviator(block), {S::load(block.flow_stress), S::load(block.plastic_strain)}};
}

void store_deviator(TetBlock& block, const Deviator<S>& s) {
  s.xx.store(block.deviator[0]), s.yy.store(block.deviator[1]), s.xy.store(block.deviator[2]);
  s.yz.store(block.deviator[3]), s.zx.store(block.deviator[4]);
}

TetGeometry<S> current_geometry(const TetBlock& block, const double* position) {
  Vector3<S> edge[3];
  load_edges<W, 3>(position, block.node, edge);
  return tet_geometry(edge[0], edge[1], edge[2]);
}

S volume_ratio(const TetBlock& block, const TetGeometry<S>& geometry) {
  return S(1.0 / 6.0) * geometry.det * S::load(block.inverse_volume);
}

S current_volume_ratio(const TetBlock& block, const double* position) {
  return volume_ratio(block, current_geometry(block, position));
}

S lane_weights(int lanes) {
  S weight(0.0);
  for (int i = 0; i < lanes; ++i) weight.v[i] = 1.0;
  return weight;
}

/// Mean stress of a tet from its own volume.
struct OwnPressure {
  ElasticModuli moduli;
  void enter(std::int32_t) {}
  S operator()(const TetBlock&, const S& volume_ratio) const { return mean_stress(moduli, volume_ratio); }
};

/// Volumes around the nodes of a grain, a quarter of every tet's, into `volume` [nodes of the grain].
[[gnu::flatten]] void nodal_volumes(const Model& model, int grain, double* volume) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  std::fill(volume, volume + (model.node_offset[g + 1] - model.node_offset[g]), 0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const S quarter = S(1.0 / 24.0) * current_geometry(block, position).det;
    const int lanes = model.tets_in_block(grain, b);
    for (int lane = 0; lane < lanes; ++lane)
      for (const auto& node : block.node) volume[node[lane]] += quarter.v[lane];
  }
}

/// Mean stress of a tet as the mean of its nodes', with a share of its own.
struct AveragedPressure {
  const double* nodal; ///< MPa, of the grain's nodes
  double own = 0;      ///< share of the tet's own mean stress
  ElasticModuli moduli{};
  void enter(std::int32_t) {}
  S operator()(const TetBlock& block, const S& volume_ratio) const {
    const S mean = mean_of_nodes(load_numbers<W>(nodal, block.node[0]), load_numbers<W>(nodal, block.node[1]),
                                 load_numbers<W>(nodal, block.node[2]), load_numbers<W>(nodal, block.node[3]));
    if (own == 0) return mean;
    return S(1 - own) * mean + S(own) * mean_stress(moduli, volume_ratio);
  }
};

/// Mean stresses of the nodes of a grain, into `mean` [nodes of the grain].
AveragedPressure average_pressure(const Model& model, int grain, double* mean) {
  nodal_volumes(model, grain, mean);
  const ElasticModuli moduli = model.material_of(grain).moduli;
  const auto first = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain)]);
  const auto count = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain) + 1]) - first;
  for (std::size_t n = 0; n < count; ++n)
    mean[n] = nodal_mean_stress(moduli, mean[n], model.inverse_nodal_volume[first + n]);
  return {mean, model.own_pressure, moduli};
}

/// Volume of patch `patch` of a grain, mm^3: its tets are those of consecutive blocks.
double patch_volume(const Model& model, int grain, std::int32_t patch) {
  static_assert(patch_tets % W == 0);
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  const std::int32_t first = model.block_offset[g] + patch * (patch_tets / W),
                     end = std::min(first + patch_tets / W, model.block_offset[g + 1]);
  S volume(0.0);
  for (std::int32_t b = first; b < end; ++b) {
    const S det = current_geometry(model.block[static_cast<std::size_t>(b)], position).det;
    const int lanes = model.tets_in_block(grain, b);
    volume += lanes < W ? lane_weights(lanes) * det : det;
  }
  return sum(volume) / 6.0;
}

/// Mean stress of a tet as that of its patch, with a share of its own.
struct PatchPressure {
  const Model& model;
  int grain;
  ElasticModuli moduli;
  S mean{0.0};
  /// Before the tets of block `b`.
  void enter(std::int32_t b) {
    constexpr std::int32_t blocks = patch_tets / W;
    const auto g = static_cast<std::size_t>(grain);
    const std::int32_t within = b - model.block_offset[g];
    if (within % blocks != 0) return;
    const std::int32_t patch = within / blocks;
    mean = S(patch_mean_stress(moduli, patch_volume(model, grain, patch),
                               model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]));
  }
  S operator()(const TetBlock&, const S& volume_ratio) const {
    if (model.own_pressure == 0) return mean;
    return S(1 - model.own_pressure) * mean + S(model.own_pressure) * mean_stress(moduli, volume_ratio);
  }
};

/// f(pressure) with what gives the tets of a grain their mean stress, for its present positions. `nodal` [nodes of the grain] is
/// written where nodes take part, and kept as long as f needs it.
template <class F>
auto with_pressure(const Model& model, int grain, double* nodal, F&& f) {
  const ElasticModuli moduli = model.material_of(grain).moduli;
  switch (model.element) {
  case ElementType::tet4_anp:
    return f(average_pressure(model, grain, nodal));
  case ElementType::tet4_patch:
    return f(PatchPressure{model, grain, moduli});
  default:
    return f(OwnPressure{moduli});
  }
}

// flatten: everything below is inlined here. Called as functions, packs go through memory: 1.2 times the time.
template <class Law, class Pressure>
[[gnu::flatten]] ElementSums element_pass(Model& model, int grain, double time_step, const Law& law,
                                          Pressure pressure) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const double* velocity = model.velocity.data() + 4 * first_node;
  double* force = model.force.data() + 4 * first_node;
  std::fill(force, force + 4 * (model.node_offset[g + 1] - first_node), 0.0);

  const Material& material = model.material_of(grain);
  const TetConstants constants{material.moduli, model.viscosity, material.wave_speed, material.density, time_step};
  S plastic_work(0.0), viscous_work(0.0), largest_strain(0.0), smallest_ratio(1.0), check(0.0);

  const std::int32_t end = model.block_offset[g + 1];
  for (std::int32_t b = model.block_offset[g]; b < end; ++b) {
    TetBlock& block = model.block[static_cast<std::size_t>(b)];
    pressure.enter(b);
    Vector3<S> edge[3], edge_velocity[3];
    load_edges<W, 3>(position, block.node, edge);
    load_edges<W, 3>(velocity, block.node, edge_velocity);
    auto update = update_tet(law, constants, edge, edge_velocity, load_state(block), S::load(block.inverse_volume),
                             S::load(block.length), [&](const S& ratio) { return pressure(block, ratio); });
    store_deviator(block, update.state.deviator);
    if constexpr (Law::yields) {
      update.state.hardening.flow_stress.store(block.flow_stress);
      update.state.hardening.plastic_strain.store(block.plastic_strain);
    }
    if (const int lanes = model.tets_in_block(grain, b); lanes < W) { // nothing from unused lanes
      const S weight = lane_weights(lanes);
      for (auto& f : update.force) f = weight * f;
      update.volume *= weight;
    }
    add_balanced<W>(force, block.node, update.force);
    plastic_work += update.volume * update.plastic_work;
    viscous_work += update.volume * update.viscous_work;
    largest_strain = max(largest_strain, update.strain_increment_square);
    smallest_ratio = min(smallest_ratio, update.volume_ratio);
    check += update.mean; // becomes NaN or infinite where anything above is
  }
  const bool admissible = smallest(smallest_ratio) > 0 && std::isfinite(sum(check)) && std::isfinite(sum(plastic_work));
  return {sum(plastic_work), sum(viscous_work), std::sqrt(largest(largest_strain)), admissible};
}

} // namespace

ElementSums element_forces(Model& model, int grain, double time_step) {
  return std::visit(
      [&](const auto& law) {
        double* nodal = model.nodal_mean.empty()
                            ? nullptr
                            : model.nodal_mean.data() + model.node_offset[static_cast<std::size_t>(grain)];
        return with_pressure(model, grain, nodal, [&](const auto& pressure) {
          return element_pass(model, grain, time_step, law, pressure);
        });
      },
      model.material_of(grain).flow);
}

double elastic_energy(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  const ElasticModuli moduli = model.material_of(grain).moduli;
  // The part of the volumetric energy that belongs to single tets; the rest belongs to nodes or patches.
  const double own = model.element == ElementType::tet4 ? 1.0 : model.own_pressure;
  S energy(0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const S ratio = current_volume_ratio(block, position);
    S density = ratio * distortion_energy(moduli, load_deviator(block));
    if (own > 0) density += S(own) * volumetric_energy(moduli, ratio);
    energy += lane_weights(model.tets_in_block(grain, b)) / S::load(block.inverse_volume) * density;
  }
  double total = sum(energy);
  if (model.element == ElementType::tet4_anp) {
    const auto first = static_cast<std::size_t>(model.node_offset[g]);
    std::vector<double> volume(static_cast<std::size_t>(model.node_offset[g + 1]) - first);
    nodal_volumes(model, grain, volume.data());
    for (std::size_t n = 0; n < volume.size(); ++n)
      total += (1 - own) * nodal_volumetric_energy(moduli, volume[n], model.inverse_nodal_volume[first + n]);
  }
  if (model.element == ElementType::tet4_patch)
    for (std::int32_t patch = 0; patch < model.patch_offset[g + 1] - model.patch_offset[g]; ++patch)
      total += (1 - own) * patch_volumetric_energy(
                               moduli, patch_volume(model, grain, patch),
                               model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]);
  return total;
}

double current_volume(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  S volume(0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock& block = model.block[static_cast<std::size_t>(b)];
    volume += lane_weights(model.tets_in_block(grain, b)) * current_geometry(block, position).det;
  }
  return sum(volume) / 6.0;
}

BadTet find_bad_tet(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const S ratio = current_volume_ratio(model.block[static_cast<std::size_t>(b)], position);
    for (int lane = 0; lane < model.tets_in_block(grain, b); ++lane) {
      const std::int32_t tet = model.tet_offset[g] + (b - model.block_offset[g]) * W + lane;
      if (!(ratio[lane] > 0) || !std::isfinite(ratio[lane]))
        return {model.file_tet[static_cast<std::size_t>(tet)], ratio[lane]};
    }
  }
  return {};
}

[[gnu::flatten]] StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                        double strain_rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const Material& material = model.material_of(grain);
  S smallest_step(std::numeric_limits<double>::infinity()), smallest_no_contact = smallest_step;
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const auto geometry = current_geometry(block, position);
    const S ratio = volume_ratio(block, geometry);
    S element = largest_frequency_squared(material.moduli, S(material.density) / ratio, geometry);
    S length = S(2.0 * material.wave_speed) / sqrt(element);
    if (!model.mass_factor.empty()) {
      // By the same inequality: an element's share of its nodes' mass grew at least as the least scaled of them.
      S factor(std::numeric_limits<double>::infinity());
      for (int i = 0; i < W; ++i)
        for (const auto& node : block.node)
          factor.v[i] = std::min(factor.v[i], model.mass_factor[static_cast<std::size_t>(first_node + node[i])]);
      element = element / factor;
      // Viscosity is the true mass's, so that scaled nodes are damped less; but less where the mass is less.
      length = length * sqrt(min(factor, S(1.0)));
    }
    length.store(block.length);
    S contact(0.0);
    if (!nodal_stiffness_rate.empty()) {
      for (int i = 0; i < W; ++i)
        for (const auto& node : block.node)
          contact.v[i] = std::max(contact.v[i], nodal_stiffness_rate[static_cast<std::size_t>(first_node + node[i])]);
    }
    const S quadratic =
        S(model.viscosity.quadratic * model.viscosity.quadratic * strain_rate / material.wave_speed) * length;
    const S damped = S(2.0) * damped_step_factor(S(model.viscosity.linear) + quadratic);
    smallest_step = min(smallest_step, damped / sqrt(element + contact));
    smallest_no_contact = min(smallest_no_contact, damped / sqrt(element));
  }
  return {smallest(smallest_step), smallest(smallest_no_contact)};
}

TetFields tet_fields(const Model& model) {
  const auto tets = static_cast<std::size_t>(model.tets());
  TetFields fields{std::vector<float>(tets), std::vector<float>(tets), std::vector<float>(tets)};
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    const double* position = model.position.data() + 4 * model.node_offset[g];
    std::vector<double> nodal(static_cast<std::size_t>(model.node_offset[g + 1] - model.node_offset[g]));
    with_pressure(model, grain, nodal.data(), [&](auto pressure) {
      for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
        const TetBlock& block = model.block[static_cast<std::size_t>(b)];
        pressure.enter(b);
        const S q = von_mises(load_deviator(block));
        const S mean = pressure(block, current_volume_ratio(block, position));
        for (int lane = 0; lane < model.tets_in_block(grain, b); ++lane) {
          const auto tet = static_cast<std::size_t>(model.tet_offset[g] + (b - model.block_offset[g]) * W + lane);
          const auto file = static_cast<std::size_t>(model.file_tet[tet]);
          fields.von_mises[file] = static_cast<float>(q[lane]);
          fields.pressure[file] = static_cast<float>(-mean[lane]);
          fields.plastic_strain[file] = static_cast<float>(block.plastic_strain[lane]);
        }
      }
    });
  }
  return fields;
}

} // namespace mpfem
