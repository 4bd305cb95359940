#include "solver/bench/dense_packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <Eigen/Geometry>

namespace mpfem {

namespace {

constexpr double radius = 0.1;  // mm
constexpr double flat = 0.92;   // distance of a flat from the centre, in radii
constexpr double shrink = 1e-4; // half of the gap between two flats, in radii

using Point = Eigen::Vector3d;

/// The unit ball in eight octants of n^3 tetrahedra.
struct UnitBall {
  std::vector<Point> node;
  std::vector<std::array<std::int32_t, 4>> tet;
  double radius = 1; ///< of its surface nodes
};

using Lattice = std::array<int, 3>;

/// The tetrahedra of one octant, n^3 of them, by the lattice coordinates of their corners.
std::vector<std::array<Lattice, 4>> octant_tets(int n) {
  // A cube splits into six tetrahedra, each a path along the axes in some order from its low to its high corner. Those
  // inside the simplex n >= x >= y >= z >= 0 fill it, and x - y, y - z, z are the coordinates in the octant.
  std::vector<std::array<Lattice, 4>> tets;
  Lattice axes{0, 1, 2};
  do {
    for (int x = 0; x < n; ++x)
      for (int y = 0; y <= x; ++y)
        for (int z = 0; z <= y; ++z) {
          std::array<Lattice, 4> corner;
          Lattice at{x, y, z};
          bool inside = true;
          for (std::size_t i = 0; i < 4; ++i) {
            if (i > 0) ++at[static_cast<std::size_t>(axes[i - 1])];
            inside = inside && at[1] <= at[0] && at[2] <= at[1];
            corner[i] = {at[0] - at[1], at[1] - at[2], at[2]};
          }
          if (inside) tets.push_back(corner);
        }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return tets;
}

/// Six times the volume of a tet.
double determinant(const UnitBall& ball, const std::array<std::int32_t, 4>& tet) {
  const auto x = [&](std::size_t i) { return ball.node[static_cast<std::size_t>(tet[i])]; };
  return (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0)));
}

UnitBall make_unit_ball(int n) {
  UnitBall ball;
  std::map<Lattice, std::int32_t> index;
  const auto node_at = [&](const Lattice& lattice) {
    const auto [place, fresh] = index.try_emplace(lattice, static_cast<std::int32_t>(ball.node.size()));
    if (fresh) {
      // Octahedral shells of the lattice become spheres at the same distance from the centre.
      const Point v(lattice[0], lattice[1], lattice[2]);
      const double length = v.norm();
      ball.node.push_back(length > 0 ? Point(v * (v.lpNorm<1>() / (length * n))) : Point::Zero());
    }
    return place->second;
  };
  const auto of_octant = octant_tets(n);
  for (int octant = 0; octant < 8; ++octant)
    for (const auto& corners : of_octant) {
      std::array<std::int32_t, 4> tet{};
      for (std::size_t i = 0; i < 4; ++i) {
        Lattice lattice = corners[i];
        for (std::size_t axis = 0; axis < 3; ++axis)
          if ((octant >> axis) & 1) lattice[axis] = -lattice[axis];
        tet[i] = node_at(lattice);
      }
      if (determinant(ball, tet) < 0) std::swap(tet[2], tet[3]);
      ball.tet.push_back(tet);
    }
  // Flat facets lie inside the sphere: the ball is scaled to the volume of the sphere, so that contacts are as wide as
  // a sphere's.
  double volume = 0;
  for (const auto& tet : ball.tet) volume += determinant(ball, tet) / 6;
  ball.radius = std::cbrt(4.0 / 3.0 * std::acos(-1.0) / volume);
  for (Point& x : ball.node) x *= ball.radius;
  return ball;
}

using Site = std::array<int, 3>; // indices of a lattice point

/// Layers of lattice points along each axis of a block that holds `grains` of them: points i, j, k with an even sum are
/// half of all.
Site lattice_layers(double grains) {
  Site layers{};
  double left = 2.0 * grains;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    layers[axis] = std::max(1, static_cast<int>(std::lround(std::pow(left, 1.0 / static_cast<double>(3 - axis)))));
    left /= layers[axis];
  }
  return layers;
}

