#include <algorithm>
#include <cmath>

#include "solver/model/model.hpp"
#include "solver/parallel/grain_values.hpp"

namespace mpfem {

void scale_masses(Model& model, double step, bool lighten, const Communicator& ranks) {
  const std::vector<double> own_mass = model.mass;
  model.mass_factor = LazyArray<double>(static_cast<std::size_t>(model.nodes()), model.pages());
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    std::fill(model.mass_factor.data() + model.node_offset[g], model.mass_factor.data() + model.node_offset[g + 1],
              lighten ? 0.0 : 1.0);
    const std::int32_t first = model.node_offset[g], surface_end = first + model.surface_node_count[g];
    const Material& material = model.material_of(grain);
    const double damping = model.viscosity.linear * material.moduli.dilatational() / material.moduli.bulk;
    const double largest_rate = std::pow(2.0 * damped_step_factor(damping) / step, 2);
    // What contact usually adds to the frequency squared, as in raise_to_expected_rate.
    const auto contact_rate = [&](std::int32_t node) {
      const auto n = static_cast<std::size_t>(node);
      return node < surface_end ? 2.0 * model.penalty_stiffness[g] * model.local_stiffness(n) *
                                      model.reference_area[n] * model.inverse_mass[n]
                                : 0.0;
    };
    for (std::int32_t tet = 0; tet < model.tet_offset[g + 1] - model.tet_offset[g]; ++tet) {
      std::array<std::int32_t, 4> corner = model.nodes_of_tet(grain, tet);
      double contact = 0;
      for (std::int32_t& node : corner) {
        node += first;
        contact = std::max(contact, contact_rate(node));
      }
      const auto x = [&](std::size_t c) { return model.point(static_cast<std::size_t>(corner[c])); };
      const auto geometry = tet_geometry(x(1) - x(0), x(2) - x(0), x(3) - x(0));
      const double factor =
          (largest_frequency_squared(material.moduli, material.density, geometry) + contact) / largest_rate;
      for (const std::int32_t node : corner) {
        double& largest = model.mass_factor[static_cast<std::size_t>(node)];
        largest = std::max(largest, factor);
      }
    }
    double mass = 0;
    for (std::int32_t node = first; node < model.node_offset[g + 1]; ++node) {
      const auto n = static_cast<std::size_t>(node);
      mass += model.mass_factor[n] / model.inverse_mass[n];
      model.inverse_mass[n] /= model.mass_factor[n];
    }
    model.mass[g] = mass;
  }
  share_of_grains(ranks, model.ownership, std::span(model.mass));
  model.largest_added_mass = -1;
  double added = 0, total = 0;
  for (std::size_t g = 0; g < own_mass.size(); ++g) {
    added += model.mass[g] - own_mass[g];
    total += own_mass[g];
    model.largest_added_mass = std::max(model.largest_added_mass, model.mass[g] / own_mass[g] - 1.0);
  }
  model.added_mass = added / total;
}

} // namespace mpfem
