#include "postproc/picture/picture_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/drawing/field_display.hpp"
#include "postproc/drawing/tool_surface.hpp"
#include "postproc/run_data/tet_geometry.hpp"

namespace mpfem {

namespace {

/// The field of the snapshot that each colour shows.
const std::map<std::string, std::string> fields = {{"von-mises", "von_mises"}, {"plastic-strain", "plastic_strain"},
                                                   {"pressure", "pressure"},   {"damage", "damage"},
                                                   {"grain", "grain"},         {"plain", "grain"}};

const std::string& field_of(const std::string& colour) {
  const auto found = fields.find(colour);
  if (found == fields.end())
    throw InputError(
        fmt::format("--color: found '{}', allowed: {}", one_line(colour), fmt::join(colour_names(), ", ")));
  return found->second;
}

Eigen::Vector3d vector_of(const std::array<double, 3>& x) {
  return {x[0], x[1], x[2]};
}

double area(const SolidTriangle& t) {
  const Eigen::Vector3d& a = t.corner[0].position;
  return 0.5 * (t.corner[1].position - a).cross(t.corner[2].position - a).norm();
}

/// Colour where the field has no value: for damage, surfaces that were never bonded and cut faces.
constexpr Colour grey{205, 205, 205};

CornerColours colours_of(const SolidTriangle& triangle, const std::string& by, const std::pair<double, double>& range) {
  if (by == "grain" || by == "plain") {
    const Colour colour = by == "plain" ? grey : grain_colour(triangle.grain);
    return {colour, colour, colour};
  }
  CornerColours colours;
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = triangle.corner[c].value;
    colours[c] = std::isnan(value) ? grey : scale_colour((value - range.first) / (range.second - range.first));
  }
  return colours;
}

std::string title_of(const Snapshot& snapshot) {
  std::string title;
  if (snapshot.relative_density > 0) title = fmt::format("Relative density {:.3f}", snapshot.relative_density);
  if (snapshot.name != "packing") title += fmt::format(", mean stress {:.3g} MPa", snapshot.mean_stress);
  return title;
}

bool lies_in(const CutAway& away, const Eigen::Vector3d& x) {
  return std::all_of(away.begin(), away.end(),
                     [&](const HalfSpace& half_space) { return half_space.normal.dot(x) < half_space.offset; });
}

} // namespace

const std::vector<std::string>& colour_names() {
  static const std::vector<std::string> names = {"von-mises", "plastic-strain", "pressure", "damage", "grain", "plain"};
  return names;
}

const std::vector<std::string>& cut_names() {
  static const std::vector<std::string> names = {"octant", "x", "y", "z", "none"};
  return names;
}

