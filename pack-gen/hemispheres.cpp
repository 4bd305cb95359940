#include "pack-gen/hemispheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/convex_distance.hpp"
#include "pack-gen/mesh_checks.hpp"
#include "pack-gen/step_optimiser.hpp"

namespace mpfem {

namespace {

constexpr double most_tets = 2e7; // of one hemisphere

double norm(double x, double y, double z = 0) {
  return std::sqrt(x * x + y * y + z * z);
}

/// Element size at a point of the hemisphere z >= 0 about the origin.
double size_at(const HemisphereRequest& r, const Point& p) {
  const double from_centre = norm(p[0], p[1], p[2]);
  const double depth = r.radius - from_centre;
  const double along_face = r.radius * std::atan2(norm(p[0], p[1]), p[2]);
  const double from_patch = std::hypot(std::max(along_face - r.contact_radius, 0.0), depth);
  const double from_tip = norm(p[0], p[1], p[2] - r.radius);
  const double from_bulk = std::max(from_tip - 1.5 * r.contact_radius, 0.0);
  return std::min({r.size, r.contact_size + r.growth * from_patch, r.bulk_size + r.growth * from_bulk});
}

/// Number of tets that these sizes will give: mean volume h^3/11.05, integrated over rings of the hemisphere.
double expected_tets(const HemisphereRequest& r) {
  constexpr int rings = 200;
  double tets = 0;
  // Fine steps near the tip, where sizes change: depth and distance along the face grow geometrically.
  double before_depth = 0;
  for (int i = 0; i < rings; ++i) {
    const double depth = r.radius * std::pow(1e-5, 1.0 - (i + 1.0) / rings);
    double before_arc = 0;
    for (int j = 0; j < rings; ++j) {
      const double arc = 0.5 * std::numbers::pi * r.radius * std::pow(1e-5, 1.0 - (j + 1.0) / rings);
      const double rho = r.radius - 0.5 * (depth + before_depth), angle = 0.5 * (arc + before_arc) / r.radius;
      const double ring =
          2 * std::numbers::pi * rho * std::sin(angle) * (rho * (arc - before_arc) / r.radius) * (depth - before_depth);
      tets += tets_per_cubed_size * ring / std::pow(size_at(r, {rho * std::sin(angle), 0, rho * std::cos(angle)}), 3);
      before_arc = arc;
    }
    before_depth = depth;
  }
  return tets;
}

void check(const HemisphereRequest& r) {
  const auto refuse = [](const char* option, double found, const std::string& allowed) {
    throw InputError(fmt::format("{}: found {:g}, allowed: {}", option, found, allowed));
  };
  if (!(r.size <= 0.5 * r.radius))
    refuse("--size", r.size, fmt::format("at most half of the radius, {:g} mm", 0.5 * r.radius));
  if (!(r.contact_size <= r.size))
    refuse("--contact-size", r.contact_size, fmt::format("at most --size, {:g} mm", r.size));
  if (!(r.bulk_size >= r.contact_size && r.bulk_size <= r.size))
    refuse("--bulk-size", r.bulk_size,
           fmt::format("{:g} mm (--contact-size) to {:g} mm (--size)", r.contact_size, r.size));
  if (!(r.contact_radius <= r.radius))
    refuse("--contact-radius", r.contact_radius, fmt::format("at most the radius, {:g} mm", r.radius));
  if (!(r.contact_size <= r.contact_radius))
    refuse("--contact-size", r.contact_size, fmt::format("at most --contact-radius, {:g} mm", r.contact_radius));
  if (!(r.growth >= 0.01 && r.growth <= 1)) refuse("--growth", r.growth, "0.01 to 1");
  if (r.box_width != 0 && !(r.box_width >= 2 * r.radius))
    refuse("--box-width", r.box_width, fmt::format("at least the diameter, {:g} mm", 2 * r.radius));
  if (std::fmod(r.rotation, 360) == 0) refuse("--rotate", r.rotation, "no whole turn: node would face node");
  if (!(r.gap <= r.radius)) refuse("--gap", r.gap, fmt::format("at most the radius, {:g} mm", r.radius));
  if (const double tets = expected_tets(r); tets > most_tets)
    throw InputError(fmt::format("these sizes would give {:.3g} tetrahedra per hemisphere, allowed: at most {:.3g}",
                                 tets, most_tets));
}

/// The lower hemisphere, with its worst tetrahedra improved. Surface nodes stay where gmsh put them: moving them would
/// raise the step further, but enlarge the triangles of the contact up to twofold.
TetMesh mesh_lower(const HemisphereRequest& r) {
  TetMesh mesh = gmsh_half_ball(1, [&](const Point& p) {
    return size_at(r, {r.radius * p[0], r.radius * p[1], r.radius * p[2]}) / r.radius;
  });
  std::vector<NodeFreedom> freedom;
  for (const Point& p : mesh.node)
    freedom.push_back(p[2] == 0 || std::abs(norm(p[0], p[1], p[2]) - 1) < 1e-12 ? NodeFreedom::fixed
                                                                                : NodeFreedom::everywhere);
  constexpr int sweeps = 60;
  constexpr double band = 1.3;
  raise_smallest_step(mesh, freedom, r.contact_size / r.radius, sweeps, band, 1);
  for (Point& p : mesh.node)
    for (double& x : p) x *= r.radius;
  if (const std::string defect = ball_defect(mesh); !defect.empty())
    throw SimulationError(fmt::format("optimising the mesh of the half-ball led to {}", defect));
  return mesh;
}

} // namespace

Hemispheres mesh_hemispheres(const HemisphereRequest& r) {
  check(r);
  const TetMesh lower = mesh_lower(r);
  const double height = 2 * r.radius + r.gap, middle = 0.5 * (r.box_width > 0 ? r.box_width : 2.4 * r.radius),
               angle = r.rotation * std::numbers::pi / 180;

  Hemispheres result;
  result.packing.box = {2 * middle, 2 * middle, height};
  result.packing.center = {{middle, middle, 0}, {middle, middle, height}};
  result.packing.radius = {r.radius, r.radius};
  PackingMesh& mesh = result.mesh;
  const auto nodes = static_cast<std::int32_t>(lower.node.size()), tets = static_cast<std::int32_t>(lower.tet.size());
  mesh.grain_node_offset = {0, nodes, 2 * nodes};
  mesh.grain_tet_offset = {0, tets, 2 * tets};
  for (const Point& p : lower.node) mesh.node.insert(mesh.node.end(), {middle + p[0], middle + p[1], p[2]});
  for (const Point& p : lower.node)
    mesh.node.insert(mesh.node.end(), {middle + std::cos(angle) * p[0] - std::sin(angle) * p[1],
                                       middle + std::sin(angle) * p[0] + std::cos(angle) * p[1], height - p[2]});
  for (const Tet& t : lower.tet) mesh.tet.insert(mesh.tet.end(), t.begin(), t.end());
  for (const Tet& t : lower.tet) // mirrored: two corners change places
    mesh.tet.insert(mesh.tet.end(), {nodes + t[0], nodes + t[1], nodes + t[3], nodes + t[2]});

  const Eigen::Map<const Eigen::Matrix3Xd> lower_node(mesh.node.data(), 3, nodes);
  const Eigen::Map<const Eigen::Matrix3Xd> upper_node(mesh.node.data() + 3 * nodes, 3, nodes);
  result.tip_gap = convex_distance(lower_node, upper_node, Eigen::Vector3d(0, 0, 1)).lower;
  if (!(result.tip_gap > 0))
    throw InputError(fmt::format("--gap: found {:g}, allowed: more, rounding leaves no gap at this radius", r.gap));
  return result;
}

Refinement refinement(const HemisphereRequest& r, const Hemispheres& pair) {
  Refinement result;
  result.smallest_edge = std::numeric_limits<double>::infinity();
  const std::vector<double>& node = pair.mesh.node;
  for (std::size_t e = 0; e < pair.mesh.tet.size(); e += 4) {
    const auto at = [&](std::size_t k) -> Point {
      const auto n = 3 * static_cast<std::size_t>(pair.mesh.tet[e + k]);
      return {node[n], node[n + 1], node[n + 2]};
    };
    Point middle{};
    for (std::size_t a = 0; a < 4; ++a) {
      const Point p = at(a);
      for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * p[k];
      for (std::size_t b = 0; b < a; ++b) {
        const Point q = at(b);
        result.smallest_edge = std::min(result.smallest_edge, norm(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    }
    // Both grains seen from their own centre, tip upward.
    const bool upper = e / 4 >= static_cast<std::size_t>(pair.mesh.grain_tet_offset[1]);
    const Point own{middle[0] - pair.packing.center[0][0], middle[1] - pair.packing.center[0][1],
                    upper ? pair.packing.box[2] - middle[2] : middle[2]};
    result.tets_near += size_at(r, own) < 2 * r.contact_size;
  }
  return result;
}

} // namespace mpfem
