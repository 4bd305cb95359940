#include "postproc/view/view_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/errors.hpp"
#include "postproc/picture/cut_solid.hpp"
#include "postproc/surface_facets.hpp"
#include "postproc/tool_surface.hpp"

namespace mpfem {

namespace {

constexpr const char* shown_names[] = {"von_mises", "plastic_strain", "pressure"};

/// The value below which a share of the finite ones lies.
double percentile(std::vector<double> values, double fraction) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// 0 … largest from low to high; what is not a number becomes 0.
template <class Whole>
Whole quantised(double value, double low, double high) {
  constexpr double largest = std::numeric_limits<Whole>::max();
  if (!std::isfinite(value)) return 0;
  return static_cast<Whole>(std::lround(largest * std::clamp((value - low) / (high - low), 0.0, 1.0)));
}

void add_mesh(ViewData& data, const Snapshot& snapshot) {
  std::vector<std::int32_t> all(snapshot.tets());
  std::iota(all.begin(), all.end(), 0);
  for (const SurfaceFacet& facet : surface_facets(snapshot, all))
    data.facet.insert(data.facet.end(), facet.node.begin(), facet.node.end());
  data.tet.assign(snapshot.tet.begin(), snapshot.tet.end());
  data.grain.resize(snapshot.nodes());
  for (std::size_t corner = 0; corner < snapshot.tet.size(); ++corner)
    data.grain[static_cast<std::size_t>(snapshot.tet[corner])] =
        static_cast<std::uint16_t>(snapshot.tet_grain[corner / 4]);
}

void add_bounds(ViewData& data, const std::vector<Snapshot>& snapshots) {
  data.low.fill(std::numeric_limits<double>::max());
  data.high.fill(std::numeric_limits<double>::lowest());
  for (const Snapshot& snapshot : snapshots)
    for (std::size_t i = 0; i < snapshot.node.size(); ++i) {
      const auto x = static_cast<double>(snapshot.node[i]);
      data.low[i % 3] = std::min(data.low[i % 3], x);
      data.high[i % 3] = std::max(data.high[i % 3], x);
    }
}

/// The surfaces of the tools of all snapshots.
void add_tools(ViewData& data, const std::vector<Snapshot>& snapshots) {
  std::vector<std::vector<SolidTriangle>> surfaces;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Snapshot& snapshot : snapshots) {
    const DrawnExtent extent = drawn_extent(snapshot);
    surfaces.push_back(tool_surface(tool_bodies(snapshot, extent), extent, {}));
    for (const SolidTriangle& t : surfaces.back())
      for (const SolidVertex& vertex : t.corner)
        low = low.cwiseMin(vertex.position), high = high.cwiseMax(vertex.position);
  }
  if (!(low[0] <= high[0])) return;
  high = high.cwiseMax(low + Eigen::Vector3d::Constant(1e-9));
  for (int k = 0; k < 3; ++k) {
    data.tool_low[static_cast<std::size_t>(k)] = low[k];
    data.tool_high[static_cast<std::size_t>(k)] = high[k];
  }
  for (std::size_t s = 0; s < snapshots.size(); ++s)
    for (const SolidTriangle& t : surfaces[s])
      for (const SolidVertex& vertex : t.corner)
        for (int k = 0; k < 3; ++k) {
          data.states[s].tool_position.push_back(quantised<std::uint16_t>(vertex.position[k], low[k], high[k]));
          data.states[s].tool_normal.push_back(static_cast<std::int8_t>(std::lround(127 * vertex.normal[k])));
        }
}

/// One field of all snapshots, on the scale that holds them all.
void add_field(ViewData& data, const std::vector<Snapshot>& snapshots, const char* name) {
  std::vector<std::vector<double>> values;
  QuantisedField shown{name, snapshots.front().tet_field(name).unit, {0, 0}};
  for (const Snapshot& snapshot : snapshots) {
    values.push_back(shown_field(snapshot, name).value);
    shown.range.first = std::min(shown.range.first, percentile(values.back(), 0.005));
    shown.range.second = std::max(shown.range.second, percentile(values.back(), 0.995));
  }
  if (!(shown.range.second > shown.range.first)) shown.range.second = shown.range.first + 1;
  for (std::size_t s = 0; s < snapshots.size(); ++s) {
    auto& whole = data.states[s].value.emplace_back();
    for (const double value : values[s])
      whole.push_back(quantised<std::uint8_t>(value, shown.range.first, shown.range.second));
  }
  data.fields.push_back(std::move(shown));
}

} // namespace

ViewData view_data(const std::vector<Snapshot>& snapshots) {
  if (snapshots.empty()) throw InputError("found no snapshot, allowed: one or more");
  ViewData data;
  add_mesh(data, snapshots.front());
  add_bounds(data, snapshots);
  for (const Snapshot& snapshot : snapshots) {
    ViewState state{
        snapshot.relative_density, snapshot.mean_stress, snapshot.box_low, snapshot.box_high, {}, {}, {}, {}};
    state.position.reserve(snapshot.node.size());
    for (std::size_t i = 0; i < snapshot.node.size(); ++i)
      state.position.push_back(
          quantised<std::uint16_t>(static_cast<double>(snapshot.node[i]), data.low[i % 3], data.high[i % 3]));
    data.states.push_back(std::move(state));
  }
  for (const char* name : shown_names) add_field(data, snapshots, name);
  add_tools(data, snapshots);
  return data;
}

} // namespace mpfem
