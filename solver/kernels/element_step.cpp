#include "solver/kernels/element_step.hpp"

#include <algorithm>
#include <limits>

#include "solver/kernels/tet_packs.hpp"
#include "solver/physics/stable_step.hpp"

namespace mpfem {

namespace {

/// For each tet of a block, the values of its nodes combined by `pick`, beginning with `start`. `values` [nodes of the
/// model].
template <class Real, class Values, class Pick>
TetPack<Real> pick_of_nodes(const TetBlock<Real>& block, std::int32_t first_node, const Values& values, double start,
                            Pick pick) {
  TetPack<Real> result(start);
  for (int i = 0; i < TetBlock<Real>::lanes; ++i)
    for (const auto& node : block.node)
      result.v[i] = pick(result.v[i], static_cast<Real>(values[static_cast<std::size_t>(first_node + node[i])]));
  return result;
}

template <class Real>
MPFEM_FLATTEN StableStep stable_step_in(Model& model, int grain, std::span<const double> nodal_stiffness_rate,
                                        double strain_rate) {
  using S = TetPack<Real>;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_node = model.node_offset[g];
  const double* position = model.position.data() + model.first_row(grain);
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
      // By the same inequality, as an element's share of its nodes' mass has grown at least as much as the mass of the
      // least scaled node.
      const S factor = pick_of_nodes(block, first_node, model.mass_factor, std::numeric_limits<double>::infinity(),
                                     [](Real x, Real y) { return std::min(x, y); });
      element = element / factor;
      // Viscosity belongs to the true mass: it damps heavier nodes less, and it is reduced where nodes are lighter.
      length = length * sqrt(min(factor, S(1.0)));
    }
    const S relative = S::load(block.length) / length; // ratio of the frequencies, now to then
    growth = max(growth, relative * relative);
    length.store(block.length);
    S contact(0.0);
    if (!nodal_stiffness_rate.empty())
      contact =
          pick_of_nodes(block, first_node, nodal_stiffness_rate, 0.0, [](Real x, Real y) { return std::max(x, y); });
    const S quadratic =
        S(model.viscosity.quadratic * model.viscosity.quadratic * strain_rate / material.wave_speed) * length;
    const S damped = S(2.0) * damped_step_factor(S(damping_of_volume) * (S(model.viscosity.linear) + quadratic));
    smallest_step = min(smallest_step, damped / sqrt(element + contact));
    smallest_no_contact = min(smallest_no_contact, damped / sqrt(element));
  }
  return {smallest(smallest_step), smallest(smallest_no_contact), largest(growth)};
}

} // namespace

StableStep stable_step(Model& model, int grain, std::span<const double> nodal_stiffness_rate, double strain_rate) {
  return with_tet_numbers(model, [&](auto number) {
    return stable_step_in<decltype(number)>(model, grain, nodal_stiffness_rate, strain_rate);
  });
}

} // namespace mpfem
