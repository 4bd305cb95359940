#include "postproc/view/view_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "common/errors.hpp"
#include "postproc/drawing/cut_solid.hpp"
#include "postproc/drawing/field_display.hpp"
#include "postproc/drawing/tool_surface.hpp"
#include "postproc/run_data/surface_facets.hpp"

namespace mpfem {

namespace {

constexpr const char* shown_names[] = {"von_mises", "plastic_strain", "pressure", "damage"};

bool has_field(const Snapshot& snapshot, const std::string& name) {
  return name != "damage" || std::any_of(snapshot.node_fields.begin(), snapshot.node_fields.end(),
                                         [](const Field& field) { return field.name == "damage"; });
}

/// Maps low … high to 0 … largest; values that are not finite become 0.
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

/// Adds the surfaces of the tools of all snapshots.
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

/// The range of the values on the grains' surfaces, by the rule of pictures.
std::pair<double, double> surface_range(const ViewData& data, const Snapshot& snapshot,
                                        const std::vector<double>& value) {
  const auto position = [&](std::uint32_t node) {
    const float* x = snapshot.node.data() + 3 * std::size_t{node};
    return Eigen::Vector3d(x[0], x[1], x[2]);
  };
  std::vector<std::pair<double, double>> value_and_area;
  for (std::size_t f = 0; f < data.facet.size(); f += 3) {
    const Eigen::Vector3d a = position(data.facet[f]), b = position(data.facet[f + 1]), c = position(data.facet[f + 2]);
    const double area = (b - a).cross(c - a).norm() / 6; // a third of the facet's area for each corner
    for (std::size_t k = 0; k < 3; ++k) value_and_area.emplace_back(value[data.facet[f + k]], area);
  }
  return colour_range(std::move(value_and_area));
}

/// Maps low … high to 1 … 255; 0 means no value.
std::uint8_t quantised_or_none(double value, double low, double high) {
  if (!std::isfinite(value)) return 0;
  return static_cast<std::uint8_t>(1 + std::lround(254 * std::clamp((value - low) / (high - low), 0.0, 1.0)));
}

/// Adds a field of all snapshots, on the scale that covers them all.
void add_field(ViewData& data, const std::vector<Snapshot>& snapshots, const std::string& name) {
  std::vector<std::vector<double>> values;
  QuantisedField shown{name, shown_field(snapshots.front(), name).unit, {0, 0}, name == "damage"};
  for (const Snapshot& snapshot : snapshots) {
    values.push_back(shown_field(snapshot, name).value);
    const auto range = shown.sparse ? std::pair{0.0, 1.0} : surface_range(data, snapshot, values.back());
    shown.range.first = std::min(shown.range.first, range.first);
    shown.range.second = std::max(shown.range.second, range.second);
  }
  for (std::size_t s = 0; s < snapshots.size(); ++s) {
    auto& whole = data.states[s].value.emplace_back();
    for (const double value : values[s])
      whole.push_back(shown.sparse ? quantised_or_none(value, shown.range.first, shown.range.second)
                                   : quantised<std::uint8_t>(value, shown.range.first, shown.range.second));
  }
  ColourBar bar{shown.range, ""};
  for (const auto& of_snapshot : values)
    for (const double value : of_snapshot) bar.add(value);
  shown.ends = bar.end_texts();
  data.fields.push_back(std::move(shown));
}

void add_rods(ViewData& data, const std::vector<std::vector<PairRod>>& rods) {
  for (const auto& of_state : rods)
    for (const PairRod& rod : of_state) data.widest_rod = std::max(data.widest_rod, rod.radius);
  for (std::size_t s = 0; s < rods.size(); ++s)
    for (const PairRod& rod : rods[s]) {
      for (const Eigen::Vector3d& end : {rod.from, rod.to})
        for (int k = 0; k < 3; ++k) {
          const auto axis = static_cast<std::size_t>(k);
          data.states[s].rod_end.push_back(quantised<std::uint16_t>(end[k], data.low[axis], data.high[axis]));
        }
      data.states[s].rod_kind.push_back(static_cast<std::uint8_t>(rod.kind));
      data.states[s].rod_width.push_back(quantised<std::uint8_t>(rod.radius, 0, data.widest_rod));
    }
}

} // namespace

ViewData view_data(const std::vector<Snapshot>& snapshots, const std::vector<std::vector<PairRod>>& rods) {
  if (snapshots.empty()) throw InputError("found no snapshot, allowed: one or more");
  ViewData data;
  add_mesh(data, snapshots.front());
  add_bounds(data, snapshots);
  for (const Snapshot& snapshot : snapshots) {
    ViewState state;
    state.relative_density = snapshot.relative_density;
    state.mean_stress = snapshot.mean_stress;
    state.box_low = snapshot.box_low;
    state.box_high = snapshot.box_high;
    state.position.reserve(snapshot.node.size());
    for (std::size_t i = 0; i < snapshot.node.size(); ++i)
      state.position.push_back(
          quantised<std::uint16_t>(static_cast<double>(snapshot.node[i]), data.low[i % 3], data.high[i % 3]));
    data.states.push_back(std::move(state));
  }
  for (const char* name : shown_names)
    if (std::all_of(snapshots.begin(), snapshots.end(), [&](const auto& s) { return has_field(s, name); }))
      add_field(data, snapshots, name);
  add_tools(data, snapshots);
  add_rods(data, rods);
  return data;
}

std::vector<std::vector<PairRod>> rods_of(const schema::FileReader& file, const std::vector<Snapshot>& snapshots) {
  std::vector<std::vector<PairRod>> rods;
  for (const Snapshot& snapshot : snapshots) {
    rods.push_back(contact_rods(file, snapshot, {}));
    if (!file.has(schema::run::snapshots_pair_damage, snapshot.name)) continue;
    const std::vector<PairRod> bonds = bond_rods(file, snapshot, {});
    rods.back().insert(rods.back().end(), bonds.begin(), bonds.end());
  }
  return rods;
}

} // namespace mpfem
