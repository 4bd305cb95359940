#include "postproc/metrics/damage_band.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/metrics/damage_of_test.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/snapshot_window.hpp"

namespace mpfem {

namespace {

constexpr double thickness = 0.2;  // of the box
constexpr double rounding = 1e-12; // of sums in another order

constexpr double inclined[] = {30, 37.5, 45, 52.5, 60}, not_inclined[] = {0, 10, 20, 70, 80, 90}; // degrees

/// A slab and the pairs in it.
struct Slab {
  Eigen::Vector3d normal;
  double offset;
  std::vector<std::uint32_t> pairs;
  double area = 0; ///< mm^2
};

/// Unit vectors at these inclinations (degrees) to `axis`, 15 degrees apart around it.
std::vector<Eigen::Vector3d> normals_at(std::span<const double> inclinations, int axis) {
  std::vector<Eigen::Vector3d> normals;
  constexpr double degree = std::numbers::pi / 180;
  for (const double inclination : inclinations)
    for (int around = 0; around < 360; around += 15) {
      Eigen::Vector3d normal;
      normal[axis] = std::cos(inclination * degree);
      normal[(axis + 1) % 3] = std::sin(inclination * degree) * std::cos(around * degree);
      normal[(axis + 2) % 3] = std::sin(inclination * degree) * std::sin(around * degree);
      normals.push_back(normal);
    }
  return normals;
}

std::vector<Slab> slabs_at(std::span<const double> inclinations, const std::vector<PairOpening>& pairs, int axis) {
  std::vector<Slab> slabs;
  for (const Eigen::Vector3d& normal : normals_at(inclinations, axis))
    for (int step = -6; step <= 6; ++step) {
      Slab slab{normal, 0.05 * step, {}};
      for (std::uint32_t pair = 0; pair < pairs.size(); ++pair) {
        if (std::abs(normal.dot(pairs[pair].place) - slab.offset) > thickness / 2) continue;
        slab.pairs.push_back(pair);
        slab.area += pairs[pair].area;
      }
      if (slab.area > 0) slabs.push_back(std::move(slab));
    }
  return slabs;
}

/// The slab with the largest excess where `opened` (mm^2) of each pair has opened.
DamageBand densest_of(const std::vector<Slab>& slabs, const std::vector<double>& opened, double whole_area) {
  double sum = 0;
  for (const double area : opened) sum += area;
  const double share = sum / whole_area;
  DamageBand densest;
  densest.excess = -std::numeric_limits<double>::infinity();
  for (const Slab& slab : slabs) {
    double inside = 0;
    for (const std::uint32_t pair : slab.pairs) inside += opened[pair];
    const double excess = (inside - share * slab.area) / std::sqrt(slab.area * share * (1 - share));
    if (excess > densest.excess) densest = {slab.normal, slab.offset, slab.area / whole_area, inside / sum, excess};
  }
  return densest;
}

struct Openings {
  std::vector<double> share, area; ///< [pairs]: 1, mm^2
  double whole_area = 0, whole_opened = 0;
};

Openings openings_of(const std::vector<PairOpening>& pairs) {
  Openings all;
  for (const PairOpening& pair : pairs) {
    all.share.push_back(pair.opened / pair.area);
    all.area.push_back(pair.area);
    all.whole_area += pair.area;
    all.whole_opened += pair.opened;
  }
  return all;
}

std::vector<double> opened_areas(const Openings& all) {
  std::vector<double> opened(all.share);
  for (std::size_t pair = 0; pair < opened.size(); ++pair) opened[pair] *= all.area[pair];
  return opened;
}

/// Shuffles by Fisher and Yates. std::shuffle may differ between standard libraries.
void shuffle(std::vector<double>& values, std::mt19937_64& random) {
  for (std::size_t left = values.size(); left > 1; --left) std::swap(values[left - 1], values[random() % left]);
}

/// The pairs of the bonds that had not opened before the test, at their places in `now`.
std::vector<PairOpening> openings(const BondsSince& since, const Snapshot& now, double threshold) {
  std::vector<PairOpening> pairs;
  for (std::size_t b = 0; b < since.found.size(); ++b) {
    const BondRow& bond = since.found[b];
    if (since.found_before[b].damage >= threshold) continue;
    if (pairs.size() <= bond.pair) pairs.resize(bond.pair + 1, {Eigen::Vector3d::Zero()});
    PairOpening& pair = pairs[bond.pair];
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double x = static_cast<double>(now.node[3 * static_cast<std::size_t>(bond.node) + k]);
      pair.place[axis] += bond.area * ((x - now.box_low[k]) / (now.box_high[k] - now.box_low[k]) - 0.5);
    }
    pair.area += bond.area;
    if (bond.damage >= threshold) pair.opened += bond.area;
  }
  std::erase_if(pairs, [](const PairOpening& pair) { return !(pair.area > 0); });
  for (PairOpening& pair : pairs) pair.place /= pair.area;
  return pairs;
}

} // namespace

