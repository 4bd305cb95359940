#include "surfaces/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mpfem {

namespace {

constexpr std::size_t leaf_triangles = 4;

std::array<double, 3> coordinates(const Vector3<double>& x) {
  return {x.x, x.y, x.z};
}

} // namespace

/// Halves the triangles at the median of their centres along the longest side of the box around the centres, so that
/// the depth of the tree is the logarithm of their number.
struct TriangleTree::Build {
  std::span<const FlatTriangle> triangles;
  std::vector<std::int32_t>& order;
  std::vector<Node>& node;

  std::array<double, 3> centre(std::int32_t t) const {
    const auto& c = triangles[static_cast<std::size_t>(t)].corner;
    return coordinates(c[0] + c[1] + c[2]);
  }
  /// The box around triangles begin … end - 1 of the order.
  Node box_around(std::size_t begin, std::size_t end) const {
    constexpr double far = std::numeric_limits<double>::max();
    Node box{{far, far, far}, {-far, -far, -far}};
    for (std::size_t i = begin; i < end; ++i)
      for (const Vector3<double>& corner : triangles[static_cast<std::size_t>(order[i])].corner)
        for (std::size_t a = 0; a < 3; ++a) {
          box.low[a] = std::min(box.low[a], coordinates(corner)[a]);
          box.high[a] = std::max(box.high[a], coordinates(corner)[a]);
        }
    return box;
  }
  std::size_t axis_of_most(std::size_t begin, std::size_t end) const {
    std::array<double, 3> low = centre(order[begin]), high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        const double c = centre(order[i])[a];
        low[a] = std::min(low[a], c), high[a] = std::max(high[a], c);
      }
    const std::array<double, 3> length{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  }
  void add(std::size_t begin, std::size_t end) {
    const std::size_t self = node.size();
    node.push_back(box_around(begin, end));
    if (end - begin <= leaf_triangles) {
      node[self].second = static_cast<std::int32_t>(begin);
      node[self].count = static_cast<std::int32_t>(end - begin);
      return;
    }
    const std::size_t axis = axis_of_most(begin, end), middle = begin + (end - begin) / 2;
    const auto place = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(place(begin), place(middle), place(end), [&](std::int32_t a, std::int32_t b) {
      return std::pair(centre(a)[axis], a) < std::pair(centre(b)[axis], b); // the same tree with every standard library
    });
    add(begin, middle);
    node[self].second = static_cast<std::int32_t>(node.size());
    add(middle, end);
  }
};

TriangleTree::TriangleTree(std::span<const FlatTriangle> triangles, double margin)
    : number_(triangles.size()), slot_(triangles.size()), margin_(margin) {
  std::iota(number_.begin(), number_.end(), 0);
  Build{triangles, number_, node_}.add(0, triangles.size());
  triangle_.reserve(triangles.size());
  for (const std::int32_t t : number_) {
    slot_[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(triangle_.size());
    triangle_.push_back(triangles[static_cast<std::size_t>(t)]);
  }
}

Nearest TriangleTree::nearest(const Vector3<double>& x, std::int32_t first, double slack) const {
  Nearest best{std::numeric_limits<double>::infinity(), first, Feature::face, {}};
  triangle(first).offer(x, first, margin_, best);
  struct Waiting {
    std::int32_t node;
    double squared;
  };
  std::array<Waiting, levels> waiting; // NOLINT: set before it is read
  std::size_t count = 0;
  waiting[count++] = {0, node_[0].squared_distance(x)};
  while (count > 0) {
    const auto [index, squared] = waiting[--count];
    if (squared * slack * slack >= best.squared) continue;
    const Node& node = node_[static_cast<std::size_t>(index)];
    for (std::int32_t i = node.second; i < node.second + node.count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      triangle_[slot].offer(x, number_[slot], margin_, best);
    }
    if (node.count > 0) continue;
    Waiting near{index + 1, node_[static_cast<std::size_t>(index) + 1].squared_distance(x)};
    Waiting far{node.second, node_[static_cast<std::size_t>(node.second)].squared_distance(x)};
    if (far.squared < near.squared) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return best;
}

} // namespace mpfem
