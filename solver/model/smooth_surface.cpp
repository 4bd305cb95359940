#include "solver/model/smooth_surface.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mpfem {

namespace {

/// What a contact point may take from the inner node: more would be no small correction any more.
constexpr double largest_share = 0.25;
/// Least cosine of the way to the inner node with the normal: a node that has none so straight beneath it stays as it is.
constexpr double least_cosine = 0.5;

Vector3<double> position(const Model& model, std::size_t node) {
  return {model.position[4 * node], model.position[4 * node + 1], model.position[4 * node + 2]};
}

/// Unit normals of surface nodes, mean of their facets' by area, and the height of the smooth surface above these facets, mm.
struct NodalSurface {
  std::vector<Vector3<double>> normal;
  std::vector<double> height;
};

NodalSurface nodal_surface(const Model& model) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  NodalSurface surface{std::vector<Vector3<double>>(nodes, {0, 0, 0}), std::vector<double>(nodes, 0.0)};
  const auto for_each_facet = [&](const auto& visit) {
    for (std::size_t f = 0; f < model.facet.size(); f += 3) {
      const std::size_t node[3] = {static_cast<std::size_t>(model.facet[f]),
                                   static_cast<std::size_t>(model.facet[f + 1]),
                                   static_cast<std::size_t>(model.facet[f + 2])};
      const Vector3<double> x[3] = {position(model, node[0]), position(model, node[1]), position(model, node[2])};
      visit(node, x, cross(x[1] - x[0], x[2] - x[0]));
    }
  };
  for_each_facet([&](const auto& node, const auto&, const Vector3<double>& area) {
    for (const std::size_t n : node) surface.normal[n] = surface.normal[n] + area;
  });
  for (Vector3<double>& normal : surface.normal)
    if (const double size = norm(normal); size > 0) normal = (1.0 / size) * normal;
  std::vector<double> weight(nodes, 0.0);
  for_each_facet([&](const auto& node, const auto& x, const Vector3<double>& area) {
    double height = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      height += dot(surface.normal[node[j]] - surface.normal[node[i]], x[j] - x[i]) / 24.0;
    }
    const double size = norm(area);
    for (const std::size_t n : node) surface.height[n] += size * height, weight[n] += size;
  });
  for (std::size_t n = 0; n < nodes; ++n)
    if (weight[n] > 0) surface.height[n] /= weight[n];
  return surface;
}

} // namespace

void find_smooth_surface(Model& model) {
  const NodalSurface surface = nodal_surface(model);
  const auto nodes = static_cast<std::size_t>(model.nodes());
  model.inner_node.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) model.inner_node[n] = static_cast<std::int32_t>(n);
  model.inward.assign(nodes, 0.0);
  std::vector<double> cosine(nodes, 0.0); // with the inward normal, of the way to the inner node
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    const auto first = static_cast<std::size_t>(model.node_offset[g]),
               surface_end = first + static_cast<std::size_t>(model.surface_node_count[g]);
    for (std::int32_t t = 0; t < model.tet_offset[g + 1] - model.tet_offset[g]; ++t) {
      const auto corner = model.nodes_of_tet(grain, t);
      for (const std::int32_t a : corner)
        for (const std::int32_t b : corner) {
          const std::size_t n = first + static_cast<std::size_t>(a), inner = first + static_cast<std::size_t>(b);
          if (n >= surface_end || n == inner) continue;
          const Vector3<double> way = position(model, n) - position(model, inner);
          const double along = dot(way, surface.normal[n]) / norm(way);
          if (along > cosine[n]) cosine[n] = along, model.inner_node[n] = static_cast<std::int32_t>(inner);
        }
    }
    for (std::size_t n = first; n < surface_end; ++n) {
      const double height = std::max(surface.height[n], 0.0);
      if (cosine[n] < least_cosine) continue;
      const double way = norm(position(model, n) - position(model, static_cast<std::size_t>(model.inner_node[n])));
      model.inward[n] = std::min(height / (cosine[n] * way), largest_share);
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