Eigen::Vector3d towards_camera(const std::array<double, 2>& angles) {
  const double azimuth = angles[0] * M_PI / 180, elevation = angles[1] * M_PI / 180;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

CutAway cut_away(const Snapshot& snapshot, const SceneRequest& request) {
  const Eigen::Vector3d low = vector_of(snapshot.box_low), high = vector_of(snapshot.box_high);
  const Eigen::Vector3d at = low + request.cut_at * (high - low), camera = towards_camera(request.camera);
  CutAway away;
  for (int axis = 0; axis < 3; ++axis) {
    if (request.cut != "octant" && request.cut != std::string(1, static_cast<char>('x' + axis))) continue;
    const double side = camera[axis] < 0 ? 1 : -1; // below the plane for a camera below the box
    away.push_back({side * Eigen::Vector3d::Unit(axis), side * at[axis]});
  }
  return away;
}

CutAway tool_cut_away(const Snapshot& snapshot, const SceneRequest& request) {
  const Eigen::Vector3d camera = towards_camera(request.camera);
  SceneRequest of_tools = request;
  if (request.cut == "none") of_tools.cut = std::string(1, std::abs(camera[0]) > std::abs(camera[1]) ? 'x' : 'y');
  CutAway away = cut_away(snapshot, of_tools);
  if (request.cut == "octant") away.pop_back(); // the half-space along z
  // Slightly more of the tools than of the grains is cut, so that grains are seen where both overlap (penalty contact).
  const Eigen::Vector3d box = vector_of(snapshot.box_high) - vector_of(snapshot.box_low);
  for (HalfSpace& half_space : away) half_space.offset += 1e-3 * box.maxCoeff();
  return away;
}

namespace {

/// Radius (mm) of the thinnest rod that can be seen well.
double thin_radius(const Snapshot& snapshot) {
  return 0.006 * (vector_of(snapshot.box_high) - vector_of(snapshot.box_low)).minCoeff();
}

} // namespace

Colour rod_colour(RodKind kind) {
  return kind == RodKind::intact    ? Colour{0, 115, 179}
         : kind == RodKind::damaged ? Colour{240, 227, 66}
         : kind == RodKind::broken  ? Colour{214, 94, 0}
                                    : Colour{158, 158, 158};
}

std::vector<KeyEntry> bond_key() {
  return {{rod_colour(RodKind::intact), "intact bond"},
          {rod_colour(RodKind::damaged), "more than half broken"},
          {rod_colour(RodKind::broken), "broken"}};
}

std::vector<KeyEntry> contact_key() {
  return {{rod_colour(RodKind::contact), "contact, thickness by force"}};
}

std::vector<PairRod> contact_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away) {
  namespace run = schema::run;
  const auto grains = file.read(run::snapshots_pair_grains, snapshot.name);
  const auto force = file.read(run::snapshots_pair_force, snapshot.name);
  const std::vector<Eigen::Vector3d> centre = grain_centres(snapshot);
  std::vector<double> size;
  for (std::size_t p = 0; 3 * p < force.size(); ++p)
    size.push_back(Eigen::Vector3d(force[3 * p], force[3 * p + 1], force[3 * p + 2]).norm());
  const double largest = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  std::vector<PairRod> rods;
  for (std::size_t p = 0; p < size.size(); ++p) {
    const auto first = static_cast<std::size_t>(grains[2 * p]), second = static_cast<std::size_t>(grains[2 * p + 1]);
    if (!(size[p] > 0) || !lies_in(away, 0.5 * (centre[first] + centre[second]))) continue;
    const double share = std::sqrt(size[p] / largest);
    rods.push_back({centre[first], centre[second], thin_radius(snapshot) * (0.2 + 2.3 * share), RodKind::contact});
  }
  return rods;
}

std::vector<PairRod> bond_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away) {
  namespace run = schema::run;
  if (!file.has(run::snapshots_pair_damage, snapshot.name))
    throw InputError(fmt::format("{}: --bonds: the run has no bonds", one_line(file.path())));
  const auto grains = file.read(run::snapshots_pair_grains, snapshot.name);
  const auto damage = file.read(run::snapshots_pair_damage, snapshot.name);
  const auto area = file.read(run::snapshots_pair_bonded_area, snapshot.name);
  const std::vector<Eigen::Vector3d> centre = grain_centres(snapshot);
  const double thin = thin_radius(snapshot);
  std::vector<PairRod> rods;
  for (std::size_t p = 0; p < damage.size(); ++p) {
    const auto first = static_cast<std::size_t>(grains[2 * p]), second = static_cast<std::size_t>(grains[2 * p + 1]);
    if (damage[p] < 0 || !lies_in(away, 0.5 * (centre[first] + centre[second]))) continue; // < 0: never bonded
    const RodKind kind = !(area[p] > 0) ? RodKind::broken : damage[p] > 0.5 ? RodKind::damaged : RodKind::intact;
    rods.push_back({centre[first], centre[second], std::max(thin, std::sqrt(0.1 * area[p] / M_PI)), kind});
  }
  return rods;
}

std::pair<double, double> range_of(const std::vector<SolidTriangle>& triangles, const ShownField& field) {
  if (field.name == "damage" || field.name == "grain") return {0, 1};
  std::vector<std::pair<double, double>> value_and_area;
  for (const SolidTriangle& t : triangles)
    for (const SolidVertex& vertex : t.corner) value_and_area.emplace_back(vertex.value, area(t) / 3);
  return colour_range(std::move(value_and_area));
}

