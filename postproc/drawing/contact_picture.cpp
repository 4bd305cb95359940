#include "postproc/drawing/contact_picture.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/drawing/raster_picture.hpp"
#include "postproc/run_data/surface_facets.hpp"

namespace mpfem {

namespace {

using Point = std::array<double, 2>;

/// Grain of the side that is drawn.
std::int32_t drawn_side(const ContactMap& map) {
  const auto of_first = std::count_if(map.bonds.begin(), map.bonds.end(),
                                      [&](const ContactBond& b) { return b.grain == map.grains.first; });
  return 2 * of_first >= static_cast<std::ptrdiff_t>(map.bonds.size()) ? map.grains.first : map.grains.second;
}

/// A square around the patches, with a margin: both axes have the same scale, and no contact is drawn as a sliver.
View square_around(const std::vector<SectionPolygon>& patches) {
  Point low = {1e300, 1e300}, high = {-1e300, -1e300};
  for (const SectionPolygon& patch : patches)
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.corners); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        low[k] = std::min(low[k], patch.corner[i][k]), high[k] = std::max(high[k], patch.corner[i][k]);
  constexpr double margin = 0.06;
  const double half = (0.5 + margin) * std::max(high[0] - low[0], high[1] - low[1]);
  View view;
  for (std::size_t k = 0; k < 2; ++k) {
    const double middle = 0.5 * (low[k] + high[k]);
    view.low[k] = middle - half, view.high[k] = middle + half;
  }
  return view;
}

} // namespace

std::vector<SectionPolygon> contact_patches(const Snapshot& snapshot, const ContactMap& map) {
  const std::int32_t grain = drawn_side(map);
  std::map<std::int32_t, std::int32_t> bond_of_node;
  for (std::size_t b = 0; b < map.bonds.size(); ++b)
    if (map.bonds[b].grain == grain) bond_of_node[map.bonds[b].node] = static_cast<std::int32_t>(b);
  const auto point = [&](std::int32_t node) {
    std::array<double, 3> x{};
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = static_cast<double>(snapshot.node[3 * static_cast<std::size_t>(node) + k]);
    const auto position = in_plane(map.plane, x);
    return Point{position[0], position[1]};
  };
  const auto middle = [](const Point& a, const Point& b) { return Point{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; };
  std::vector<SectionPolygon> patches;
  for (const SurfaceFacet& facet : surface_facets(snapshot, tets_of_grain(snapshot, grain))) {
    const std::array<Point, 3> p = {point(facet.node[0]), point(facet.node[1]), point(facet.node[2])};
    const Point centroid = {(p[0][0] + p[1][0] + p[2][0]) / 3, (p[0][1] + p[1][1] + p[2][1]) / 3};
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto bond = bond_of_node.find(facet.node[i]); bond != bond_of_node.end())
        patches.push_back(
            {4, {p[i], middle(p[i], p[(i + 1) % 3]), centroid, middle(p[i], p[(i + 2) % 3])}, bond->second});
  }
  return patches;
}

void write_contact_picture(const std::string& path, const Snapshot& snapshot, const ContactMap& map,
                           const ContactPictureRequest& request) {
  const std::vector<SectionPolygon> patches = contact_patches(snapshot, map);
  if (patches.empty())
    throw InputError(
        fmt::format("grains {} and {} touch in snapshot {} but never had a bond, allowed: a pair with bonds",
                    map.grains.first, map.grains.second, map.snapshot));
  const View view = square_around(patches);
  std::vector<Colour> colour;
  for (const ContactBond& bond : map.bonds) colour.push_back(scale_colour(bond.damage));
  std::vector<std::int32_t> outlined(map.bonds.size(), 0); // one outline around all patches, or one around each
  if (request.mesh_lines) std::iota(outlined.begin(), outlined.end(), 0);
  const Raster raster = draw_section(patches, colour, outlined, view, request.pixels);
  Frame2d frame{
      view,          request.title, "u (mm)", "v (mm)", ColourBar{{0, 1}, "Damage of bonds (0 intact, 1 broken)"},
      request.pixels};
  if (frame.title.empty())
    frame.title = fmt::format("Contact of grains {} and {}, nodes of grain {}, relative density {:.3f}",
                              map.grains.first, map.grains.second, drawn_side(map), map.relative_density);
  write_raster_picture(path, raster, frame);
}

} // namespace mpfem
