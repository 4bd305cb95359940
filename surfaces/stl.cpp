#include "surfaces/stl.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/text_input.hpp"
#include "surfaces/flip_slivers.hpp"
#include "surfaces/stl_facets.hpp"
#include "surfaces/weld_corners.hpp"

namespace mpfem {

namespace {

constexpr std::size_t most_bytes = std::size_t{512} << 20U; // ten million triangles in binary form
constexpr double farthest = 1e9;                            // mm; keeps products of lengths in the range of doubles
constexpr double weld_share = 1e-6;                         // of the box's diagonal; 32-bit numbers are exact to 6e-8
constexpr double sliver_share = 1e-12;                      // of the diagonal squared: smallest area of a triangle

using Corners = std::array<Vector3<double>, 3>;

std::string place(const Vector3<double>& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) mm", x.x, x.y, x.z);
}

/// Shared data of the checks.
struct Checked {
  TriangleMesh& mesh;
  std::vector<std::int32_t>& partner;
  const std::vector<std::size_t>& number; ///< [triangles], from 1: in the file
  const std::string& name;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}", shown_path(name), message));
  }
  std::string place_of_edge(std::int32_t edge) const {
    const auto t = static_cast<std::size_t>(edge / 3), k = static_cast<std::size_t>(edge % 3);
    return fmt::format("of triangle {} from {} to {}", number[t], place(mesh.corner(t, k)),
                       place(mesh.corner(t, (k + 1) % 3)));
  }
};

std::vector<Corners> scaled_corners(const std::vector<StlFacet>& facets, const std::string& name, double scale) {
  std::vector<Corners> corners;
  corners.reserve(facets.size());
  for (const StlFacet& facet : facets) {
    Corners scaled{};
    for (std::size_t k = 0; k < 3; ++k) {
      scaled[k] = scale * facet.corner[k];
      const Vector3<double>& x = scaled[k];
      if (!(std::fmax(std::abs(x.x), std::fmax(std::abs(x.y), std::abs(x.z))) <= farthest))
        throw InputError(fmt::format("{}: triangle {}: found a corner at {} with the scale {}, allowed: up to {} mm",
                                     shown_path(name), corners.size() + 1, place(x), scale, farthest));
    }
    corners.push_back(scaled);
  }
  return corners;
}

/// Diagonal (mm) of the box around all corners. Throws InputError where it is too short.
double diagonal_of(const std::vector<Corners>& corners, const std::string& name) {
  TriangleMesh all;
  for (const Corners& three : corners) all.vertex.insert(all.vertex.end(), three.begin(), three.end());
  const double length = diagonal(bounds_of(all));
  if (!(length >= 1 / farthest))
    throw InputError(fmt::format("{}: found a largest extent of {} mm, allowed: at least {} mm", shown_path(name),
                                 length, 1 / farthest));
  return length;
}

/// True if a stored normal is more than 60 degrees off the triangle's own; false where it is zero or not finite.
bool is_other_normal(const Vector3<double>& stored, const Corners& x) {
  const Vector3<double> own = area_vector(x[0], x[1], x[2]);
  const double length = norm(stored);
  if (!(length > 0 && std::isfinite(length))) return false;
  constexpr double cosine = 0.5; // far more than rounding causes, except for slivers
  return dot(stored, own) < cosine * length * norm(own);
}

std::size_t count_other_normals(const std::vector<StlFacet>& facets) {
  return static_cast<std::size_t>(std::count_if(
      facets.begin(), facets.end(), [](const StlFacet& facet) { return is_other_normal(facet.normal, facet.corner); }));
}

/// Leaves out triangles with two corners at one vertex. Their other two edges coincide, so that no hole remains.
/// Returns the numbers in the file of those that are left.
std::vector<std::size_t> drop_collapsed(TriangleMesh& mesh) {
  std::vector<std::size_t> number;
  const auto is_collapsed = [](const auto& v) { return v[0] == v[1] || v[1] == v[2] || v[2] == v[0]; };
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    if (!is_collapsed(mesh.triangle[t])) number.push_back(t + 1);
  std::erase_if(mesh.triangle, is_collapsed);
  return number;
}

void check_closed(const Checked& surface, const EdgePairs& pairs) {
  for (const auto& [fault, what] :
       {std::pair(pairs.open, "belong to one triangle only"),
        std::pair(pairs.non_manifold, "belong to more than two triangles"),
        std::pair(pairs.misoriented, "have two triangles that run along them the same way")})
    if (fault.count > 0)
      surface.fail(fmt::format("the surface is not closed and oriented: found {} edges that {}, one {}, allowed: two "
                               "triangles at every edge, in opposite directions",
                               fault.count, what, surface.place_of_edge(fault.example)));
}

std::size_t flip_all_slivers(const Checked& surface, double length) {
  const SliverFlips slivers = flip_slivers(surface.mesh, surface.partner, sliver_share * length * length);
  if (slivers.left > 0) {
    const auto example = static_cast<std::size_t>(slivers.example);
    surface.fail(fmt::format("found {} triangles without area, one is triangle {} at {}, allowed: from {:.3g} mm^2",
                             slivers.left, surface.number[example], place(surface.mesh.corner(example, 0)),
                             sliver_share * length * length));
  }
  // Two edges may now coincide.
  if (slivers.flipped > 0) check_closed(surface, pair_edges(surface.mesh));
  return slivers.flipped;
}