std::optional<BandByChance> band_by_chance(const std::vector<PairOpening>& pairs, int axis, int trials,
                                           const TrialsDone& done) {
  Openings all = openings_of(pairs);
  const std::vector<Slab> slabs = slabs_at(inclined, pairs, axis);
  if (!(all.whole_opened > 0) || !(all.whole_opened < all.whole_area) || slabs.empty()) return {};
  const std::vector<double> opened = opened_areas(all);
  const DamageBand band = densest_of(slabs, opened, all.whole_area);
  const double other = densest_of(slabs_at(not_inclined, pairs, axis), opened, all.whole_area).excess;
  std::mt19937_64 random(1);
  int as_dense = 0;
  for (int trial = 0; trial < trials; ++trial) {
    shuffle(all.share, random);
    if (densest_of(slabs, opened_areas(all), all.whole_area).excess >= band.excess * (1 - rounding)) ++as_dense;
    if (done) done((trial + 1.0) / trials);
  }
  return BandByChance{band, static_cast<double>(as_dense + 1) / (trials + 1), other};
}

Measurement measure_damage_band(const schema::FileReader& file, int snapshot, const schema::FileReader& before,
                                int snapshot_before, const BandRule& rule, const TrialsDone& done) {
  const BondsSince since = bonds_of_test(file, snapshot, before, snapshot_before);
  const std::vector<PairOpening> pairs = openings(since, read_snapshot(file, snapshot), rule.threshold);
  const auto found = band_by_chance(pairs, rule.axis, rule.trials, done);
  if (pairs.empty())
    throw InputError(fmt::format("{}: all bonds have a damage of {:g} or more before the test, allowed: a larger "
                                 "--threshold",
                                 one_line(file.path()), rule.threshold));
  if (!found)
    throw InputError(fmt::format("{}: the test opens none or all of the {} pairs of grains whose bonds have a damage "
                                 "below {:g} before it, so there is no band, allowed: a threshold that some bonds pass",
                                 one_line(file.path()), pairs.size(), rule.threshold));
  const DamageBand& band = found->band;
  const Openings all = openings_of(pairs);
  Measurement m;
  m.metric = "damage-band";
  m.value = band.concentration();
  m.uncertainty_meaning = "not known: `chance` says how often chance makes a band as dense";
  m.method = fmt::format("opened share of the bonds in the inclined slab where most have opened, over that of all "
                         "bonds; threshold {:g}, slabs a fifth of the box thick, 30 to 60 degrees off {}; {} trials",
                         rule.threshold, "xyz"[rule.axis], rule.trials);
  m.snapshot = snapshot_window(file, snapshot);
  m.details["chance"] = found->chance;
  m.details["excess_over_that_of_slabs_not_inclined"] = band.excess / found->other_excess;
  m.details["opened_share"] = all.whole_opened / all.whole_area;
  m.details["opened_share_in_band"] = m.value * all.whole_opened / all.whole_area;
  m.details["share_of_opened_in_band"] = band.opened_share;
  m.details["share_of_bonds_in_band"] = band.area_share;
  m.details["normal"] = {band.normal[0], band.normal[1], band.normal[2]};
  m.details["offset"] = band.offset;
  m.details["pairs"] = pairs.size();
  m.brief = fmt::format("{:.1f} % of the bonds open, {:.1f} % in the band; chance {:.3g}",
                        100 * all.whole_opened / all.whole_area, 100 * m.value * all.whole_opened / all.whole_area,
                        found->chance);
  return m;
}

} // namespace mpfem