/// Directions in which a grain is cut: towards the neighbours that exist and towards walls.
std::vector<Point> cut_directions(const Site& site, const Site& layers) {
  std::vector<Point> cut;
  for (int direction = 0; direction < 27; ++direction) {
    const Site step{direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1};
    const int length = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
    bool beyond = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      beyond = beyond || site[axis] + step[axis] < 0 || site[axis] + step[axis] >= layers[axis];
    if ((length == 2 && !beyond) || (length == 1 && beyond))
      cut.push_back(Point(step[0], step[1], step[2]).normalized());
  }
  return cut;
}

/// Appends the ball, turned and cut flat in the given directions, with its centre at `centre` (mm). Returns its volume,
/// mm^3.
double add_grain(const UnitBall& ball, const Eigen::Matrix3d& turn, const std::vector<Point>& cut, const Point& centre,
                 MeshedPacking& packing) {
  const auto first = static_cast<std::int32_t>(packing.node.size() / 3);
  for (const Point& unit : ball.node) {
    const Point turned = turn * unit;
    double reach = 1;
    for (const Point& direction : cut)
      if (const double along = turned.dot(direction); along > 0)
        reach = std::min(reach, flat * turned.norm() / (ball.radius * along));
    const Point x = centre + radius * (1 - shrink) * reach * turned;
    packing.node.insert(packing.node.end(), {x[0], x[1], x[2]});
  }
  for (const auto& tet : ball.tet)
    for (const std::int32_t node : tet) packing.tet.push_back(first + node);
  packing.grain_node_offset.push_back(static_cast<std::int32_t>(packing.node.size() / 3));
  packing.grain_tet_offset.push_back(static_cast<std::int32_t>(packing.tet.size() / 4));
  const auto x = [&](std::int32_t n) {
    return Eigen::Map<const Point>(&packing.node[3 * static_cast<std::size_t>(first + n)]);
  };
  double volume = 0;
  for (const auto& t : ball.tet) volume += (x(t[1]) - x(t[0])).dot((x(t[2]) - x(t[0])).cross(x(t[3]) - x(t[0]))) / 6;
  return volume;
}

} // namespace

DensePacking make_dense_packing(std::int64_t tets, int grains, std::uint64_t seed) {
  const double per_octant = static_cast<double>(tets) / (8.0 * grains);
  const UnitBall ball = make_unit_ball(std::max(1, static_cast<int>(std::lround(std::cbrt(per_octant)))));
  // Neighbours on the lattice are sqrt(2) of the spacing apart.
  const Site layers = lattice_layers(static_cast<double>(tets) / static_cast<double>(ball.tet.size()));
  const double half_distance = flat * radius, spacing = std::sqrt(2.0) * half_distance;

  DensePacking result;
  MeshedPacking& packing = result.packing;
  packing.seed = static_cast<std::int64_t>(seed);
  for (std::size_t axis = 0; axis < 3; ++axis)
    packing.box_lengths[axis] = 2 * half_distance + (layers[axis] - 1) * spacing;
  packing.grain_node_offset.push_back(0);
  packing.grain_tet_offset.push_back(0);

  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  double volume = 0;
  for (int i = 0; i < layers[0]; ++i)
    for (int j = 0; j < layers[1]; ++j)
      for (int k = 0; k < layers[2]; ++k) {
        if ((i + j + k) % 2 != 0) continue;
        const Eigen::Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                                         .normalized()
                                         .toRotationMatrix();
        const Point centre(half_distance + i * spacing, half_distance + j * spacing, half_distance + k * spacing);
        volume += add_grain(ball, turn, cut_directions({i, j, k}, layers), centre, packing);
      }
  result.relative_density = volume / (packing.box_lengths[0] * packing.box_lengths[1] * packing.box_lengths[2]);
  return result;
}

} // namespace mpfem
