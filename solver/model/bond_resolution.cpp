#include "solver/model/bond_resolution.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

BondResolution bond_resolution(const Model& model, const BondParameters& bond, const ContactParameters& contact,
                               BondPartner partner, const Communicator& ranks) {
  // The softest grains: cohesive zones are shortest there.
  const auto softest = std::min_element(model.material.begin(), model.material.end(), [](const auto& a, const auto& b) {
    return a.moduli.youngs() < b.moduli.youngs();
  });
  const double youngs = softest->moduli.youngs(), poissons = youngs / (2 * softest->moduli.shear) - 1;
  const double reduced = youngs / ((partner == BondPartner::grain ? 2 : 1) * (1 - poissons * poissons));
  // Two grains' penalties act as their harmonic mean, at least the softest's; a tool's is that of the grain.
  BondLaw law = law_of_bonds(bond, contact);
  double stiffness = std::numeric_limits<double>::infinity(), finest = model.refinement.empty() ? 1.0 : 0.0;
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    const std::size_t first = model.first_node(grain);
    for (std::size_t n = first; n < first + static_cast<std::size_t>(model.surface_node_count[g]); ++n) {
      stiffness =
          std::min(stiffness, law_at_point(law, model.penalty_stiffness[g] * model.local_stiffness(n)).stiffness);
      if (!model.refinement.empty()) finest = std::max(finest, model.refinement[n]);
    }
  }
  law.stiffness = -ranks.largest(-stiffness);
  finest = ranks.largest(finest);
  BondResolution result;
  // Where grains are locally refined, bonds are taken to be where the elements are smallest.
  result.element_size = *std::max_element(model.element_size.begin(), model.element_size.end()) / finest;
  result.cohesive_zone = 0.34 * 2 * reduced * bond.fracture_energy / (bond.tensile_strength * bond.tensile_strength);
  result.smallest_fracture_energy = smallest_fracture_energy(law);
  const double strength = governing_strength(law);
  result.steep_fracture_energy = strength * strength * result.element_size / youngs + energy_before_damage(law);
  return result;
}

namespace {

/// MPa/mm, of the contact points of all grains.
double smallest_penalty(const Model& model, const Communicator& ranks) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    for (auto n = model.node_offset[g]; n < model.node_offset[g] + model.surface_node_count[g]; ++n)
      smallest = std::min(smallest, model.penalty_stiffness[g] * model.local_stiffness(static_cast<std::size_t>(n)));
  }
  return -ranks.largest(-smallest);
}

/// Bonds of one kind in a scenario.
struct BondsOfOneKind {
  const BondParameters& bond;
  const KeyPlaces& places;
  BondPartner partner;
  std::string table;   ///< for refusals
  std::string subject; ///< for warnings
  bool has_friction;   ///< points with damaged bonds have friction

  [[noreturn]] void refuse(const char* key, const std::string& what) const {
    throw InputError(fmt::format("{}{} key '{}': {}", places.prefix(key), table, key, what));
  }
};

void check(const Model& model, const ContactParameters& contact, const BondsOfOneKind& bonds, const Communicator& ranks,
           std::vector<std::string>& warnings) {
  if (const auto stiffness = bonds.bond.stiffness; stiffness && bonds.has_friction)
    if (const double allowed = smallest_penalty(model, ranks); *stiffness > allowed)
      bonds.refuse(
          "stiffness",
          fmt::format(
              "found {:g} MPa/mm, allowed: with friction up to {:.3g} MPa/mm, the smallest penalty of a contact point",
              *stiffness, allowed));
  const BondResolution r = bond_resolution(model, bonds.bond, contact, bonds.partner, ranks);
  const double energy = bonds.bond.fracture_energy;
  if (!(energy > r.smallest_fracture_energy))
    bonds.refuse(
        "fracture_energy",
        fmt::format("found {:g} N/mm, allowed: > {:.3g} N/mm, which is 1.01 strength^2/(2 K) with the stiffness K of "
                    "these bonds; raise the fracture energy or the stiffness, or lower the strength",
                    energy, r.smallest_fracture_energy));
  if (energy < r.steep_fracture_energy)
    warnings.push_back(
        fmt::format("{} soften more steeply than elements of {:.3g} mm can unload: fracture_energy "
                    "{:g} N/mm is below strength^2 h/E = {:.3g} N/mm; breaking bonds will make the grains vibrate",
                    bonds.subject, r.element_size, energy, r.steep_fracture_energy));
  if (r.cohesive_zone < 3 * r.element_size)
    warnings.push_back(fmt::format("the cohesive zone of {} ({:.3g} mm) has fewer than three elements of {:.3g} mm: "
                                   "the strength of a contact depends on the mesh",
                                   bonds.subject, r.cohesive_zone, r.element_size));
}

} // namespace

std::vector<std::string> check_bonds(const Model& model, const Scenario& scenario, const Communicator& ranks) {
  std::vector<std::string> warnings;
  if (scenario.bond)
    check(
        model, scenario.contact,
        {*scenario.bond, scenario.bond_places, BondPartner::grain, "[bond]", "bonds", scenario.contact.has_friction()},
        ranks, warnings);
  for (const ToolParameters& tool : scenario.tools)
    if (tool.adhesion)
      check(model, scenario.contact,
            {*tool.adhesion, tool.adhesion_places, BondPartner::tool, fmt::format("tool '{}': adhesion", tool.name),
             fmt::format("bonds to tool '{}'", tool.name), tool.friction > 0},
            ranks, warnings);
  return warnings;
}

} // namespace mpfem
