#include "postproc/drawing/section_statistics.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/snapshot_window.hpp"

namespace mpfem {

namespace {

CutPlane middle(const Snapshot& snapshot, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  return {axis, snapshot.box_low[a] + 0.5 * (snapshot.box_high[a] - snapshot.box_low[a])};
}

Measurement of_section(const char* metric, const schema::FileReader& file, int number) {
  Measurement m;
  m.metric = metric;
  m.uncertainty_meaning = "not known: a section of one snapshot";
  m.snapshot = snapshot_window(file, number);
  return m;
}

} // namespace

SectionStress section_stress(std::vector<std::pair<double, double>> value_and_area, double threshold) {
  std::erase_if(value_and_area, [](const auto& polygon) { return !(polygon.second > 0); });
  if (value_and_area.empty()) throw InputError("the section is empty");
  std::sort(value_and_area.begin(), value_and_area.end());
  double total = 0, moment = 0, above = 0;
  for (const auto& [value, area] : value_and_area) {
    total += area;
    moment += value * area;
    if (value > threshold) above += area;
  }
  const double largest = value_and_area.back().first;
  const WeightedPercentiles percentiles(std::move(value_and_area));
  return {moment / total, percentiles.at(0.5), percentiles.at(0.95), percentiles.at(0.99), largest, above / total};
}

SectionDamage section_damage(const std::vector<BoundarySegment>& segments, double threshold) {
  SectionDamage result;
  double moment = 0, above = 0;
  for (const BoundarySegment& s : segments) {
    if (s.damage_from < 0 || s.damage_to < 0) continue;
    const double length = std::hypot(s.to[0] - s.from[0], s.to[1] - s.from[1]);
    const double damage = (s.damage_from + s.damage_to) / 2;
    result.bonded_length += length;
    moment += damage * length;
    if (damage >= threshold) above += length;
  }
  if (result.bonded_length > 0) {
    result.mean = moment / result.bonded_length;
    result.share_above = above / result.bonded_length;
  }
  return result;
}

Measurement measure_section_stress(const schema::FileReader& file, int number, int axis, double threshold) {
  const Snapshot snapshot = read_snapshot(file, number);
  const auto& field = snapshot.tet_field("von_mises");
  std::vector<std::pair<double, double>> values;
  for (const SectionPolygon& polygon : cut(snapshot, middle(snapshot, axis)))
    values.emplace_back(field.values[static_cast<std::size_t>(polygon.tet)], area(polygon));
  if (std::ranges::none_of(values, [](const auto& polygon) { return polygon.second > 0; }))
    throw InputError(fmt::format("{}: found no grain on the middle plane of snapshot {}, normal to {}, allowed: a "
                                 "snapshot or axis with grains there",
                                 one_line(file.path()), number, "xyz"[axis]));
  const SectionStress s = section_stress(std::move(values), threshold);
  Measurement m = of_section("section-stress", file, number);
  m.value = s.mean;
  m.unit = "MPa";
  m.method = fmt::format("von Mises stress on the middle plane, weighted by area; threshold {:g} MPa", threshold);
  m.details = {{"mean_MPa", s.mean},
               {"median_MPa", s.median},
               {"percentile_95_MPa", s.percentile_95},
               {"percentile_99_MPa", s.percentile_99},
               {"largest_MPa", s.largest},
               {"share_above_threshold", s.share_above},
               {"relative_density", snapshot.relative_density}};
  return m;
}

Measurement measure_section_damage(const schema::FileReader& file, int number, int axis, double threshold) {
  const Snapshot snapshot = read_snapshot(file, number);
  const SectionDamage s = section_damage(cut_boundaries(snapshot, middle(snapshot, axis)), threshold);
  Measurement m = of_section("section-damage", file, number);
  m.value = s.mean;
  m.method = fmt::format("damage along the grains' boundaries on the middle plane, weighted by length; threshold {:g}",
                         threshold);
  m.details = {
      {"bonded_length_mm", s.bonded_length}, {"mean_damage", s.mean}, {"share_above_threshold", s.share_above}};
  return m;
}

} // namespace mpfem
