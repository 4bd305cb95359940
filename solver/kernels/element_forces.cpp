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

template <class Real>
using TetPack = Pack<TetBlock<Real>::lanes, Real>;

template <class Real>
Deviator<TetPack<Real>> load_deviator(const TetBlock<Real>& block) {
  using S = TetPack<Real>;
  return {S::load(block.deviator[0]), S::load(block.deviator[1]), S::load(block.deviator[2]),
          S::load(block.deviator[3]), S::load(block.deviator[4])};
}

template <class Real>
TetState<TetPack<Real>> load_state(const TetBlock<Real>& block) {
  using S = TetPack<Real>;
  return {load_deviator(block), {S::load(block.flow_stress), S::load(block.plastic_strain)}};
}

template <class Real>
void store_deviator(TetBlock<Real>& block, const Deviator<TetPack<Real>>& s) {
  s.xx.store(block.deviator[0]), s.yy.store(block.deviator[1]), s.xy.store(block.deviator[2]);
  s.yz.store(block.deviator[3]), s.zx.store(block.deviator[4]);
}

template <class Real>
TetGeometry<TetPack<Real>> current_geometry(const TetBlock<Real>& block, const double* position) {
  Vector3<TetPack<Real>> edge[3];
  load_edges<TetBlock<Real>::lanes, 3>(position, block.node, edge);
  return tet_geometry(edge[0], edge[1], edge[2]);
}

/// Asks memory for the block that lies some after block `b`, if the model has it. The first pass over the tets of a grain takes a fifth
/// of every block, which caches do not foresee: nodal volumes waited for it through half of their time.
template <class Real>
void ask_ahead(const Model& model, std::int32_t b) {
  constexpr std::int32_t blocks_ahead = 8;
  constexpr std::size_t line = 64;
  if (b + blocks_ahead >= model.block_offset.back()) return;
  const char* bytes = reinterpret_cast<const char*>(&model.block<Real>(b + blocks_ahead));
  for (std::size_t i = 0; i < sizeof(TetBlock<Real>); i += line) __builtin_prefetch(bytes + i);
}

template <class Real>
TetPack<Real> volume_ratio(const TetBlock<Real>& block, const TetGeometry<TetPack<Real>>& geometry) {
  using S = TetPack<Real>;
  return S(1.0 / 6.0) * geometry.det * S::load(block.inverse_volume);
}

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

/// Mean stress of a tet from its own volume.
struct OwnPressure {
  ElasticModuli moduli;
  void enter(std::int32_t) {}
  template <class Block, class S>
  S operator()(const Block&, const S& volume_ratio) const {
    return mean_stress(moduli, volume_ratio);
  }
};

/// Volumes around the nodes of a grain, a quarter of every tet's, into `volume` [nodes of the grain].
template <class Real>
MPFEM_FLATTEN void nodal_volumes(const Model& model, int grain, double* volume) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  std::fill(volume, volume + (model.node_offset[g + 1] - model.node_offset[g]), 0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    ask_ahead<Real>(model, b);
    const TetBlock<Real>& block = model.block<Real>(b);
    const S quarter = S(1.0 / 24.0) * current_geometry(block, position).det;
    const int lanes = model.tets_in_block<Real>(grain, b);
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
  template <class Real>
  TetPack<Real> operator()(const TetBlock<Real>& block, const TetPack<Real>& volume_ratio) const {
    using S = TetPack<Real>;
    const S mean = mean_of_nodes(load_numbers<Real>(nodal, block.node[0]), load_numbers<Real>(nodal, block.node[1]),
                                 load_numbers<Real>(nodal, block.node[2]), load_numbers<Real>(nodal, block.node[3]));
    if (own == 0) return mean;
    return S(1 - own) * mean + S(own) * mean_stress(moduli, volume_ratio);
  }
};

/// Mean stresses of the nodes of a grain, into `mean` [nodes of the grain].
template <class Real>
AveragedPressure average_pressure(const Model& model, int grain, double* mean) {
  nodal_volumes<Real>(model, grain, mean);
  const ElasticModuli moduli = model.material_of(grain).moduli;
  const auto first = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain)]);
  const auto count = static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(grain) + 1]) - first;
  for (std::size_t n = 0; n < count; ++n)
    mean[n] = nodal_mean_stress(moduli, mean[n], model.inverse_nodal_volume[first + n]);
  return {mean, model.own_pressure, moduli};
}

/// Volume of patch `patch` of a grain, mm^3. Its tets are those of consecutive blocks, or a part of one block.
template <class Real>
double patch_volume(const Model& model, int grain, std::int32_t patch) {
  using S = TetPack<Real>;
  constexpr int W = TetBlock<Real>::lanes;
  static_assert(patch_tets % W == 0 || W % patch_tets == 0);
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
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

/// Mean stress of a tet as that of its patch, with a share of its own.
template <class Real>
struct PatchPressure {
  using S = TetPack<Real>;
  const Model& model;
  int grain;
  ElasticModuli moduli;
  S mean{0.0};
  /// Before the tets of block `b`.
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
    return patch_mean_stress(moduli, patch_volume<Real>(model, grain, patch),
                             model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]);
  }
};

