#include "solver/kernels/grain_state.hpp"

#include <cmath>

#include "solver/kernels/tet_pressure.hpp"

namespace mpfem {

namespace {

template <class Real>
double elastic_energy_in(const Model& model, int grain) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + model.first_row(grain);
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
    const std::size_t first = model.first_node(grain);
    std::vector<double> volume(model.end_node(grain) - first);
    nodal_volumes<Real>(model, grain, position, volume.data());
    for (std::size_t n = 0; n < volume.size(); ++n)
      total += (1 - own) * nodal_volumetric_energy(moduli, volume[n], model.inverse_nodal_volume[first + n]);
  }
  if (model.element == ElementType::tet4_patch)
    for (std::int32_t patch = 0; patch < model.patch_offset[g + 1] - model.patch_offset[g]; ++patch)
      total += (1 - own) * patch_volumetric_energy(
                               moduli, patch_volume<Real>(model, grain, position, patch),
                               model.inverse_patch_volume[static_cast<std::size_t>(model.patch_offset[g] + patch)]);
  return total;
}

template <class Real>
double current_volume_in(const Model& model, int grain) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const double* position = model.position.data() + model.first_row(grain);
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
  const double* position = model.position.data() + model.first_row(grain);
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
TetFields tet_fields_in(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.tet_offset[g];
  const auto tets = static_cast<std::size_t>(model.tet_offset[g + 1] - first);
  TetFields fields{std::vector<float>(tets), std::vector<float>(tets), std::vector<float>(tets)};
  const double* position = model.position.data() + model.first_row(grain);
  std::vector<double> nodal(model.end_node(grain) - model.first_node(grain));
  with_pressure<Real>(model, grain, position, nodal.data(), [&](auto pressure) {
    for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b) {
      const TetBlock<Real>& block = model.block<Real>(b);
      pressure.enter(b);
      const auto q = von_mises(load_deviator(block));
      const auto mean = pressure(block, current_volume_ratio(block, position));
      for (int lane = 0; lane < model.tets_in_block<Real>(grain, b); ++lane) {
        const auto tet = static_cast<std::size_t>(first + (b - model.block_offset[g]) * TetBlock<Real>::lanes + lane);
        const auto place = static_cast<std::size_t>(model.file_tet[tet] - first);
        fields.von_mises[place] = static_cast<float>(q[lane]);
        fields.pressure[place] = static_cast<float>(-mean[lane]);
        fields.plastic_strain[place] = static_cast<float>(block.plastic_strain[lane]);
      }
    }
  });
  return fields;
}

} // namespace

double elastic_energy(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return elastic_energy_in<decltype(number)>(model, grain); });
}

double current_volume(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return current_volume_in<decltype(number)>(model, grain); });
}

BadTet find_bad_tet(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return find_bad_tet_in<decltype(number)>(model, grain); });
}

TetFields tet_fields(const Model& model, int grain) {
  return with_tet_numbers(model, [&](auto number) { return tet_fields_in<decltype(number)>(model, grain); });
}

} // namespace mpfem
