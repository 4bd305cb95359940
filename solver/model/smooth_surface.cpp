#include "solver/model/smooth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "solver/kernels/surface.hpp"

namespace mpfem {

namespace {

/// What a contact point may take from the inner node: more would be no small correction any more.
constexpr double largest_share = 0.25;
/// Least cosine of the way to the inner node with the normal: a node that has none so straight beneath it stays as it is.
constexpr double least_cosine = 0.5;

Vector3<double> position(const Model& model, std::size_t node) {
  return {model.position[4 * node], model.position[4 * node + 1], model.position[4 * node + 2]};
}

Vector3<double> normal(const Model& model, std::size_t node) {
  return {model.normal[4 * node], model.normal[4 * node + 1], model.normal[4 * node + 2]};
}

/// Height of the smooth surface above the facets around each surface node, their mean by area, mm.
std::vector<double> heights(const Model& model) {
  std::vector<double> height(static_cast<std::size_t>(model.nodes()), 0.0);
  for (std::size_t f = 0; f < model.facet.size(); f += 3) {
    std::size_t node[3];
    Vector3<double> x[3];
    for (std::size_t c = 0; c < 3; ++c) {
      node[c] = static_cast<std::size_t>(model.facet[f + c]);
      x[c] = position(model, node[c]);
    }
    double of_facet = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      of_facet += dot(normal(model, node[j]) - normal(model, node[i]), x[j] - x[i]) / 24.0;
    }
    const double third = norm(cross(x[1] - x[0], x[2] - x[0])) / 6.0; // of its area, a node's share of it
    for (const std::size_t n : node) height[n] += third * of_facet / model.reference_area[n];
  }
  return height;
}

bool is_sphere_of_that_volume(const Model& model, std::size_t grain, const Vector3<double>& center, double radius) {
  constexpr double same_volume = 1e-6; // rounding; a sphere with its nodes on it lacks 1e-3 and more
  constexpr double round = 0.1;        // nodes of the coarsest useful mesh stand out by less
  const double sphere = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  if (!(std::abs(model.reference_volume[grain] - sphere) <= same_volume * sphere)) return false; // nor NaN
  const auto first = static_cast<std::size_t>(model.node_offset[grain]);
  for (std::size_t n = first; n < first + static_cast<std::size_t>(model.surface_node_count[grain]); ++n)
    if (!(std::abs(norm(position(model, n) - center) - radius) <= round * radius)) return false;
  return true;
}

} // namespace

std::vector<bool> smooth_grains(const Model& model, const MeshedPacking& packing, ContactSurface surface) {
  const auto grains = static_cast<std::size_t>(model.grains);
  std::vector<bool> smooth(grains, surface == ContactSurface::smooth);
  if (surface != ContactSurface::automatic || packing.sphere_radius.empty()) return smooth;
  for (std::size_t g = 0; g < grains; ++g) {
    const double* center = &packing.sphere_center[3 * g];
    smooth[g] = is_sphere_of_that_volume(model, g, {center[0], center[1], center[2]}, packing.sphere_radius[g]);
  }
  return smooth;
}

void find_smooth_surface(Model& model, const std::vector<bool>& grains) {
  model.smooth_grains = static_cast<int>(std::count(grains.begin(), grains.end(), true));
  if (model.smooth_grains == 0) return;
  for (int grain = 0; grain < model.grains; ++grain) update_surface(model, grain);
  const std::vector<double> height = heights(model);
  const auto nodes = static_cast<std::size_t>(model.nodes());
  model.inner_node.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) model.inner_node[n] = static_cast<std::int32_t>(n);
  model.inward.assign(nodes, 0.0);
  std::vector<double> cosine(nodes, 0.0); // with the inward normal, of the way to the inner node
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    if (!grains[g]) continue;
    const auto first = static_cast<std::size_t>(model.node_offset[g]),
               surface_end = first + static_cast<std::size_t>(model.surface_node_count[g]);
    for (std::int32_t t = 0; t < model.tet_offset[g + 1] - model.tet_offset[g]; ++t) {
      const auto corner = model.nodes_of_tet(grain, t);
      for (const std::int32_t a : corner)
        for (const std::int32_t b : corner) {
          const std::size_t n = first + static_cast<std::size_t>(a), inner = first + static_cast<std::size_t>(b);
          if (n >= surface_end || n == inner) continue;
          const Vector3<double> way = position(model, n) - position(model, inner);
          const double along = dot(way, normal(model, n)) / norm(way);
          if (along > cosine[n]) cosine[n] = along, model.inner_node[n] = static_cast<std::int32_t>(inner);
        }
    }
    for (std::size_t n = first; n < surface_end; ++n) {
      if (cosine[n] < least_cosine) continue;
      const double way = norm(position(model, n) - position(model, static_cast<std::size_t>(model.inner_node[n])));
      model.inward[n] = std::clamp(height[n] / (cosine[n] * way), 0.0, largest_share);
    }
  }
}

double largest_stand_out(const Model& model) {
  double largest = 0;
  for (std::size_t n = 0; n < model.inner_node.size(); ++n)
    if (model.inward[n] > 0) largest = std::max(largest, norm(position(model, n) - model.contact_point(n)));
  return largest;
}

} // namespace mpfem
