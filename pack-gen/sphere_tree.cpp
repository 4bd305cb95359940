#include "pack-gen/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mpfem {

namespace {

constexpr std::size_t leaf_size = 8;

/// Spheres between two places in the order of the tree, with the box of their centres and their largest radius.
struct Node {
  Point low{}, high{};
  double largest_radius = 0;
  std::size_t begin = 0, end = 0;
  std::size_t children = 0; ///< number of the first of two; 0: a leaf
};

class SphereTree {
public:
  SphereTree(const std::vector<Point>& center, const std::vector<double>& radius)
      : center_(center), radius_(radius), order_(center.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.push_back(bounds(0, order_.size()));
    for (std::size_t n = 0; n < nodes_.size(); ++n) split(n);
  }

  SphereGap smallest_gap(double enough) {
    best_ = {std::numeric_limits<double>::infinity(), -1, -1};
    for (std::size_t i = 0; i < center_.size() && !(best_.gap < enough); ++i) search(0, i, enough);
    return best_;
  }

private:
  Node bounds(std::size_t begin, std::size_t end) const {
    Node node;
    node.begin = begin, node.end = end;
    node.low = node.high = center_[order_[begin]];
    for (std::size_t m = begin; m < end; ++m) {
      for (std::size_t k = 0; k < 3; ++k) {
        node.low[k] = std::min(node.low[k], center_[order_[m]][k]);
        node.high[k] = std::max(node.high[k], center_[order_[m]][k]);
      }
      node.largest_radius = std::max(node.largest_radius, radius_[order_[m]]);
    }
    return node;
  }

  /// Halves a node across its longest edge.
  void split(std::size_t n) {
    const auto [begin, end] = std::pair(nodes_[n].begin, nodes_[n].end);
    if (end - begin <= leaf_size) return;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (nodes_[n].high[k] - nodes_[n].low[k] > nodes_[n].high[axis] - nodes_[n].low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t m) { return order_.begin() + static_cast<std::ptrdiff_t>(m); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::size_t a, std::size_t b) { return center_[a][axis] < center_[b][axis]; });
    nodes_[n].children = nodes_.size();
    nodes_.push_back(bounds(begin, middle));
    nodes_.push_back(bounds(middle, end));
  }

  /// No pair of sphere i with one of the node has a smaller gap.
  double least_gap(const Node& node, std::size_t i) const {
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double outside = std::max({node.low[k] - center_[i][k], center_[i][k] - node.high[k], 0.0});
      squares += outside * outside;
    }
    constexpr double rounding = 1 - 4 * std::numeric_limits<double>::epsilon();
    return rounding * std::sqrt(squares) - radius_[i] - node.largest_radius;
  }

  /// Improves the best gap by pairs of sphere i with later ones of the node.
  void search(std::size_t n, std::size_t i, double enough) {
    const Node& node = nodes_[n];
    if (!(least_gap(node, i) < best_.gap) || best_.gap < enough) return;
    if (node.children != 0) {
      const bool second_nearer = least_gap(nodes_[node.children + 1], i) < least_gap(nodes_[node.children], i);
      search(node.children + (second_nearer ? 1 : 0), i, enough);
      search(node.children + (second_nearer ? 0 : 1), i, enough);
      return;
    }
    for (std::size_t m = node.begin; m < node.end; ++m) {
      const std::size_t j = order_[m];
      if (j <= i) continue;
      const double x = center_[i][0] - center_[j][0], y = center_[i][1] - center_[j][1],
                   z = center_[i][2] - center_[j][2];
      const double gap = std::sqrt(x * x + y * y + z * z) - radius_[i] - radius_[j];
      if (gap < best_.gap) best_ = {gap, static_cast<int>(i), static_cast<int>(j)};
    }
  }

  const std::vector<Point>& center_;
  const std::vector<double>& radius_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
  SphereGap best_;
};

} // namespace

SphereGap smallest_gap_of_pairs(const std::vector<Point>& center, const std::vector<double>& radius, double enough) {
  if (center.size() < 2) return {std::numeric_limits<double>::infinity(), -1, -1};
  return SphereTree(center, radius).smallest_gap(enough);
}

} // namespace mpfem