/// f(pressure) with what gives the tets of a grain their mean stress, for its present positions. `nodal` [nodes of the grain] is
/// written where nodes take part, and kept as long as f needs it.
template <class Real, class F>
auto with_pressure(const Model& model, int grain, double* nodal, F&& f) {
  const ElasticModuli moduli = model.material_of(grain).moduli;
  switch (model.element) {
  case ElementType::tet4_anp:
    return f(average_pressure<Real>(model, grain, nodal));
  case ElementType::tet4_patch:
    return f(PatchPressure<Real>{model, grain, moduli});
  case ElementType::tet4:
    break;
  }
  return f(OwnPressure{moduli});
}

// flatten: everything below is inlined here. Called as functions, packs go through memory: 1.2 times the time.
template <class Real, class Law, class Pressure>
MPFEM_FLATTEN ElementSums element_pass(Model& model, int grain, double time_step, const Law& law, Pressure pressure) {
  using S = TetPack<Real>;
  constexpr int W = TetBlock<Real>::lanes;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const double* velocity = model.velocity.data() + 4 * first_node;
  double* force = model.force.data() + 4 * first_node;
  std::fill(force, force + 4 * (model.node_offset[g + 1] - first_node), 0.0);

  const Material& material = model.material_of(grain);
  const TetConstants constants{material.moduli, model.viscosity, material.wave_speed, material.density, time_step};
  LongSum<S> plastic_work, viscous_work;
  S largest_strain(0.0), smallest_ratio(1.0), check(0.0);

  const std::int32_t end = model.block_offset[g + 1];
  for (std::int32_t b = model.block_offset[g]; b < end; ++b) {
    TetBlock<Real>& block = model.block<Real>(b);
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
    if (const int lanes = model.tets_in_block<Real>(grain, b); lanes < W) { // nothing from unused lanes
      const S weight = lane_weights<Real>(0, lanes);
      for (auto& f : update.force) f = weight * f;
      update.volume *= weight;
    }
    add_balanced<W>(force, block.node, update.force);
    plastic_work.add(update.volume * update.plastic_work);
    viscous_work.add(update.volume * update.viscous_work);
    largest_strain = max(largest_strain, update.strain_increment_square);
    smallest_ratio = min(smallest_ratio, update.volume_ratio);
    check += update.mean; // becomes NaN or infinite where anything above is
  }
  const bool admissible =
      smallest(smallest_ratio) > 0 && std::isfinite(sum(check)) && std::isfinite(plastic_work.value());
  return {plastic_work.value(), viscous_work.value(), std::sqrt(largest(largest_strain)), admissible};
}

template <class Real>
double elastic_energy_in(const Model& model, int grain) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  const ElasticModuli moduli = model.material_of(grain).moduli;
  // The part of the volumetric energy that belongs to single tets; the rest belongs to nodes or patches.
  const double own = model.element == ElementType::tet4 ? 1.0 : model.own_pressure;
  LongSum<S> energy;
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock<Real>& block = model.block<Real>(b);
    const S ratio = current_volume_ratio(block, position);
    S density = ratio * distortion_energy(moduli, load_deviator(block));
    if (own > 0) density += S(own) * volumetric_energy(moduli, ratio);
    energy.add(lane_weights<Real>(0, model.tets_in_block<Real>(grain, b)) / S::load(block.inverse_volume) * density);
  }
  double total = energy.value();
  if (model.element == ElementType::tet4_anp) {
    const auto first = static_cast<std::size_t>(model.node_offset[g]);
    std::vector<double> volume(static_cast<std::size_t>(model.node_offset[g + 1]) - first);
    nodal_volumes<Real>(model, grain, volume.data());
    for (std::size_t n = 0; n < volume.size(); ++n)
      total += (1 - own) * nodal_volumetric_energy(moduli, volume[n], model.inverse_nodal_volume[first + n]);
  }
  if (model.element == ElementType::tet4_patch)
    for (std::int32_t patch = 0; patch < model.patch_offset[g + 1] - model.patch_offset[g]; ++patch)
      total += (1 - own) * patch_volumetric_energy(
                               moduli, patch_volume<Real>(model, grain, patch),
                               model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]);
  return total;
}

template <class Real>
double current_volume_in(const Model& model, int grain) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  LongSum<S> volume;
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock<Real>& block = model.block<Real>(b);
    volume.add(lane_weights<Real>(0, model.tets_in_block<Real>(grain, b)) * current_geometry(block, position).det);
  }
  return volume.value() / 6.0;
}

