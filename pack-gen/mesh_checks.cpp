#include "pack-gen/mesh_checks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "common/tet_boundary.hpp"
#include "solver/physics/elasticity.hpp"
#include "solver/physics/stable_step.hpp"

namespace mpfem {

namespace {

Vector3<double> edge(const Point& from, const Point& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

double norm(const Vector3<double>& v) {
  return std::sqrt(dot(v, v));
}

} // namespace

double StepMaterial::wave_speed() const {
  return std::sqrt(elastic_moduli(youngs_modulus, poissons_ratio).dilatational() / density);
}

double tet_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(edge(a, b), cross(edge(a, c), edge(a, d))) / 6;
}

double mesh_volume(const TetMesh& mesh) {
  double volume = 0;
  for (const Tet& t : mesh.tet) {
    const auto at = [&](std::size_t k) { return mesh.node[static_cast<std::size_t>(t[k])]; };
    volume += tet_volume(at(0), at(1), at(2), at(3));
  }
  return volume;
}

double tet_quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto ab = edge(a, b), ac = edge(a, c), ad = edge(a, d);
  const auto bc = edge(b, c), bd = edge(b, d), cd = edge(c, d);
  const double six_volumes = dot(ab, cross(ac, ad));
  const double twice_area = norm(cross(ab, ac)) + norm(cross(ab, ad)) + norm(cross(ac, ad)) + norm(cross(bc, bd));
  // Circumradius of a tetrahedron from the products of opposite edges (Crelle).
  const double p = norm(ab) * norm(cd), q = norm(ac) * norm(bd), r = norm(ad) * norm(bc);
  const double product = (p + q + r) * (p + q - r) * (p - q + r) * (-p + q + r);
  if (!(product > 0) || !(twice_area > 0)) return 0;
  const double inradius = six_volumes / twice_area, circumradius = std::sqrt(product) / (4 * std::abs(six_volumes));
  return 3 * inradius / circumradius;
}

double critical_step(const Point& a, const Point& b, const Point& c, const Point& d, const StepMaterial& material) {
  const auto geometry = tet_geometry(edge(a, b), edge(a, c), edge(a, d));
  const ElasticModuli moduli = elastic_moduli(material.youngs_modulus, material.poissons_ratio);
  return 2 / std::sqrt(largest_frequency_squared(moduli, material.density, geometry));
}

std::vector<Facet> boundary_facets(const std::vector<Tet>& tet) {
  std::vector<std::int32_t> node;
  node.reserve(4 * tet.size());
  for (const Tet& t : tet) node.insert(node.end(), t.begin(), t.end());
  const auto [boundary, crowded] = tet_boundary(node);
  if (crowded) throw std::logic_error("three tetrahedra share a facet");
  return boundary;
}

bool is_closed_sphere(const std::vector<Facet>& facet) {
  std::vector<std::array<std::int32_t, 2>> edges;
  std::set<std::int32_t> nodes;
  for (const Facet& f : facet)
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back({f[k], f[(k + 1) % 3]});
      nodes.insert(f[k]);
    }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  for (const auto& e : edges)
    if (!std::binary_search(edges.begin(), edges.end(), std::array<std::int32_t, 2>{e[1], e[0]})) return false;
  return nodes.size() + facet.size() == edges.size() / 2 + 2;
}

std::string ball_defect(const TetMesh& mesh) {
  std::vector<char> used(mesh.node.size(), 0);
  for (std::size_t i = 0; i < mesh.tet.size(); ++i) {
    const Tet& t = mesh.tet[i];
    const auto at = [&](std::size_t k) { return mesh.node[static_cast<std::size_t>(t[k])]; };
    for (const std::int32_t n : t) used[static_cast<std::size_t>(n)] = 1;
    if (!(tet_volume(at(0), at(1), at(2), at(3)) > 0))
      return fmt::format("tetrahedron {} without positive volume (nodes {} {} {} {})", i, t[0], t[1], t[2], t[3]);
  }
  if (std::find(used.begin(), used.end(), 0) != used.end()) return "a node outside every tetrahedron";
  try {
    if (!is_closed_sphere(boundary_facets(mesh.tet))) return "a surface that is not one closed sphere";
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}

} // namespace mpfem
