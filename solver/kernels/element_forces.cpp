#include "solver/kernels/element_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/kernels/rows.hpp"
#include "solver/physics/kinematics.hpp"
#include "solver/physics/plasticity.hpp"

namespace mpfem {

namespace {

constexpr int W = TetBlock::lanes;
using S = Pack<W>;

Deviator<S> load_deviator(const TetBlock& block) {
  return {S::load(block.deviator[0]), S::load(block.deviator[1]), S::load(block.deviator[2]),
          S::load(block.deviator[3]), S::load(block.deviator[4])};
}

void store_deviator(TetBlock& block, const Deviator<S>& s) {
  s.xx.store(block.deviator[0]), s.yy.store(block.deviator[1]), s.xy.store(block.deviator[2]);
  s.yz.store(block.deviator[3]), s.zx.store(block.deviator[4]);
}

TetGeometry<S> current_geometry(const TetBlock& block, const double* position) {
  const auto x0 = load_rows<W>(position, block.node[0]);
  return tet_geometry(load_rows<W>(position, block.node[1]) - x0, load_rows<W>(position, block.node[2]) - x0,
                      load_rows<W>(position, block.node[3]) - x0);
}

S current_volume_ratio(const TetBlock& block, const double* position) {
  return current_geometry(block, position).det / (S(6.0) * S::load(block.reference_volume));
}

S lane_weights(int lanes) {
  S weight(0.0);
  for (int i = 0; i < lanes; ++i) weight.v[i] = 1.0;
  return weight;
}

template <class Law>
ElementSums element_pass(Model& model, int grain, double time_step, const Law& law) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const double* velocity = model.velocity.data() + 4 * first_node;
  double* force = model.force.data() + 4 * first_node;
  std::fill(force, force + 4 * (model.node_offset[g + 1] - first_node), 0.0);

  const Material& material = model.material;
  const ElasticModuli moduli = material.moduli;
  const BulkViscosity viscosity = model.viscosity;
  const double wave_speed = material.wave_speed, density = material.density;
  const S step(time_step), rate_factor(1.0 / time_step), sixth(1.0 / 6.0), half(0.5);
  S plastic_work(0.0), viscous_work(0.0), largest_strain(0.0), smallest_ratio(1.0), check(0.0);

  const std::int32_t end = model.block_offset[g + 1];
  for (std::int32_t b = model.block_offset[g]; b < end; ++b) {
    TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const int lanes = model.tets_in_block(grain, b);

    // 1. Edges at the end of the step and displacement increments relative to node 0.
    const auto x0 = load_rows<W>(position, block.node[0]), v0 = load_rows<W>(velocity, block.node[0]);
    Vector3<S> edge[3], du[3], middle_edge[3];
    for (int i = 0; i < 3; ++i) {
      edge[i] = load_rows<W>(position, block.node[i + 1]) - x0;
      du[i] = step * (load_rows<W>(velocity, block.node[i + 1]) - v0);
      middle_edge[i] = edge[i] - half * du[i];
    }

    // 2. Strain increment and rotation at the half step; deviator.
    const auto increment = displacement_increment(tet_geometry(middle_edge[0], middle_edge[1], middle_edge[2]), du);
    const S reference_volume = S::load(block.reference_volume);
    const HardeningState<S> old{S::load(block.flow_stress), S::load(block.plastic_strain)};
    const auto returned = update_deviator(law, moduli, load_deviator(block), old, increment);
    store_deviator(block, returned.deviator);
    if constexpr (Law::yields) {
      returned.hardening.flow_stress.store(block.flow_stress);
      returned.hardening.plastic_strain.store(block.plastic_strain);
    }

    // 3. Pressure from the volume at the end, bulk viscosity from the rate.
    const auto geometry = tet_geometry(edge[0], edge[1], edge[2]);
    const S volume = sixth * geometry.det;
    const S ratio = volume / reference_volume;
    const S volumetric_strain = increment.strain.xx + increment.strain.yy + increment.strain.zz;
    const S viscous = viscous_pressure(viscosity, wave_speed, S(density) / ratio, S::load(block.length),
                                       volumetric_strain * rate_factor);
    const S mean = mean_stress(moduli, ratio) - viscous;

    // 4. Forces f_i = -V sigma grad N_i = -sigma a_i / 6.
    Vector3<S> f[4];
    for (int i = 0; i < 3; ++i) f[i + 1] = -(sixth * traction(returned.deviator, mean, geometry.area[i]));
    f[0] = -(f[1] + f[2] + f[3]);
    for (int i = 0; i < 4; ++i) add_rows<W>(force, block.node[i], lanes, f[i]);

    // 5. Sums.
    const S weighted_volume = lanes == W ? volume : volume * lane_weights(lanes);
    plastic_work += weighted_volume * returned.plastic_work;
    viscous_work -= weighted_volume * viscous * volumetric_strain;
    const auto& e = increment.strain;
    largest_strain = max(largest_strain,
                         e.xx * e.xx + e.yy * e.yy + e.zz * e.zz + S(2.0) * (e.xy * e.xy + e.yz * e.yz + e.zx * e.zx));
    smallest_ratio = min(smallest_ratio, ratio);
    check += mean; // becomes NaN or infinite where anything above is
  }
  const bool admissible = smallest(smallest_ratio) > 0 && std::isfinite(sum(check)) && std::isfinite(sum(plastic_work));
  return {sum(plastic_work), sum(viscous_work), std::sqrt(largest(largest_strain)), admissible};
}

} // namespace

ElementSums element_forces(Model& model, int grain, double time_step) {
  return std::visit([&](const auto& law) { return element_pass(model, grain, time_step, law); }, model.material.flow);
}

double elastic_energy(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + 4 * model.node_offset[g];
  S energy(0.0);
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    const TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const S ratio = current_volume_ratio(block, position);
    energy += lane_weights(model.tets_in_block(grain, b)) * S::load(block.reference_volume) *
              (volumetric_energy(model.material.moduli, ratio) +
               ratio * distortion_energy(model.material.moduli, load_deviator(block)));
  }
  return sum(energy);
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

StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate, double strain_rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + 4 * first_node;
  const Material& material = model.material;
  S smallest_step(std::numeric_limits<double>::infinity()), smallest_no_contact = smallest_step;
  for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
    TetBlock& block = model.block[static_cast<std::size_t>(b)];
    const auto geometry = current_geometry(block, position);
    const S ratio = geometry.det / (S(6.0) * S::load(block.reference_volume));
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
    for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
      const TetBlock& block = model.block[static_cast<std::size_t>(b)];
      const S q = von_mises(load_deviator(block));
      const S mean = mean_stress(model.material.moduli, current_volume_ratio(block, position));
      for (int lane = 0; lane < model.tets_in_block(grain, b); ++lane) {
        const auto tet = static_cast<std::size_t>(model.tet_offset[g] + (b - model.block_offset[g]) * W + lane);
        const auto file = static_cast<std::size_t>(model.file_tet[tet]);
        fields.von_mises[file] = static_cast<float>(q[lane]);
        fields.pressure[file] = static_cast<float>(-mean[lane]);
        fields.plastic_strain[file] = static_cast<float>(block.plastic_strain[lane]);
      }
    }
  }
  return fields;
}

} // namespace mpfem
