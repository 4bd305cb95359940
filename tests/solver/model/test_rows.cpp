// Rows of nodes: edges of cells gathered from them, forces of tets added to them, in packs of every width.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <catch2/catch.hpp>

#include "solver/model/row_pairs.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr std::size_t nodes = 50;

/// A few roundings of floats, each up to 6e-8 of the number.
template <class Real>
constexpr double few_roundings = sizeof(Real) == 4 ? 1e-6 : rounding;

AlignedVector<double> random_rows(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  AlignedVector<double> rows(4 * nodes);
  for (double& x : rows) x = uniform(random);
  return rows;
}

AlignedVector<double> moved(AlignedVector<double> rows, double shift) {
  for (double& x : rows) x += shift;
  return rows;
}

/// W tets, some with common nodes.
template <int W>
struct Tets {
  std::int32_t node[4][W];
  Tets() {
    std::mt19937 random(3);
    for (auto& corner : node)
      for (auto& n : corner) n = static_cast<std::int32_t>(random() % nodes);
  }
  /// Where component `axis` of a corner of tet `lane` lies in an array of rows.
  std::size_t at(int corner, int lane, std::size_t axis) const {
    return 4 * static_cast<std::size_t>(node[corner][lane]) + axis;
  }
};

template <int W, class Real>
std::array<double, 3> of_lane(const Vector3<Pack<W, Real>>& v, int lane) {
  return {v.x[lane], v.y[lane], v.z[lane]};
}

template <int W, class Real>
void check_edges(const Tets<W>& tets, const AlignedVector<double>& rows, double factor,
                 const Vector3<Pack<W, Real>> (&edge)[3], double tolerance = few_roundings<Real>) {
  for (int lane = 0; lane < W; ++lane)
    for (int i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        const double expected = factor * (rows[tets.at(i + 1, lane, a)] - rows[tets.at(0, lane, a)]);
        CHECK(std::abs(of_lane(edge[i], lane)[a] - expected) < tolerance);
      }
}

template <int W, class Real>
void check_gathering() {
  const Tets<W> tets;
  const AlignedVector<double> rows = random_rows(1), others = random_rows(2);
  Vector3<Pack<W, Real>> edge[3], other[3];
  load_edges<W, 3>(rows.data(), tets.node, edge);
  check_edges<W, Real>(tets, rows, 1, edge);
  RowPairs<Real> pairs;
  load_edge_pairs<W, 3>(pairs.place(rows.data(), others.data(), 0.25, nodes), tets.node, edge, other);
  check_edges<W, Real>(tets, rows, 1, edge);
  check_edges<W, Real>(tets, others, 0.25, other);
  // A grain of size 1 at 10,000 that flies as fast: its doubles are rounded to 1e-16 of that.
  constexpr double far = 1e4, tolerance = few_roundings<Real> + 1e-15 * far;
  load_edge_pairs<W, 3>(pairs.place(moved(rows, far).data(), moved(others, far).data(), 0.25, nodes), tets.node, edge,
                        other);
  check_edges<W, Real>(tets, rows, 1, edge, tolerance);
  check_edges<W, Real>(tets, others, 0.25, other, tolerance);
}

template <int W, class Real>
void check_adding() {
  const Tets<W> tets;
  Vector3<Pack<W, Real>> force[3];
  load_edges<W, 3>(random_rows(1).data(), tets.node, force); // any numbers
  AlignedVector<double> sums(4 * nodes, 0.0), expected = sums;
  add_balanced<W>(sums.data(), tets.node, force);
  for (int lane = 0; lane < W; ++lane)
    for (int i = 0; i < 3; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        expected[tets.at(i + 1, lane, a)] += of_lane(force[i], lane)[a];
        expected[tets.at(0, lane, a)] -= of_lane(force[i], lane)[a];
      }
  std::array<double, 3> total{};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    CHECK(std::abs(sums[i] - expected[i]) < rounding);
    if (i % 4 < 3) total[i % 4] += sums[i];
  }
  for (const double sum : total) CHECK(std::abs(sum) < rounding * 100);
}

} // namespace

TEST_CASE("Edges of cells are differences of their nodes' rows, wherever they are, in packs of every width") {
  check_gathering<1, double>();
  check_gathering<2, double>();
  check_gathering<4, double>();
  check_gathering<8, double>();
  check_gathering<4, float>();
  check_gathering<8, float>();
  check_gathering<16, float>();
}

TEST_CASE("Forces of tets are added to their nodes and sum to zero, in packs of every width") {
  check_adding<1, double>();
  check_adding<2, double>();
  check_adding<4, double>();
  check_adding<8, double>();
  check_adding<4, float>();
  check_adding<8, float>();
  check_adding<16, float>();
}