double volume_of(const TriangleMesh& mesh, std::span<const std::size_t> triangles) {
  double volume = 0;
  for (const std::size_t t : triangles) volume += volume_share(mesh, t, mesh.vertex.front());
  return volume;
}

std::vector<std::vector<std::size_t>> triangles_of_shells(const std::vector<std::int32_t>& partner) {
  std::vector<std::vector<std::size_t>> result;
  const std::vector<std::int32_t> shell = shells(partner);
  for (std::size_t t = 0; t < shell.size(); ++t) {
    result.resize(std::max(result.size(), static_cast<std::size_t>(shell[t]) + 1));
    result[static_cast<std::size_t>(shell[t])].push_back(t);
  }
  return result;
}

/// A shell of positive volume must lie in no other shell, or in a cavity. One of negative volume is a cavity and must
/// lie in a body.
void check_nesting(const Checked& surface, std::span<const std::vector<std::size_t>> shell) {
  for (std::size_t s = 0; shell.size() > 1 && s < shell.size(); ++s) {
    const Vector3<double>& x = surface.mesh.corner(shell[s].front(), 0);
    double winding = 0;
    for (std::size_t other = 0; other < shell.size(); ++other)
      for (const std::size_t t : shell[other])
        if (other != s) winding += winding_share(surface.mesh, t, x);
    const bool is_cavity = volume_of(surface.mesh, shell[s]) < 0;
    constexpr double slack = 0.75; // where shells touch, the winding number is not whole
    if (std::abs(winding - (is_cavity ? 1 : 0)) > slack)
      surface.fail(fmt::format(
          "found {} shells of which the one of triangle {} at {} {}, allowed: bodies side by side, and cavities in "
          "them",
          shell.size(), surface.number[shell[s].front()], place(x),
          is_cavity ? "is turned inside out" : "lies in another one or runs through it"));
  }
}

void turn_round(TriangleMesh& mesh) {
  for (auto& triangle : mesh.triangle) std::swap(triangle[1], triangle[2]);
}

/// Leaves out vertices that no triangle uses.
void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::int32_t> number(mesh.vertex.size(), -1);
  std::vector<Vector3<double>> used;
  for (auto& triangle : mesh.triangle)
    for (std::int32_t& v : triangle) {
      auto& found = number[static_cast<std::size_t>(v)];
      if (found < 0) {
        found = static_cast<std::int32_t>(used.size());
        used.push_back(mesh.vertex[static_cast<std::size_t>(v)]);
      }
      v = found;
    }
  mesh.vertex = std::move(used);
}

/// Sets volume and shells; turns the surface round where its volume is negative.
void check_volume(const Checked& surface, double length, StlFindings& findings) {
  const auto shell = triangles_of_shells(surface.partner);
  double volume = 0;
  for (const auto& triangles : shell) volume += volume_of(surface.mesh, triangles);
  if (!(std::abs(volume) > sliver_share * length * length * length))
    surface.fail(fmt::format("the surface encloses {:.3g} mm^3, allowed: a body with a volume", volume));
  findings.turned = volume < 0;
  if (findings.turned) turn_round(surface.mesh);
  check_nesting(surface, shell);
  findings.volume = std::abs(volume);
  findings.shells = shell.size();
}

} // namespace

StlBody stl_body(std::string_view bytes, const std::string& name, double scale) {
  const StlFacets file = read_stl_facets(bytes, name);
  const std::vector<Corners> corners = scaled_corners(file.facet, name, scale);
  const double length = diagonal_of(corners, name);
  StlBody body{weld_corners(corners, weld_share * length), {}};
  StlFindings& findings = body.findings;
  findings.binary = file.binary;
  findings.other_normals = count_other_normals(file.facet);
  const std::vector<std::size_t> number = drop_collapsed(body.mesh);
  findings.dropped = file.facet.size() - number.size();
  EdgePairs pairs = pair_edges(body.mesh);
  const Checked surface{body.mesh, pairs.partner, number, name};
  check_closed(surface, pairs);
  findings.flipped = flip_all_slivers(surface, length);
  check_volume(surface, length, findings);
  drop_unused_vertices(body.mesh);
  findings.triangles = body.mesh.triangle.size();
  findings.vertices = body.mesh.vertex.size();
  findings.bounds = bounds_of(body.mesh);
  return body;
}

StlBody read_stl(const std::string& path, double scale) {
  return stl_body(read_text_file(path, most_bytes), path, scale);
}

std::string describe(const StlFindings& f) {
  std::string text = fmt::format(
      "{} triangles, {} vertices, {} {}, {:.6g} x {:.6g} x {:.6g} mm from ({:.6g}, {:.6g}, {:.6g}), {:.6g} mm^3",
      f.triangles, f.vertices, f.shells, f.shells == 1 ? "shell" : "shells", f.bounds.high[0] - f.bounds.low[0],
      f.bounds.high[1] - f.bounds.low[1], f.bounds.high[2] - f.bounds.low[2], f.bounds.low[0], f.bounds.low[1],
      f.bounds.low[2], f.volume);
  if (f.turned) text += ", was inside out";
  if (f.dropped > 0) text += fmt::format(", {} triangles without area left out", f.dropped);
  if (f.flipped > 0) text += fmt::format(", {} edges flipped at triangles without area", f.flipped);
  if (f.other_normals > 0) text += fmt::format(", {} stored normals that point elsewhere (ignored)", f.other_normals);
  return text;
}

} // namespace mpfem
