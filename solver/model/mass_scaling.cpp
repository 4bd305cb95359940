#include <algorithm>
#include <cmath>

#include "solver/model/model.hpp"
#include "solver/parallel/grain_values.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem {

namespace {

/// 1/s^2, the frequency squared that a step (s) of central differences allows with the grain's linear bulk viscosity.
double allowed_frequency_squared(const Model& model, const Material& material, double step) {
  const double damping = model.viscosity.linear * material.moduli.dilatational() / material.moduli.bulk;
  return std::pow(2.0 * damped_step_factor(damping) / step, 2);
}

/// Bonds that may be stiffer than the penalty of contact.
struct BondLaws {
  std::vector<BondLaw> of_grains, of_tools;

  explicit BondLaws(const Scenario& scenario) {
    if (scenario.bond) of_grains.push_back(law_of_bonds(*scenario.bond, scenario.contact));
    for (const ToolParameters& tool : scenario.tools)
      if (tool.adhesion) of_tools.push_back(law_of_bonds(*tool.adhesion, scenario.contact));
  }
  /// Stiffness to which they raise contact with this penalty (MPa/mm) between grains, over that penalty. A rigid tool
  /// adds half of what a grain does.
  double raised(double penalty) const {
    double largest = raised_by_bonds(of_grains, penalty);
    for (const BondLaw& law : of_tools)
      largest = std::max(largest, 0.5 * law_at_point(law, penalty).stiffness / penalty);
    return largest;
  }
};

/// 1/s^2, what contact usually adds to the frequency squared of a node; nothing inside the grain.
double usual_contact_rate(const Model& model, const BondLaws& bonds, std::size_t grain, std::int32_t node) {
  if (node >= model.node_offset[grain] + model.surface_node_count[grain]) return 0;
  const auto n = static_cast<std::size_t>(node);
  const double penalty = model.penalty_stiffness[grain] * model.local_stiffness(n);
  return expected_contact_rate(bonds.raised(penalty) * penalty * model.reference_area[n], model.inverse_mass[n]);
}

/// Sets mass_factor of a grain's nodes to the largest factor that one of their tets requires, at least `least`.
void set_mass_factors(Model& model, const BondLaws& bonds, int grain, double step, double least) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  std::fill(model.mass_factor.data() + first, model.mass_factor.data() + model.node_offset[g + 1], least);
  const Material& material = model.material_of(grain);
  const double allowed = allowed_frequency_squared(model, material, step);
  for (std::int32_t tet = 0; tet < model.tet_offset[g + 1] - model.tet_offset[g]; ++tet) {
    std::array<std::int32_t, 4> corner = model.nodes_of_tet(grain, tet);
    double contact = 0;
    for (std::int32_t& node : corner) {
      node += first;
      contact = std::max(contact, usual_contact_rate(model, bonds, g, node));
    }
    const auto x = [&](std::size_t c) { return model.point(static_cast<std::size_t>(corner[c])); };
    const auto geometry = tet_geometry(x(1) - x(0), x(2) - x(0), x(3) - x(0));
    const double factor = (largest_frequency_squared(material.moduli, material.density, geometry) + contact) / allowed;
    for (const std::int32_t node : corner) {
      double& largest = model.mass_factor[static_cast<std::size_t>(node)];
      largest = std::max(largest, factor);
    }
  }
}

/// Multiplies the masses of a grain's nodes by their factors.
void apply_mass_factors(Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  double mass = 0;
  for (std::int32_t node = model.node_offset[g]; node < model.node_offset[g + 1]; ++node) {
    const auto n = static_cast<std::size_t>(node);
    mass += model.mass_factor[n] / model.inverse_mass[n];
    model.inverse_mass[n] /= model.mass_factor[n];
  }
  model.mass[g] = mass;
}

/// Sets added_mass and largest_added_mass. `own_mass` [grains], tonne, before scaling.
void set_added_mass(Model& model, const std::vector<double>& own_mass) {
  model.largest_added_mass = -1;
  double added = 0, total = 0;
  for (std::size_t g = 0; g < own_mass.size(); ++g) {
    added += model.mass[g] - own_mass[g];
    total += own_mass[g];
    model.largest_added_mass = std::max(model.largest_added_mass, model.mass[g] / own_mass[g] - 1.0);
  }
  model.added_mass = added / total;
}

} // namespace

void scale_masses(Model& model, const Scenario& scenario, const Communicator& ranks) {
  const double step = scenario.numerics.mass_scaling_step / scenario.numerics.time_step_factor;
  const BondLaws bonds(scenario);
  const std::vector<double> own_mass = model.mass;
  model.mass_factor = LazyArray<double>(static_cast<std::size_t>(model.nodes()), model.pages());
  for (const std::int32_t grain : model.own()) {
    set_mass_factors(model, bonds, grain, step, scenario.numerics.mass_scaling_lighten ? 0.0 : 1.0);
    apply_mass_factors(model, grain);
  }
  share_of_grains(ranks, model.ownership, std::span(model.mass));
  set_added_mass(model, own_mass);
}

} // namespace mpfem
