#include "postproc/metrics/damage_statistics.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/metrics/bond_energy.hpp"
#include "postproc/run_data/bond_table.hpp"
#include "postproc/run_data/snapshot_window.hpp"

namespace mpfem {

namespace {

/// A property that none of n units has belongs to fewer than 3 / n of all units, with 95 % confidence (Hanley and
/// Lippman-Hand, J. Am. Med. Assoc. 249 (1983) 1743).
constexpr double rule_of_three = 3;

/// [pairs], sums of area times weight(bond) over the bonds of each pair.
template <class Weight>
std::vector<double> pair_sums(std::span<const BondSample> bonds, std::size_t pairs, const Weight& weight) {
  std::vector<double> sums(pairs, 0.0);
  for (const BondSample& bond : bonds) sums[bond.pair] += bond.area * weight(bond);
  return sums;
}

std::vector<BondSample> samples_of(std::span<const BondRow> bonds) {
  std::vector<BondSample> samples;
  for (const BondRow& bond : bonds) samples.push_back({bond.pair, bond.area, bond.damage});
  return samples;
}

bool is_broken(const BondSample& bond) {
  return bond.damage >= 1;
}

} // namespace

std::vector<Column> damage_distribution(std::span<const BondSample> bonds) {
  std::vector<const BondSample*> ascending;
  for (const BondSample& bond : bonds) ascending.push_back(&bond);
  std::sort(ascending.begin(), ascending.end(), [](const auto* a, const auto* b) { return a->damage < b->damage; });
  std::vector<Column> columns = {{"damage", "1", {}}, {"area_share", "1", {}}};
  auto &damage = columns[0].values, &share = columns[1].values;
  double area = 0;
  for (const BondSample* bond : ascending) {
    area += bond->area;
    if (damage.empty() || bond->damage > damage.back()) {
      damage.push_back(bond->damage);
      share.push_back(0);
    }
    share.back() = area;
  }
  for (double& value : share) value /= area;
  return columns;
}

double damage_percentile(const std::vector<Column>& distribution, double share) {
  // A sum of areas may fall short of the share by rounding.
  constexpr double rounding = 1e-12;
  const auto &damage = distribution[0].values, &shares = distribution[1].values;
  const auto at = std::lower_bound(shares.begin(), shares.end(), share - rounding);
  return at == shares.end() ? damage.back() : damage[static_cast<std::size_t>(at - shares.begin())];
}

DamageStatistics damage_statistics(std::span<const BondSample> bonds) {
  DamageStatistics s;
  s.bonds = bonds.size();
  for (const BondSample& bond : bonds) s.pairs = std::max(s.pairs, bond.pair + 1);
  const auto sums = [&](const auto& weight) { return pair_sums(bonds, s.pairs, weight); };
  const std::vector<double> area = sums([](const BondSample&) { return 1.0; });
  const auto share_of_pairs = [&](const std::vector<double>& of_pair, const std::vector<double>& whole) {
    Ratio ratio = ratio_of_sums(of_pair, whole);
    if (s.pairs > 1 && (ratio.value <= 0 || ratio.value >= 1)) // none or all: the formula would give 0
      ratio.half_width = std::min(1.0, rule_of_three / static_cast<double>(s.pairs));
    return ratio;
  };
  const auto share = [&](const auto& belongs) {
    return share_of_pairs(sums([&](const BondSample& bond) { return belongs(bond) ? 1.0 : 0.0; }), area);
  };
  for (const double of_pair : area) s.area += of_pair;
  const std::vector<double> damaged = sums([](const BondSample& bond) { return bond.damage; });
  s.mean = ratio_of_sums(damaged, area);
  s.broken_share = share(is_broken);
  s.undamaged_share = share([](const BondSample& bond) { return bond.damage <= 0; });

  std::vector<double> wholly_broken(s.pairs, 1.0), mean_of_pair(s.pairs);
  for (const BondSample& bond : bonds)
    if (!is_broken(bond)) wholly_broken[bond.pair] = 0;
  s.wholly_broken_pairs = share_of_pairs(wholly_broken, std::vector<double>(s.pairs, 1.0));
  for (std::size_t pair = 0; pair < s.pairs; ++pair) mean_of_pair[pair] = damaged[pair] / area[pair];
  s.between_pairs = standard_deviation(mean_of_pair);

  const std::vector<Column> distribution = damage_distribution(bonds);
  for (std::size_t i = 0; i < damage_percentiles.size(); ++i) {
    const double below = damage_percentiles[i] / 100.0;
    const double value = damage_percentile(distribution, below);
    const double reach = share([&](const BondSample& bond) { return bond.damage <= value; }).half_width;
    s.percentile[i].value = value;
    if (!std::isnan(reach))
      s.percentile[i].half_width =
          0.5 * (damage_percentile(distribution, below + reach) - damage_percentile(distribution, below - reach));
  }
  return s;
}

std::vector<BondSample> read_bonds(const schema::FileReader& file, int snapshot) {
  return samples_of(read_bond_table(file, snapshot));
}

Measurement measure_damage(const schema::FileReader& file, int snapshot) {
  const std::vector<BondRow> bonds = read_bond_table(file, snapshot);
  const DamageStatistics s = damage_statistics(samples_of(bonds));
  Measurement m;
  m.metric = "damage";
  m.value = s.mean.value;
  m.uncertainty = s.mean.half_width;
  m.uncertainty_meaning =
      "half of the 95 % interval of the ratio of sums over pairs of grains, taken as independent of each "
      "other; not that of the mesh";
  m.method = "mean damage of the bonds ever formed, both sides of every contact, weighted by their areas";
  m.snapshot = snapshot_window(file, snapshot);

  const auto add = [&](const std::string& key, Ratio ratio) {
    m.details[key] = ratio.value;
    m.details[key + "_uncertainty"] = ratio.half_width;
  };
  add("broken_share", s.broken_share);
  add("undamaged_share", s.undamaged_share);
  for (std::size_t i = 0; i < damage_percentiles.size(); ++i)
    add(fmt::format("damage_percentile_{}", damage_percentiles[i]), s.percentile[i]);
  add("standard_deviation_between_pairs", s.between_pairs);
  add("wholly_broken_pairs_share", s.wholly_broken_pairs);
  m.details["pairs"] = s.pairs;
  m.details["bonds"] = s.bonds;
  m.details["bond_area_mm2"] = s.area;
  const auto energy = bond_energy(bonds);
  m.details["energy_spent_share"] = number_or_null(energy ? std::optional(energy->share()) : std::nullopt);
  m.details["damage_dissipation_mJ"] = number_or_null(energy ? std::optional(energy->dissipation) : std::nullopt);
  m.details["energy_to_break_mJ"] = number_or_null(energy ? std::optional(energy->energy_to_break) : std::nullopt);
  m.brief =
      fmt::format("{:.3g} % of the area broken, {:.3g} % undamaged, median {:.4g}; {} bonds of {} pairs of grains",
                  100 * s.broken_share.value, 100 * s.undamaged_share.value, s.percentile[2].value, s.bonds, s.pairs);
  if (s.pairs == 1) m.notes.emplace_back("one pair of grains has bonds: the uncertainty is not known");
  return m;
}

} // namespace mpfem