namespace {

/// Light steel, cut faces a little darker.
CornerColours tool_colours(const SolidTriangle& triangle) {
  constexpr Colour surface{222, 226, 231}, cut{186, 192, 199};
  const Colour& colour = triangle.face == 0 ? surface : cut;
  return {colour, colour, colour};
}

void add_tools(PictureScene& scene, const Snapshot& snapshot, const SceneRequest& request) {
  if (!request.tools || snapshot.tools.empty()) return;
  const DrawnExtent extent = drawn_extent(snapshot);
  const std::int32_t first = 1 + *std::max_element(snapshot.tet_grain.begin(), snapshot.tet_grain.end());
  for (SolidTriangle t : tool_surface(tool_bodies(snapshot, extent), extent, tool_cut_away(snapshot, request))) {
    t.grain += first;
    scene.triangles.push_back(t);
    scene.colours.push_back(tool_colours(t));
  }
}

/// The triangles of the grains whose centres do not lie in `away`.
std::vector<SolidTriangle> without_grains_in(const CutAway& away, std::vector<SolidTriangle> triangles,
                                             const Snapshot& snapshot) {
  if (away.empty()) return triangles;
  const std::vector<Eigen::Vector3d> centre = grain_centres(snapshot);
  std::erase_if(triangles,
                [&](const SolidTriangle& t) { return lies_in(away, centre[static_cast<std::size_t>(t.grain)]); });
  return triangles;
}

} // namespace

PictureScene make_scene(const Snapshot& snapshot, const SceneRequest& request) {
  const ShownField field = shown_field(snapshot, field_of(request.colour));
  PictureScene scene;
  const CutAway away = cut_away(snapshot, request);
  scene.triangles = field.name == "damage" ? without_grains_in(away, cut_solid(snapshot, field, {}), snapshot)
                                           : cut_solid(snapshot, field, away);
  if (scene.triangles.empty())
    throw InputError(fmt::format("--cut {}: the cut at --cut-at {} removes all grains", request.cut, request.cut_at));
  const auto range = request.range.value_or(range_of(scene.triangles, field));
  scene.colours.reserve(scene.triangles.size());
  for (const SolidTriangle& t : scene.triangles) scene.colours.push_back(colours_of(t, request.colour, range));
  scene.first_of_tools = scene.triangles.size();
  add_tools(scene, snapshot, request);
  scene.box_low = vector_of(snapshot.box_low);
  scene.box_high = vector_of(snapshot.box_high);
  scene.camera = request.camera;
  scene.title = request.title.empty() ? title_of(snapshot) : request.title;
  const Eigen::Vector3d box = scene.box_high - scene.box_low;
  scene.note = fmt::format("box {:.3g} × {:.3g} × {:.3g} mm", box[0], box[1], box[2]);
  if (field.name == "grain") return scene;
  scene.bar = ColourBar{range, with_unit(field_label(field.name), field.unit)};
  for (std::size_t t = 0; t < scene.first_of_tools; ++t)
    for (const SolidVertex& vertex : scene.triangles[t].corner) scene.bar->add(vertex.value);
  return scene;
}

ShownBox bounds_of(const PictureScene& scene) {
  const Eigen::Vector3d beyond = 0.3 * (scene.box_high - scene.box_low);
  const Eigen::Vector3d lowest = scene.box_low - beyond, highest = scene.box_high + beyond;
  ShownBox bounds{scene.box_low, scene.box_high};
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    for (const SolidVertex& vertex : scene.triangles[t].corner) {
      const bool all = t >= scene.first_of_tools;
      bounds.low = bounds.low.cwiseMin(all ? vertex.position : vertex.position.cwiseMax(lowest));
      bounds.high = bounds.high.cwiseMax(all ? vertex.position : vertex.position.cwiseMin(highest));
    }
  return bounds;
}

ShownBox united(const ShownBox& a, const ShownBox& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

} // namespace mpfem
