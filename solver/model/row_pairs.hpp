#pragma once
// Rows of two fields of the same nodes side by side, so that one load of eight numbers takes both and one transpose
// serves both. The element pass takes a fifth less time with positions and displacements in pairs than in two arrays.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver/model/aligned.hpp"
#include "solver/model/rows.hpp"

namespace mpfem {

/// Room for the row pairs of one grain's nodes, to be used for one grain after another.
class RowPairs {
public:
  /// Rows of `nodes` nodes, and `factor` times their rows in a second array: eight numbers for each node, valid until
  /// the next call.
  const double* place(const double* first, const double* second, double factor, std::size_t nodes) {
    if (numbers_.size() < 8 * nodes) numbers_.resize(8 * nodes);
    double* pairs = numbers_.data();
    for (std::size_t n = 0; n < nodes; ++n) {
      *reinterpret_cast<Row*>(pairs + 8 * n) = *reinterpret_cast<const Row*>(first + 4 * n);
      *reinterpret_cast<Row*>(pairs + 8 * n + 4) = factor * *reinterpret_cast<const Row*>(second + 4 * n);
    }
    return pairs;
  }

private:
  AlignedVector<double> numbers_;
};

namespace detail {

/// Pair `index` of an array of row pairs.
inline TwoRows row_pair(const double* pairs, std::int32_t index) {
  return *reinterpret_cast<const TwoRows*>(pairs + 8 * static_cast<std::size_t>(index));
}

/// Numbers 0, 1, 4, 5 of a and of b; or numbers 2, 3, 6, 7.
inline TwoRows even_twos(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
}
inline TwoRows odd_twos(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
}

/// Transposes the row pairs of eight cells; the spare numbers are dropped.
inline void transpose(const TwoRows (&pair)[8], TwoRows (&first)[3], TwoRows (&second)[3]) {
  TwoRows xz[4], y[4]; // of two cells: x x z z of the first rows and of the second; y y and spare numbers
  for (int p = 0; p < 4; ++p) {
    xz[p] = even_in_turn(pair[2 * p], pair[2 * p + 1]);
    y[p] = odd_in_turn(pair[2 * p], pair[2 * p + 1]);
  }
  // One component of four cells: two of the first rows, two of the second, and again.
  const TwoRows x4[2] = {even_twos(xz[0], xz[1]), even_twos(xz[2], xz[3])},
                y4[2] = {even_twos(y[0], y[1]), even_twos(y[2], y[3])},
                z4[2] = {odd_twos(xz[0], xz[1]), odd_twos(xz[2], xz[3])};
  first[0] = even_twos(x4[0], x4[1]), second[0] = odd_twos(x4[0], x4[1]);
  first[1] = even_twos(y4[0], y4[1]), second[1] = odd_twos(y4[0], y4[1]);
  first[2] = even_twos(z4[0], z4[1]), second[2] = odd_twos(z4[0], z4[1]);
}

} // namespace detail

/// Edges of W cells in both fields of `pairs` (of RowPairs::place()): what load_edges() gives for each.
template <int W, int N, class Real>
void load_edge_pairs(const double* pairs, const std::int32_t (&index)[N + 1][W], Vector3<Pack<W, Real>> (&first)[N],
                     Vector3<Pack<W, Real>> (&second)[N]) {
  if constexpr (W == 8 && std::is_same_v<Real, double>) {
    TwoRows base[W];
    for (int k = 0; k < W; ++k) base[k] = detail::row_pair(pairs, index[0][k]);
    for (int i = 0; i < N; ++i) {
      TwoRows edge[W], f[3], s[3];
      for (int k = 0; k < W; ++k) edge[k] = detail::row_pair(pairs, index[i + 1][k]) - base[k];
      detail::transpose(edge, f, s);
      first[i] = {{f[0]}, {f[1]}, {f[2]}};
      second[i] = {{s[0]}, {s[1]}, {s[2]}};
    }
  } else {
    load_edges<W, N, 8>(pairs, index, first);
    load_edges<W, N, 8>(pairs + 4, index, second);
  }
}

} // namespace mpfem
