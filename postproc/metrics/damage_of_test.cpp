#include "postproc/metrics/damage_of_test.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/metrics/bond_energy.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/snapshot_window.hpp"

namespace mpfem {

namespace {

/// sum(area * value) / sum(area), with pairs of grains as the independent units; 0 without bonds.
Ratio area_mean(const std::vector<BondRow>& bonds, const std::vector<double>& value) {
  if (bonds.empty()) return {};
  std::vector<double> weighted(pairs_of(bonds), 0.0), area(weighted.size(), 0.0);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    weighted[bonds[b].pair] += bonds[b].area * value[b];
    area[bonds[b].pair] += bonds[b].area;
  }
  std::vector<double> weighted_there, area_there; // of the pairs that have such bonds
  for (std::size_t pair = 0; pair < area.size(); ++pair)
    if (area[pair] > 0) {
      weighted_there.push_back(weighted[pair]);
      area_there.push_back(area[pair]);
    }
  return ratio_of_sums(weighted_there, area_there);
}

template <class Value>
std::vector<double> values_of(const std::vector<BondRow>& bonds, const Value& value) {
  std::vector<double> values;
  for (const BondRow& bond : bonds) values.push_back(value(bond));
  return values;
}

double damage_of(const BondRow& bond) {
  return bond.damage;
}

nlohmann::ordered_json energy_spent_share(const std::vector<BondRow>& bonds) {
  const auto energy = bond_energy(bonds);
  return number_or_null(energy ? std::optional(energy->share()) : std::nullopt);
}

double total_area(const std::vector<BondRow>& bonds) {
  double area = 0;
  for (const BondRow& bond : bonds) area += bond.area;
  return area;
}

/// Adds the current state of one group of bonds; each key begins with `prefix`.
void add_group(nlohmann::ordered_json& details, const std::string& prefix, const std::vector<BondRow>& bonds) {
  const auto broken = [](const BondRow& bond) { return bond.broken() ? 1.0 : 0.0; };
  const auto add = [&](const char* key, const std::vector<double>& values) {
    const Ratio ratio = area_mean(bonds, values);
    details[prefix + key] = bonds.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(ratio.value);
    details[fmt::format("{}{}_uncertainty", prefix, key)] = ratio.half_width;
  };
  details[prefix + "bonds"] = bonds.size();
  details[prefix + "bond_area_mm2"] = total_area(bonds);
  add("mean_damage", values_of(bonds, damage_of));
  add("broken_share", values_of(bonds, broken));
  const auto energy = bond_energy(bonds);
  details[prefix + "energy_spent_share"] = energy_spent_share(bonds);
  details[prefix + "damage_dissipation_mJ"] =
      number_or_null(energy ? std::optional(energy->dissipation) : std::nullopt);
}

} // namespace

BondsSince bonds_since(const std::vector<BondRow>& before, const std::vector<BondRow>& now) {
  std::map<std::pair<std::int32_t, std::int32_t>, const BondRow*> then;
  for (const BondRow& bond : before) then[{bond.node, bond.grain}] = &bond;
  BondsSince since;
  for (const BondRow& bond : now) {
    const auto earlier = then.find({bond.node, bond.grain});
    const bool broken_then = earlier != then.end() && earlier->second->broken();
    if (earlier != then.end() && !broken_then) {
      since.found.push_back(bond);
      since.found_before.push_back(*earlier->second);
    } else {
      (broken_then && bond.broken() ? since.broken_already : since.formed).push_back(bond);
    }
  }
  return since;
}

BondsSince bonds_of_test(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                         int snapshot_before) {
  namespace run = schema::run;
  if (file.read_scalar(run::provenance_packing_hash) != before.read_scalar(run::provenance_packing_hash))
    throw InputError(fmt::format("{}: its packing is not that of {}, allowed: the run that it branched from, or itself",
                                 one_line(before.path()), one_line(file.path())));
  const auto time_of = [](const schema::FileReader& reader, int number) {
    return reader.read_scalar(run::snapshots_time, snapshot_name(reader, number));
  };
  if (time_of(before, snapshot_before) > time_of(file, snapshot))
    throw InputError(fmt::format("{}: found the snapshot before later than that of {}, allowed: an earlier one",
                                 one_line(before.path()), one_line(file.path())));
  BondsSince since = bonds_since(read_bond_table(before, snapshot_before), read_bond_table(file, snapshot));
  if (since.found.empty())
    throw InputError(fmt::format("{}: no bond is intact at that snapshot, allowed: --before and --snapshot-before of a "
                                 "bonded compact",
                                 one_line(before.path())));
  return since;
}

Measurement measure_damage_of_test(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                                   int snapshot_before) {
  const BondsSince since = bonds_of_test(file, snapshot, before, snapshot_before);
  const std::vector<double> damage_before = values_of(since.found_before, damage_of);
  std::vector<double> growth = values_of(since.found, damage_of);
  for (std::size_t b = 0; b < growth.size(); ++b) growth[b] -= damage_before[b];
  const Ratio value = area_mean(since.found, growth), then = area_mean(since.found, damage_before);
  Measurement m;
  m.metric = "damage-of-test";
  m.value = value.value;
  m.uncertainty = value.half_width;
  m.uncertainty_meaning = "half of the 95 % interval of the ratio of sums over pairs of grains, taken as independent";
  m.method = "growth of the area-weighted mean damage of the bonds that were intact at the snapshot before";
  m.snapshot = snapshot_window(file, snapshot);
  m.details["snapshot_before"] = snapshot_window(before, snapshot_before).number;
  m.details["found_mean_damage_before"] = then.value;
  m.details["found_mean_damage_before_uncertainty"] = then.half_width;
  m.details["found_energy_spent_share_before"] = energy_spent_share(since.found_before);
  add_group(m.details, "found_", since.found);
  add_group(m.details, "formed_", since.formed);
  m.details["broken_already_bonds"] = since.broken_already.size();
  m.details["broken_already_bond_area_mm2"] = total_area(since.broken_already);
  m.brief = fmt::format("of {} bonds found, from {:.4g}; {} formed since, {} broken before", since.found.size(),
                        then.value, since.formed.size(), since.broken_already.size());
  return m;
}

} // namespace mpfem
