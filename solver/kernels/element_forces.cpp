#include "solver/kernels/element_forces.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "solver/kernels/tet_pressure.hpp"
#include "solver/model/row_pairs.hpp"

namespace mpfem {

namespace {

/// Positions of a grain's nodes, and their displacements in the step, in pairs (mm); valid until the next call of this
/// thread.
template <class Real>
const Real* moving_nodes(const Model& model, int grain, double time_step) {
  thread_local RowPairs<Real> pairs;
  const std::size_t first = model.first_row(grain);
  return pairs.place(model.position.data() + first, model.velocity.data() + first, time_step,
                     model.end_node(grain) - model.first_node(grain));
}

/// mm, rows of a grain's nodes.
const double* positions_of(const Model& model, int grain) {
  return model.position.data() + model.first_row(grain);
}

// flatten: everything below is inlined here. In calls, packs go through memory, which takes 1.2 times as long.
template <class Real, class Law, class Pressure>
MPFEM_FLATTEN ElementSums element_pass(Model& model, int grain, double time_step, const Real* moving, const Law& law,
                                       Pressure pressure) {
  using S = TetPack<Real>;
  constexpr int W = TetBlock<Real>::lanes;
  const auto g = static_cast<std::size_t>(grain);
  double* force = model.force.data() + model.first_row(grain);
  std::fill(force, model.force.data() + model.end_row(grain), 0.0);

  const Material& material = model.material_of(grain);
  const TetConstants constants{material.moduli, model.viscosity, material.wave_speed, material.density, time_step};
  LongSum<S> plastic_work, viscous_work, hypoelastic_work;
  S largest_strain(0.0), smallest_ratio(1.0), check(0.0);

  const std::int32_t end = model.block_offset[g + 1];
  for (std::int32_t b = model.block_offset[g]; b < end; ++b) {
    TetBlock<Real>& block = model.block<Real>(b);
    pressure.enter(b);
    Vector3<S> edge[3], displacement[3];
    load_edge_pairs<W, 3>(moving, block.node, edge, displacement);
    auto update = update_tet(law, constants, edge, displacement, load_state(block), S::load(block.inverse_volume),
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
    hypoelastic_work.add(update.volume * update.hypoelastic_work);
    largest_strain = max(largest_strain, update.strain_increment_square);
    smallest_ratio = min(smallest_ratio, update.volume_ratio);
    check += update.mean; // becomes NaN or infinite where anything above is
  }
  const bool admissible =
      smallest(smallest_ratio) > 0 && std::isfinite(sum(check)) && std::isfinite(plastic_work.value());
  return {plastic_work.value(), viscous_work.value(), hypoelastic_work.value(), std::sqrt(largest(largest_strain)),
          admissible};
}

} // namespace

ElementSums element_forces(Model& model, int grain, double time_step) {
  return with_tet_numbers(model, [&](auto number) {
    using Real = decltype(number);
    const Real* moving = moving_nodes<Real>(model, grain, time_step);
    return std::visit(
        [&](const auto& law) {
          double* nodal = model.nodal_mean.empty() ? nullptr : model.nodal_mean.data() + model.first_node(grain);
          const auto pass = [&](const auto& pressure) {
            return element_pass<Real>(model, grain, time_step, moving, law, pressure);
          };
          if constexpr (std::is_same_v<Real, float>) {
            return with_pressure<Real>(model, grain, moving, nodal, pass);
          } else {
            return with_pressure<Real>(model, grain, positions_of(model, grain), nodal, pass);
          }
        },
        model.material_of(grain).flow);
  });
}

} // namespace mpfem
