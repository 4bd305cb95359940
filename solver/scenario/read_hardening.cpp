#include "solver/scenario/read_hardening.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/physics/hardening.hpp"
#include "solver/scenario/common_keys.hpp"
#include "solver/scenario/ranges.hpp"

namespace mpfem {

namespace {

void check_hardening_table(const TableReader& table, const HardeningParameters& hardening,
                           const MaterialParameters& material) {
  const double shear_modulus = material.youngs_modulus / (2 * (1 + material.poissons_ratio));
  const auto& strain = hardening.table_plastic_strain;
  const auto& stress = hardening.table_flow_stress;
  if (strain.empty()) table.fail("plastic_strain", "found an empty array, allowed: at least one value");
  if (strain.size() > static_cast<std::size_t>(TableLaw::max_points))
    table.fail("plastic_strain", fmt::format("found {} values, allowed: 1 … {}", strain.size(), TableLaw::max_points));
  if (stress.size() != strain.size())
    table.fail("flow_stress",
               fmt::format("found {} values, allowed: {}, as many as plastic_strain", stress.size(), strain.size()));
  if (strain[0] != 0) table.fail("plastic_strain", fmt::format("found first value {}, allowed: 0", strain[0]));
  for (std::size_t i = 1; i < strain.size(); ++i) {
    if (!(strain[i] > strain[i - 1]))
      table.fail("plastic_strain",
                 fmt::format("found {} after {}, allowed: increasing values", strain[i], strain[i - 1]));
    const double slope = (stress[i] - stress[i - 1]) / (strain[i] - strain[i - 1]);
    // On a steeper fall, the stress after a strain increment is not unique.
    if (!(slope > -3 * shear_modulus))
      table.fail("flow_stress", fmt::format("found a slope of {} MPa between values {} and {}, allowed: > -3 G = {}",
                                            slope, i - 1, i, -3 * shear_modulus));
  }
}

void read_power(TableReader& table, const MaterialParameters& /*material*/, HardeningParameters& h) {
  h.yield_stress = table.number("yield_stress", positive_modulus);
  h.coefficient = table.number("coefficient", positive_modulus);
  h.exponent = table.number("exponent", hardening_exponent);
}

void read_total_strain(TableReader& table, const MaterialParameters& material, HardeningParameters& h) {
  h.coefficient = table.number("coefficient", {.low = 1e-9, .high = material.youngs_modulus, .high_open = true});
  h.exponent = table.number("exponent", Range::between(1e-3, 0.99));
}

void read_table(TableReader& table, const MaterialParameters& material, HardeningParameters& h) {
  h.table_plastic_strain = table.numbers("plastic_strain", strain_or_zero);
  h.table_flow_stress = table.numbers("flow_stress", positive_modulus);
  check_hardening_table(table, h, material);
}

/// A law as scenarios name it, its keys, and what reads them.
struct HardeningKeyword {
  std::string name;
  HardeningLaw law;
  std::vector<std::string> keys;
  void (*read)(TableReader& table, const MaterialParameters& material, HardeningParameters& hardening);
};

const std::vector<HardeningKeyword>& hardening_keywords() {
  static const std::vector<HardeningKeyword> keywords{
      {"elastic", HardeningLaw::elastic, {}, [](auto&, const auto&, auto&) {}},
      {"power", HardeningLaw::power, {"yield_stress", "coefficient", "exponent"}, read_power},
      {"total_strain", HardeningLaw::total_strain, {"coefficient", "exponent"}, read_total_strain},
      {"table", HardeningLaw::table, {"plastic_strain", "flow_stress"}, read_table},
  };
  return keywords;
}

} // namespace

HardeningParameters read_hardening(TableReader table, const MaterialParameters& material) {
  std::vector<std::string> names, all_keys;
  for (const HardeningKeyword& keyword : hardening_keywords()) {
    names.push_back(keyword.name);
    all_keys.insert(all_keys.end(), keyword.keys.begin(), keyword.keys.end());
  }
  const std::string name = table.choice("law", names);
  const HardeningKeyword& keyword = *std::find_if(hardening_keywords().begin(), hardening_keywords().end(),
                                                  [&](const HardeningKeyword& k) { return k.name == name; });
  refuse_foreign_keys(table, all_keys, keyword.keys, fmt::format("law = '{}'", name));
  HardeningParameters hardening;
  hardening.law = keyword.law;
  keyword.read(table, material, hardening);
  table.finish();
  return hardening;
}

} // namespace mpfem
