#pragma once
// Contact pressure node by node on the surface of grains, and how much it oscillates from node to node.

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <Eigen/Dense>

#include "solver/model/normals.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem::test {

/// Contact pressures of surface nodes by grain contacts (walls and bonds are left out), of every node of the model.
struct SurfacePressure {
  std::vector<double> total;      ///< MPa: own and reaction forces along the inward normal over the current area
  std::vector<double> own;        ///< MPa: K times gap of the node's own points, over the current area
  std::vector<char> touching;     ///< 1 where an own point is active
  std::vector<double> net_force;  ///< [3], N: sum of all contact forces, zero if action equals reaction
  std::vector<double> net_moment; ///< [3], N mm, about the origin
  std::vector<std::vector<int>> neighbour; ///< surface nodes that share a facet
};

/// Unit normal and tributary area (mm^2) of every node of a model; zeros inside grains.
inline std::vector<double> normal_rows(const Model& model) {
  std::vector<double> rows(4 * static_cast<std::size_t>(model.nodes()), 0.0);
  for (int grain = 0; grain < model.grains; ++grain) {
    const SurfaceNormals normals(model, grain);
    const std::size_t first = model.first_node(grain);
    for (std::size_t n = first;
         n < first + static_cast<std::size_t>(model.surface_node_count[static_cast<std::size_t>(grain)]); ++n) {
      for (std::size_t axis = 0; axis < 3; ++axis) rows[4 * n + axis] = normals.normal(n)[axis];
      rows[4 * n + 3] = normals.area(n);
    }
  }
  return rows;
}

inline SurfacePressure surface_pressure(const Model& model, const Contact& contact) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  SurfacePressure result;
  result.total.assign(nodes, 0), result.own.assign(nodes, 0), result.touching.assign(nodes, 0);
  result.net_force.assign(3, 0), result.net_moment.assign(3, 0);
  std::vector<double> force(3 * nodes, 0.0);
  for (std::size_t pair = 0; pair < contact.active.size(); ++pair)
    for (const ContactForce& point : contact.active_points(static_cast<std::int32_t>(pair))) {
      const auto node = static_cast<std::size_t>(point.node);
      double square = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        force[3 * node + a] += point.force[a];
        square += point.force[a] * point.force[a];
        for (int c = 0; c < 3; ++c)
          force[3 * static_cast<std::size_t>(point.facet_node[c]) + a] -= point.weight(c) * point.force[a];
      }
      result.own[node] += 2 * std::sqrt(square); // a pass carries half of the stiffness
      result.touching[node] = 1;
    }
  const std::vector<double> normals = normal_rows(model);
  for (std::size_t n = 0; n < nodes; ++n) {
    const double* x = &model.position[4 * n];
    const double* f = &force[3 * n];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      result.net_force[a] += f[a];
      result.net_moment[a] += x[b] * f[c] - x[c] * f[b];
    }
    const double* normal = &normals[4 * n];
    if (normal[3] <= 0) continue;
    result.total[n] = -(f[0] * normal[0] + f[1] * normal[1] + f[2] * normal[2]) / normal[3];
    result.own[n] /= normal[3];
  }
  std::vector<std::set<int>> ring(nodes);
  for (std::size_t f = 0; f < static_cast<std::size_t>(model.facets()); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        if (c != d) ring[static_cast<std::size_t>(model.facet[3 * f + c])].insert(model.facet[3 * f + d]);
  for (const auto& around : ring) result.neighbour.emplace_back(around.begin(), around.end());
  return result;
}

/// The same for what the walls press, instead of other grains: rigid planes, so that no facets take part.
inline SurfacePressure wall_pressure(const Simulation& simulation, SurfacePressure surface) {
  const Model& model = simulation.model();
  const Box& box = simulation.box();
  const std::vector<double> normals = normal_rows(model);
  std::fill(surface.total.begin(), surface.total.end(), 0.0);
  std::fill(surface.touching.begin(), surface.touching.end(), 0);
  for (int grain = 0; grain < model.grains; ++grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (auto n = static_cast<std::size_t>(model.node_offset[g]);
         n < static_cast<std::size_t>(model.node_offset[g + 1]); ++n)
      if (const double push = box.wall_force_on_node(model, n, grain), area = normals[4 * n + 3];
          push > 0 && area > 0) {
        surface.touching[n] = 1;
        surface.total[n] = push / area;
      }
  }
  surface.own = surface.total;
  return surface;
}

/// How much a pressure differs from what its neighbours say, over inner contact nodes: those whose neighbours all
/// touch.
struct PressureOscillation {
  int nodes = 0;
  double mean = 0;       ///< MPa, over inner nodes
  double from_mean = 0;  ///< root mean square of pressure less the area-weighted mean of its neighbours, over the mean
  double from_plane = 0; ///< the same from the linear field through its neighbours: a gradient does not count
  double largest = 0;    ///< largest difference from the linear field, over the mean
};

/// `pressure`: SurfacePressure::total or ::own. With `grain` >= 0 of that grain's nodes alone.
inline PressureOscillation oscillation(const Model& model, const SurfacePressure& surface,
                                       const std::vector<double>& pressure, int grain = -1) {
  PressureOscillation result;
  const std::vector<double> normals = normal_rows(model);
  const auto first = static_cast<std::size_t>(grain < 0 ? 0 : model.node_offset[static_cast<std::size_t>(grain)]);
  const auto end =
      static_cast<std::size_t>(grain < 0 ? model.nodes() : model.node_offset[static_cast<std::size_t>(grain) + 1]);
  for (std::size_t n = first; n < end; ++n) {
    const auto& ring = surface.neighbour[n];
    bool inner = surface.touching[n] != 0 && ring.size() >= 4;
    for (const int m : ring) inner = inner && surface.touching[static_cast<std::size_t>(m)] != 0;
    if (!inner) continue;
    const double* normal = &normals[4 * n];
    const Eigen::Vector3d axis(normal[0], normal[1], normal[2]);
    const Eigen::Vector3d across = axis.unitOrthogonal(), third = axis.cross(across);
    double sum = 0, area = 0;
    Eigen::MatrixXd position(ring.size(), 3);
    Eigen::VectorXd value(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto m = static_cast<std::size_t>(ring[i]);
      sum += normals[4 * m + 3] * pressure[m], area += normals[4 * m + 3];
      const Eigen::Vector3d offset(model.position[4 * m] - model.position[4 * n],
                                   model.position[4 * m + 1] - model.position[4 * n + 1],
                                   model.position[4 * m + 2] - model.position[4 * n + 2]);
      const auto row = static_cast<Eigen::Index>(i);
      position.row(row) << 1, offset.dot(across), offset.dot(third);
      value[row] = pressure[m];
    }
    const double plane = position.colPivHouseholderQr().solve(value)[0];
    ++result.nodes;
    result.mean += pressure[n];
    result.from_mean += std::pow(pressure[n] - sum / area, 2);
    result.from_plane += std::pow(pressure[n] - plane, 2);
    result.largest = std::max(result.largest, std::abs(pressure[n] - plane));
  }
  if (result.nodes == 0) return result;
  result.mean /= result.nodes;
  result.from_mean = std::sqrt(result.from_mean / result.nodes) / result.mean;
  result.from_plane = std::sqrt(result.from_plane / result.nodes) / result.mean;
  result.largest /= result.mean;
  return result;
}

} // namespace mpfem::test
