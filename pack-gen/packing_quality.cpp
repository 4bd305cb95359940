#include "pack-gen/packing_quality.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

std::vector<double> ascending_diameters(const SpherePacking& packing) {
  std::vector<double> diameters;
  for (const double radius : packing.radius) diameters.push_back(2 * radius);
  std::sort(diameters.begin(), diameters.end());
  return diameters;
}

/// Share of the spheres below the middle of sphere `i` of `count`.
double middle_of(std::size_t i, std::size_t count) {
  return (static_cast<double>(i) + 0.5) / static_cast<double>(count);
}

double size_distance(const SpherePacking& packing, const SizeDistribution& target) {
  const std::vector<double> diameters = ascending_diameters(packing);
  double distance = 0;
  for (std::size_t i = 0; i < diameters.size(); ++i)
    distance = std::max(distance, std::abs(middle_of(i, diameters.size()) - target.cumulative_number(diameters[i])));
  return distance;
}

} // namespace

std::string quality_json(const SpherePacking& packing, const MeshReport& mesh, const PackingDescription* description) {
  std::string text = "{\n";
  const auto add = [&](const char* name, auto value) { text += fmt::format("  \"{}\": {},\n", name, value); };
  add("nodes", mesh.nodes);
  add("tets", mesh.tets);
  add("tets_per_grain", static_cast<double>(mesh.tets) / static_cast<double>(mesh.grains));
  add("nominal_size_mm", mesh.nominal_size);
  add("largest_volume_error", mesh.largest_volume_error);
  add("smallest_quality", mesh.smallest_quality);
  add("median_quality", mesh.median_quality);
  add("smallest_facet_gap_mm", mesh.facet_gap.gap);
  add("smallest_step_s", mesh.smallest_step);
  if (description != nullptr) add("size_distance", size_distance(packing, *description->distribution));
  add("grains", packing.radius.size());
  add("relative_density", relative_density(packing));
  return text + fmt::format("  \"smallest_gap_mm\": {}\n}}\n", smallest_gap(packing).gap);
}

std::string sizes_csv(const SpherePacking& packing) {
  const std::vector<double> diameters = ascending_diameters(packing);
  std::string text = "diameter_mm,cumulative_number\n";
  for (std::size_t i = 0; i < diameters.size(); ++i)
    text += fmt::format("{:.9g},{:.9g}\n", diameters[i], middle_of(i, diameters.size()));
  return text;
}

std::string target_csv(const PackingDescription& description) {
  if (description.table_diameters.empty())
    throw InputError(fmt::format("{}key 'size_distribution.kind': found no table, allowed with --target: table",
                                 description.places.prefix("size_distribution")));
  std::string text = "diameter_mm,cumulative_number\n";
  for (const double diameter : description.table_diameters)
    text += fmt::format("{:.9g},{:.9g}\n", diameter, description.distribution->cumulative_number(diameter));
  return text;
}

} // namespace mpfem
