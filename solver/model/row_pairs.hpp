#pragma once
// Rows of two fields of the same nodes side by side, so that one load of eight numbers takes both and one transpose
// serves both. The element pass takes a fifth less time with positions and displacements in pairs than in two arrays.
// Floats are measured from the mean over the grain's nodes: a float resolves a ten-millionth of the grain, wherever the
// grain is and however fast it flies.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver/model/aligned.hpp"
#include "solver/model/rows.hpp"

namespace mpfem {

/// A row pair of floats in one register.
typedef float FloatPair __attribute__((vector_size(32), aligned(32), may_alias));

/// Room for the row pairs of one grain's nodes, to be used for one grain after another.
template <class Real>
class RowPairs {
public:
  /// Rows of `nodes` nodes, and `factor` times their rows in a second array: eight numbers for each node, valid until
  /// the next call. Floats have the means over all nodes subtracted.
  const Real* place(const double* first, const double* second, double factor, std::size_t nodes) {
    if (numbers_.size() < 8 * nodes) numbers_.resize(8 * nodes);
    Real* pairs = numbers_.data();
    if constexpr (std::is_same_v<Real, double>) {
      for (std::size_t n = 0; n < nodes; ++n) {
        row(pairs + 8 * n) = row(first + 4 * n);
        row(pairs + 8 * n + 4) = factor * row(second + 4 * n);
      }
    } else {
      const Row centre = mean(first, nodes), drift = mean(second, nodes);
      for (std::size_t n = 0; n < nodes; ++n) {
        const auto a = detail::narrow(row(first + 4 * n) - centre);
        const auto b = detail::narrow(factor * (row(second + 4 * n) - drift));
        *reinterpret_cast<FloatPair*>(pairs + 8 * n) = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
      }
    }
    return pairs;
  }

private:
  static Row& row(double* numbers) { return *reinterpret_cast<Row*>(numbers); }
  static const Row& row(const double* numbers) { return *reinterpret_cast<const Row*>(numbers); }
  static Row mean(const double* rows, std::size_t nodes) {
    Row sum{};
    for (std::size_t n = 0; n < nodes; ++n) sum += row(rows + 4 * n);
    return sum / static_cast<double>(nodes);
  }

  AlignedVector<Real> numbers_;
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

/// Pair `index` of an array of row pairs of floats.
inline FloatPair row_pair(const float* pairs, std::int32_t index) {
  return *reinterpret_cast<const FloatPair*>(pairs + 8 * static_cast<std::size_t>(index));
}

/// One component of both fields of W cells, from vectors that hold it of four cells and of the next four in turn: of
/// the first field and of the second.
template <int W>
void separate(const Floats<8> (&component)[1], Floats<W>& first, Floats<W>& second) requires(W == 4) {
  first = part_of<8>(component[0], 0), second = part_of<8>(component[0], 1);
}
template <int W>
void separate(const Floats<8> (&c)[2], Floats<W>& first, Floats<W>& second) requires(W == 8) {
  first = __builtin_shufflevector(c[0], c[1], 0, 1, 2, 3, 8, 9, 10, 11);
  second = __builtin_shufflevector(c[0], c[1], 4, 5, 6, 7, 12, 13, 14, 15);
}
template <int W>
void separate(const Floats<16> (&c)[2], Floats<W>& first, Floats<W>& second) requires(W == 16) {
  first = __builtin_shufflevector(c[0], c[1], 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27);
  second = __builtin_shufflevector(c[0], c[1], 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
}

/// Transposes the row pairs of W = 4, 8 or 16 cells; the spare numbers are dropped.
template <int W>
void transpose(const Floats<8> (&pair)[W], Floats<W> (&first)[3], Floats<W> (&second)[3]) {
  constexpr int V = W == 16 ? 16 : 8, pairs = V / 8, parts = W / 4 / pairs;
  Floats<V> x[parts], y[parts], z[parts];
  for (int p = 0; p < parts; ++p) {
    Floats<V> of[4]; // pairs of cells k and, if two fit, k + 4
    for (int k = 0; k < 4; ++k) {
      const int cell = 4 * pairs * p + k;
      if constexpr (pairs == 1) {
        of[k] = pair[cell];
      } else {
        of[k] =
            __builtin_shufflevector(pair[cell], pair[cell + 4], 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
      }
    }
    const Floats<V> xy01 = of_fours<V, 0, 4, 1, 5>(of[0], of[1]), xy23 = of_fours<V, 0, 4, 1, 5>(of[2], of[3]),
                    z01 = of_fours<V, 2, 6, 3, 7>(of[0], of[1]), z23 = of_fours<V, 2, 6, 3, 7>(of[2], of[3]);
    x[p] = of_fours<V, 0, 1, 4, 5>(xy01, xy23), y[p] = of_fours<V, 2, 3, 6, 7>(xy01, xy23);
    z[p] = of_fours<V, 0, 1, 4, 5>(z01, z23);
  }
  separate<W>(x, first[0], second[0]);
  separate<W>(y, first[1], second[1]);
  separate<W>(z, first[2], second[2]);
}

} // namespace detail

/// Edges of W cells in both fields of `pairs` (of RowPairs::place()): what load_edges() gives for each.
template <int W, int N, class Real>
void load_edge_pairs(const Real* pairs, const std::int32_t (&index)[N + 1][W], Vector3<Pack<W, Real>> (&first)[N],
                     Vector3<Pack<W, Real>> (&second)[N]) {
  constexpr bool floats = std::is_same_v<Real, float>;
  if constexpr (floats || W == 8) {
    using Pair = typename NativeVector<8, Real>::Numbers;
    Pair base[W];
    for (int k = 0; k < W; ++k) base[k] = detail::row_pair(pairs, index[0][k]);
    for (int i = 0; i < N; ++i) {
      Pair edge[W];
      typename Pack<W, Real>::Native f[3], s[3];
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
