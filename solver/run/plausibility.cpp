#include "solver/run/plausibility.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/range.hpp"

namespace mpfem {

namespace {

// From gels and aerogels to diamond and osmium, with a margin.
constexpr Range modulus_of_solids = Range::between(1e-3, 1e6);   // MPa
constexpr Range density_of_solids = Range::between(1e-10, 3e-8); // tonne/mm^3

struct OtherUnit {
  const char* name;
  double in_own; ///< one of it, in the unit of scenarios
};
constexpr OtherUnit units_of_density[] = {{"g/cm^3", 1e-9}, {"kg/m^3", 1e-12}, {"kg/mm^3", 1e-3}};
constexpr OtherUnit units_of_modulus[] = {{"Pa", 1e-6}};

struct Quantity {
  const char* key;
  const char* unit;
  const Range& of_solids;
};

/// Empty if the value may be that of a solid.
template <std::size_t Count>
std::string remark(const std::string& table, const Quantity& quantity, double value, const OtherUnit (&others)[Count]) {
  if (quantity.of_solids.contains(value)) return {};
  std::string text = fmt::format("{}.{} = {:g} {} is far from any solid", table, quantity.key, value, quantity.unit);
  for (const OtherUnit& other : others)
    if (quantity.of_solids.contains(value * other.in_own))
      return text + fmt::format("; {:g} {} is {:g} {}", value, other.name, value * other.in_own, quantity.unit);
  return text;
}

} // namespace

std::vector<std::string> implausible_values(const Scenario& scenario) {
  std::vector<std::string> remarks;
  const auto look_at = [&](const std::string& table, const MaterialParameters& material) {
    for (const std::string& text :
         {remark(table, {"density", "tonne/mm^3", density_of_solids}, material.density, units_of_density),
          remark(table, {"youngs_modulus", "MPa", modulus_of_solids}, material.youngs_modulus, units_of_modulus)})
      if (!text.empty()) remarks.push_back(text);
    if (const double yield = material.hardening.yield_stress; yield > material.youngs_modulus)
      remarks.push_back(fmt::format("{}.hardening.yield_stress = {:g} MPa is above the Young's modulus, {:g} MPa",
                                    table, yield, material.youngs_modulus));
  };
  look_at("material", scenario.material);
  for (std::size_t i = 0; i < scenario.grain_materials.size(); ++i)
    look_at(fmt::format("grain_material.{}", i), scenario.grain_materials[i].material);
  return remarks;
}

std::string implausible_values_hint(const Scenario& scenario) {
  const std::vector<std::string> remarks = implausible_values(scenario);
  return remarks.empty() ? "" : fmt::format("; {}", fmt::join(remarks, "; "));
}

} // namespace mpfem