template <class Real>
BadTet find_bad_tet_in(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const auto ratio = current_volume_ratio(model.block<Real>(b), position);
    for (int lane = 0; lane < model.tets_in_block<Real>(grain, b); ++lane) {
      const std::int32_t tet = model.tet_offset[g] + (b - model.block_offset[g]) * TetBlock<Real>::lanes + lane;
      if (!(ratio[lane] > 0) || !std::isfinite(ratio[lane]))
        return {model.file_tet[static_cast<std::size_t>(tet)], ratio[lane]};
    }
  }
  return {};
}

template <class Real>
MPFEM_FLATTEN StableStep stable_step_in(Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                        double strain_rate) {
  using S = TetPack<Real>;
  constexpr int W = TetBlock<Real>::lanes;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const Material& material = model.material_of(grain);
  const double damping_of_volume = material.moduli.dilatational() / material.moduli.bulk;
  S smallest_step(std::numeric_limits<double>::infinity()), smallest_no_contact = smallest_step;
  S growth(1.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    TetBlock<Real>& block = model.block<Real>(b);
    const auto geometry = current_geometry(block, position);
    const S ratio = volume_ratio(block, geometry);
    S element = largest_frequency_squared(material.moduli, S(material.density) / ratio, geometry);
    S length = S(2.0 * material.wave_speed) / sqrt(element);
    if (!model.mass_factor.empty()) {
      // By the same inequality: an element's share of its nodes' mass grew at least as the least scaled of them.
      S factor(std::numeric_limits<double>::infinity());
      for (int i = 0; i < W; ++i)
        for (const auto& node : block.node)
          factor.v[i] = std::min(factor.v[i],
                                 static_cast<Real>(model.mass_factor[static_cast<std::size_t>(first_node + node[i])]));
      element = element / factor;
      // Viscosity is the true mass's, so that scaled nodes are damped less; but less where the mass is less.
      length = length * sqrt(min(factor, S(1.0)));
    }
    const S relative = S::load(block.length) / length; // of the frequencies, now to then
    growth = max(growth, relative * relative);
    length.store(block.length);
    S contact(0.0);
    if (!nodal_stiffness_rate.empty()) {
      for (int i = 0; i < W; ++i)
        for (const auto& node : block.node)
          contact.v[i] = std::max(
              contact.v[i], static_cast<Real>(nodal_stiffness_rate[static_cast<std::size_t>(first_node + node[i])]));
    }
    const S quadratic =
        S(model.viscosity.quadratic * model.viscosity.quadratic * strain_rate / material.wave_speed) * length;
    const S damped = S(2.0) * damped_step_factor(S(damping_of_volume) * (S(model.viscosity.linear) + quadratic));
    smallest_step = min(smallest_step, damped / sqrt(element + contact));
    smallest_no_contact = min(smallest_no_contact, damped / sqrt(element));
  }
  return {smallest(smallest_step), smallest(smallest_no_contact), largest(growth)};
}

template <class Real>
TetFields tet_fields_in(const Model& model) {
  const auto tets = static_cast<std::size_t>(model.tets());
  TetFields fields{std::vector<float>(tets), std::vector<float>(tets), std::vector<float>(tets)};
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    const double* position = model.position.data() + 4 * model.node_offset[g];
    std::vector<double> nodal(static_cast<std::size_t>(model.node_offset[g + 1] - model.node_offset[g]));
    with_pressure<Real>(model, grain, nodal.data(), [&](auto pressure) {
      for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
        const TetBlock<Real>& block = model.block<Real>(b);
        pressure.enter(b);
        const auto q = von_mises(load_deviator(block));
        const auto mean = pressure(block, current_volume_ratio(block, position));
        for (int lane = 0; lane < model.tets_in_block<Real>(grain, b); ++lane) {
          const auto tet = static_cast<std::size_t>(model.tet_offset[g] +
                                                    (b - model.block_offset[g]) * TetBlock<Real>::lanes + lane);
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

} // namespace

ElementSums element_forces(Model& model, int grain, double time_step) {
  return with_tet_numbers(model, [&](auto number) {
    using Real = decltype(number);
    return std::visit(
        [&](const auto& law) {
          double* nodal = model.nodal_mean.empty()
                              ? nullptr
                              : model.nodal_mean.data() + model.node_offset[static_cast<std::size_t>(grain)];
          return with_pressure<Real>(model, grain, nodal, [&](const auto& pressure) {
            return element_pass<Real>(model, grain, time_step, law, pressure);
          });
        },
        model.material_of(grain).flow);
  });
}

double elastic_energy(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return elastic_energy_in<decltype(number)>(model, grain); });
}

double current_volume(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return current_volume_in<decltype(number)>(model, grain); });
}

BadTet find_bad_tet(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return find_bad_tet_in<decltype(number)>(model, grain); });
}

StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate, double strain_rate) {
  return with_tet_numbers(model, [&](auto number) {
    return stable_step_in<decltype(number)>(model, grain, nodal_stiffness_rate, strain_rate);
  });
}

TetFields tet_fields(const Model& model) {
  return with_tet_numbers(model, [&](auto number) { return tet_fields_in<decltype(number)>(model); });
}

} // namespace mpfem
