#include "solver/model/smooth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "solver/model/normals.hpp"
#include "solver/parallel/grain_values.hpp"

namespace mpfem {

namespace {

/// Largest share of the inner node in a contact point: more would no longer be a small correction.
constexpr double largest_share = 0.25;
/// Least cosine between the normal and the direction to the inner node: a node with no other node so straight beneath
/// it keeps its place.
constexpr double least_cosine = 0.5;

/// Height of the smooth surface above the facets around each surface node of a grain, averaged by area, mm.
std::vector<double> heights(const Model& model, const SurfaceNormals& normals, std::size_t grain) {
  const auto first = static_cast<std::size_t>(model.node_offset[grain]);
  std::vector<double> height(static_cast<std::size_t>(model.surface_node_count[grain]), 0.0);
  for (auto f = 3 * static_cast<std::size_t>(model.facet_offset[grain]);
       f < 3 * static_cast<std::size_t>(model.facet_offset[grain + 1]); f += 3) {
    std::size_t node[3];
    Vector3<double> x[3];
    for (std::size_t c = 0; c < 3; ++c) {
      node[c] = static_cast<std::size_t>(model.facet[f + c]);
      x[c] = model.point(node[c]);
    }
    double of_facet = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      of_facet += dot(normals.normal(node[j]) - normals.normal(node[i]), x[j] - x[i]) / 24.0;
    }
    const double third = norm(cross(x[1] - x[0], x[2] - x[0])) / 6.0; // of its area: the share of a node
    for (const std::size_t n : node) height[n - first] += third * of_facet / model.reference_area[n];
  }
  return height;
}

/// True if a grain is the mesh of this sphere: it has the same volume, and its surface nodes are near the sphere.
bool is_sphere_of_that_volume(const Model& model, std::size_t grain, const Vector3<double>& center, double radius) {
  constexpr double same_volume = 1e-6; // rounding; a sphere with its nodes on it lacks 1e-3 and more
  constexpr double round = 0.1;        // nodes of the coarsest useful mesh are less far outside
  const double sphere = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  if (!(std::abs(model.reference_volume[grain] - sphere) <= same_volume * sphere)) return false; // nor NaN
  const auto first = static_cast<std::size_t>(model.node_offset[grain]);
  for (std::size_t n = first; n < first + static_cast<std::size_t>(model.surface_node_count[grain]); ++n)
    if (!(std::abs(norm(model.point(n) - center) - radius) <= round * radius)) return false;
  return true;
}

/// Chooses for each surface node of a grain the node of its tets that lies straightest beneath it, and sets how far its
/// contact point lies towards that node: `height` [surface nodes], mm, along the normal.
void place_contact_points(Model& model, const SurfaceNormals& normals, std::size_t grain,
                          const std::vector<double>& height) {
  const auto first = static_cast<std::size_t>(model.node_offset[grain]),
             count = static_cast<std::size_t>(model.surface_node_count[grain]);
  std::vector<double> cosine(count, 0.0); // between the normal and the direction to the inner node, reversed
  for (std::int32_t t = 0; t < model.tet_offset[grain + 1] - model.tet_offset[grain]; ++t) {
    const auto corner = model.nodes_of_tet(static_cast<int>(grain), t);
    for (const std::int32_t a : corner)
      for (const std::int32_t b : corner) {
        if (static_cast<std::size_t>(a) >= count || a == b) continue;
        const std::size_t n = first + static_cast<std::size_t>(a), inner = first + static_cast<std::size_t>(b);
        const Vector3<double> edge = model.point(n) - model.point(inner);
        const double along = dot(edge, normals.normal(n)) / norm(edge);
        if (along > cosine[n - first])
          cosine[n - first] = along, model.inner_node[n] = static_cast<std::int32_t>(inner);
      }
  }
  for (std::size_t n = first; n < first + count; ++n) {
    if (cosine[n - first] < least_cosine) continue;
    const double edge = norm(model.point(n) - model.point(static_cast<std::size_t>(model.inner_node[n])));
    model.inward[n] = std::clamp(height[n - first] / (cosine[n - first] * edge), 0.0, largest_share);
  }
}

} // namespace

std::vector<char> smooth_grains(const Model& model, const MeshedPacking& packing, ContactSurface surface,
                                const Communicator& ranks) {
  std::vector<char> smooth(static_cast<std::size_t>(model.grains), surface == ContactSurface::smooth ? 1 : 0);
  if (surface != ContactSurface::automatic || packing.sphere_radius.empty()) return smooth;
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    const Vector3<double> center = vector_of(&packing.sphere_center[3 * g]);
    smooth[g] = is_sphere_of_that_volume(model, g, center, packing.sphere_radius[g]) ? 1 : 0;
  }
  share_of_grains(ranks, model.ownership, std::span(smooth));
  return smooth;
}

void find_smooth_surface(Model& model, const std::vector<char>& grains) {
  model.smooth_grains = static_cast<int>(std::count(grains.begin(), grains.end(), char{1}));
  if (model.smooth_grains == 0) return;
  const auto nodes = static_cast<std::size_t>(model.nodes());
  model.inner_node = LazyArray<std::int32_t>(nodes, model.pages());
  model.inward = LazyArray<double>(nodes, model.pages());
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    std::iota(model.inner_node.data() + model.node_offset[g], model.inner_node.data() + model.node_offset[g + 1],
              model.node_offset[g]);
    if (!grains[g]) continue;
    const SurfaceNormals normals(model, grain);
    place_contact_points(model, normals, g, heights(model, normals, g));
  }
}

double max_contact_offset(const Model& model) {
  double largest = 0;
  if (model.inner_node.empty()) return largest;
  for (const std::int32_t g : model.own())
    for (std::size_t n = model.first_node(g); n < model.end_node(g); ++n)
      if (model.inward[n] > 0) largest = std::max(largest, norm(model.point(n) - model.contact_point(n)));
  return largest;
}

} // namespace mpfem
