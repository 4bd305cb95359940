#pragma once
// Nodes are rows of four doubles (x, y, z, spare). Loading whole rows and transposing them in registers beats gathers
// (about twice as fast on AVX2 machines), and forces are added back row by row, so that no colouring is needed.

#include <cstdint>
#include <type_traits>
#include <utility>

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// A row of four doubles in one register, and two rows in one.
typedef double Row __attribute__((vector_size(32), aligned(32), may_alias));
typedef double TwoRows __attribute__((vector_size(64), aligned(64), may_alias));

namespace detail {

/// 4 x 4 transpose of rows a, b, c, d; the fourth column is dropped.
inline void transpose(Row a, Row b, Row c, Row d, Row& x, Row& y, Row& z) {
  const Row ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Row cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  x = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  z = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  y = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
}

/// Row `index` of an array in which a row begins every `Stride` numbers.
template <int Stride = 4>
Row row(const double* rows, std::int32_t index) {
  return *reinterpret_cast<const Row*>(rows + Stride * static_cast<std::size_t>(index));
}
/// Adds to row `index` of an array of rows.
inline void add_row(double* rows, std::int32_t index, Row value) {
  *reinterpret_cast<Row*>(rows + 4 * static_cast<std::size_t>(index)) += value;
}

/// Rows of four cells' nodes 1 … N relative to node 0. `index[i]` points at the four cells' node i.
template <int N, int Stride>
void edges4(const double* rows, const std::int32_t* const (&index)[N + 1], Row (&edge)[N][3]) {
  Row base[4];
  for (int lane = 0; lane < 4; ++lane) base[lane] = row<Stride>(rows, index[0][lane]);
  for (int i = 0; i < N; ++i) {
    const std::int32_t* node = index[i + 1];
    transpose(row<Stride>(rows, node[0]) - base[0], row<Stride>(rows, node[1]) - base[1],
              row<Stride>(rows, node[2]) - base[2], row<Stride>(rows, node[3]) - base[3], edge[i][0], edge[i][1],
              edge[i][2]);
  }
}

/// Numbers 0 and 1 of a and of b, of the first rows and then of the second; or numbers 2 and 3.
inline TwoRows first_halves(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
inline TwoRows second_halves(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}
/// Numbers of a and b in turn: 0 and 2 of both, or 1 and 3, of the first rows and then of the second.
inline TwoRows even_in_turn(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
}
inline TwoRows odd_in_turn(TwoRows a, TwoRows b) {
  return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}

/// Adds the vectors f to nodes 1, 2, 3 of eight tets, and minus their sum to node 0.
inline void add_balanced8(double* rows, const std::int32_t (&index)[4][8], const TwoRows (&f)[3][3]) {
  const auto add = [&](const std::int32_t* node, int k, TwoRows value) { // to tets k and k + 4
    add_row(rows, node[k], __builtin_shufflevector(value, value, 0, 1, 2, 3));
    add_row(rows, node[k + 4], __builtin_shufflevector(value, value, 4, 5, 6, 7));
  };
  const TwoRows zero = {};
  TwoRows total[4] = {};
  for (int i = 0; i < 3; ++i) {
    const TwoRows xy_even = even_in_turn(f[i][0], f[i][1]), xy_odd = odd_in_turn(f[i][0], f[i][1]),
                  z_even = even_in_turn(f[i][2], zero), z_odd = odd_in_turn(f[i][2], zero);
    const TwoRows of[4] = {first_halves(xy_even, z_even), first_halves(xy_odd, z_odd), second_halves(xy_even, z_even),
                           second_halves(xy_odd, z_odd)};
    for (int k = 0; k < 4; ++k) {
      add(index[i + 1], k, of[k]);
      total[k] += of[k];
    }
  }
  for (int k = 0; k < 4; ++k) add(index[0], k, -total[k]);
}

/// Adds the vectors f to nodes 1, 2, 3 of four tets, and minus their sum to node 0.
inline void add_balanced4(double* rows, const std::int32_t* const (&index)[4], const Row (&f)[3][3]) {
  Row total[4] = {};
  for (int i = 0; i < 3; ++i) {
    const Row zero = {0, 0, 0, 0};
    const Row xy_low = __builtin_shufflevector(f[i][0], f[i][1], 0, 4, 2, 6),
              xy_high = __builtin_shufflevector(f[i][0], f[i][1], 1, 5, 3, 7);
    const Row z_low = __builtin_shufflevector(f[i][2], zero, 0, 4, 2, 6),
              z_high = __builtin_shufflevector(f[i][2], zero, 1, 5, 3, 7);
    const Row lane[4] = {
        __builtin_shufflevector(xy_low, z_low, 0, 1, 4, 5), __builtin_shufflevector(xy_high, z_high, 0, 1, 4, 5),
        __builtin_shufflevector(xy_low, z_low, 2, 3, 6, 7), __builtin_shufflevector(xy_high, z_high, 2, 3, 6, 7)};
    for (int k = 0; k < 4; ++k) {
      add_row(rows, index[i + 1][k], lane[k]);
      total[k] += lane[k];
    }
  }
  for (int k = 0; k < 4; ++k) add_row(rows, index[0][k], -total[k]);
}

/// Rows of W = 4, 8 or 16 cells' nodes 1 … N relative to node 0 as floats; the differences are taken in doubles. A lane
/// of 128 bits holds four cells, so that one transpose serves all of them.
template <int W>
using Floats = typename NativeVector<W, float>::Numbers;
/// The four numbers as floats.
inline Floats<4> narrow(Row row) {
  return __builtin_convertvector(row, Floats<4>);
}
/// The four numbers as doubles.
inline Row widen(Floats<4> values) {
  return __builtin_convertvector(values, Row);
}
/// W floats from groups of four.
template <int W>
Floats<W> join(const Floats<4> (&part)[W / 4]) {
  if constexpr (W == 4) {
    return part[0];
  } else if constexpr (W == 8) {
    return __builtin_shufflevector(part[0], part[1], 0, 1, 2, 3, 4, 5, 6, 7);
  } else {
    return __builtin_shufflevector(join<8>({part[0], part[1]}), join<8>({part[2], part[3]}), 0, 1, 2, 3, 4, 5, 6, 7, 8,
                                   9, 10, 11, 12, 13, 14, 15);
  }
}
/// Group `part` of four floats out of W.
template <int W>
Floats<4> part_of(Floats<W> whole, int part) {
  if constexpr (W == 4) {
    return whole;
  } else if constexpr (W == 8) {
    return part == 0 ? __builtin_shufflevector(whole, whole, 0, 1, 2, 3)
                     : __builtin_shufflevector(whole, whole, 4, 5, 6, 7);
  } else {
    const Floats<8> half = part < 2 ? __builtin_shufflevector(whole, whole, 0, 1, 2, 3, 4, 5, 6, 7)
                                    : __builtin_shufflevector(whole, whole, 8, 9, 10, 11, 12, 13, 14, 15);
    return part_of<8>(half, part % 2);
  }
}
/// From every four numbers of a (0 … 3) and the same four of b (4 … 7), those that Take names, in its order.
template <int W, int... Take>
Floats<W> of_fours(Floats<W> a, Floats<W> b) {
  constexpr int take[] = {Take...};
  return [&]<int... I>(std::integer_sequence<int, I...>)->Floats<W> {
    return __builtin_shufflevector(a, b, (take[I % 4] / 4 * W + I / 4 * 4 + take[I % 4] % 4)...);
  }
  (std::make_integer_sequence<int, W>());
}

/// Edges of W cells, as load_edges() gives them.
template <int W, int N, int Stride>
void float_edges(const double* rows, const std::int32_t (&index)[N + 1][W], Vector3<Pack<W, float>> (&edge)[N]) {
  Row base[W];
  for (int cell = 0; cell < W; ++cell) base[cell] = row<Stride>(rows, index[0][cell]);
  for (int i = 0; i < N; ++i) {
    Floats<W> of[4]; // (x, y, z, spare) of cells 0, 4, …; of cells 1, 5, …; and so on
    for (int k = 0; k < 4; ++k) {
      Floats<4> part[W / 4];
      for (int p = 0; p < W / 4; ++p) part[p] = narrow(row<Stride>(rows, index[i + 1][4 * p + k]) - base[4 * p + k]);
      of[k] = join<W>(part);
    }
    const Floats<W> xy01 = of_fours<W, 0, 4, 1, 5>(of[0], of[1]), xy23 = of_fours<W, 0, 4, 1, 5>(of[2], of[3]);
    const Floats<W> z01 = of_fours<W, 2, 6, 3, 7>(of[0], of[1]), z23 = of_fours<W, 2, 6, 3, 7>(of[2], of[3]);
    edge[i] = {of_fours<W, 0, 1, 4, 5>(xy01, xy23), of_fours<W, 2, 3, 6, 7>(xy01, xy23),
               of_fours<W, 0, 1, 4, 5>(z01, z23)};
  }
}

/// Adds the vectors f to nodes 1, 2, 3 of W tets, and minus their sum to node 0. The sum is taken in doubles: momentum
/// is conserved exactly.
template <int W>
void add_balanced_floats(double* rows, const std::int32_t (&index)[4][W], const Vector3<Pack<W, float>> (&f)[3]) {
  Row total[W] = {};
  const Floats<W> zero = {};
  for (int i = 0; i < 3; ++i) {
    const Floats<W> xy01 = of_fours<W, 0, 4, 1, 5>(f[i].x.v, f[i].y.v),
                    xy23 = of_fours<W, 2, 6, 3, 7>(f[i].x.v, f[i].y.v);
    const Floats<W> z01 = of_fours<W, 0, 4, 1, 5>(f[i].z.v, zero), z23 = of_fours<W, 2, 6, 3, 7>(f[i].z.v, zero);
    const Floats<W> of[4] = {of_fours<W, 0, 1, 4, 5>(xy01, z01), of_fours<W, 2, 3, 6, 7>(xy01, z01),
                             of_fours<W, 0, 1, 4, 5>(xy23, z23), of_fours<W, 2, 3, 6, 7>(xy23, z23)};
    for (int p = 0; p < W / 4; ++p)
      for (int k = 0; k < 4; ++k) {
        const int cell = 4 * p + k;
        const Row value = widen(part_of<W>(of[k], p));
        add_row(rows, index[i + 1][cell], value);
        total[cell] += value;
      }
  }
  for (int cell = 0; cell < W; ++cell) add_row(rows, index[0][cell], -total[cell]);
}

/// Adds the first `lanes` (1 … 4) of four vectors to the rows `index`.
inline void add4(double* rows, const std::int32_t* index, int lanes, Row x, Row y, Row z) {
  const Row zero = {0, 0, 0, 0};
  const Row xy_low = __builtin_shufflevector(x, y, 0, 4, 2, 6), xy_high = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  const Row z_low = __builtin_shufflevector(z, zero, 0, 4, 2, 6), z_high = __builtin_shufflevector(z, zero, 1, 5, 3, 7);
  add_row(rows, index[0], __builtin_shufflevector(xy_low, z_low, 0, 1, 4, 5));
  if (lanes > 1) add_row(rows, index[1], __builtin_shufflevector(xy_high, z_high, 0, 1, 4, 5));
  if (lanes > 2) add_row(rows, index[2], __builtin_shufflevector(xy_low, z_low, 2, 3, 6, 7));
  if (lanes > 3) add_row(rows, index[3], __builtin_shufflevector(xy_high, z_high, 2, 3, 6, 7));
}

} // namespace detail

/// One number of each of W nodes.
template <class Real, int W>
Pack<W, Real> load_numbers(const double* numbers, const std::int32_t (&index)[W]) {
  Pack<W, Real> result(0.0);
  for (int k = 0; k < W; ++k) result.v[k] = static_cast<Real>(numbers[index[k]]);
  return result;
}

/// Edges of W cells (tets: N = 3, facets: N = 2): nodes 1 … N relative to node 0. `index[i]` holds the W cells' node i;
/// a row begins every `Stride` numbers.
template <int W, int N, int Stride = 4, class Real>
void load_edges(const double* rows, const std::int32_t (&index)[N + 1][W], Vector3<Pack<W, Real>> (&edge)[N]) {
  if constexpr (std::is_same_v<Real, float>) {
    detail::float_edges<W, N, Stride>(rows, index, edge);
  } else if constexpr (W % 4 == 0) {
    Row e[W / 4][N][3];
    for (int part = 0; part < W / 4; ++part) {
      const std::int32_t* node[N + 1];
      for (int i = 0; i <= N; ++i) node[i] = index[i] + 4 * part;
      detail::edges4<N, Stride>(rows, node, e[part]);
    }
    for (int i = 0; i < N; ++i) {
      if constexpr (W == 4) {
        edge[i] = {{e[0][i][0]}, {e[0][i][1]}, {e[0][i][2]}};
      } else {
        edge[i].x.v = __builtin_shufflevector(e[0][i][0], e[1][i][0], 0, 1, 2, 3, 4, 5, 6, 7);
        edge[i].y.v = __builtin_shufflevector(e[0][i][1], e[1][i][1], 0, 1, 2, 3, 4, 5, 6, 7);
        edge[i].z.v = __builtin_shufflevector(e[0][i][2], e[1][i][2], 0, 1, 2, 3, 4, 5, 6, 7);
      }
    }
  } else {
    for (int i = 0; i < N; ++i) {
      typename Pack<W>::Native x{}, y{}, z{};
      for (int k = 0; k < W; ++k) {
        const double *base = rows + Stride * index[0][k], *node = rows + Stride * index[i + 1][k];
        x[k] = node[0] - base[0], y[k] = node[1] - base[1], z[k] = node[2] - base[2];
      }
      edge[i] = {Pack<W>(x), Pack<W>(y), Pack<W>(z)};
    }
  }
}

/// Adds the vectors f to nodes 1, 2, 3 of W tets, one tet after another, and minus their sum to node 0.
template <int W, class Real>
void add_balanced(double* rows, const std::int32_t (&index)[4][W], const Vector3<Pack<W, Real>> (&f)[3]) {
  if constexpr (std::is_same_v<Real, float>) {
    detail::add_balanced_floats<W>(rows, index, f);
  } else if constexpr (W == 4) {
    detail::add_balanced4(
        rows, {index[0], index[1], index[2], index[3]},
        {{f[0].x.v, f[0].y.v, f[0].z.v}, {f[1].x.v, f[1].y.v, f[1].z.v}, {f[2].x.v, f[2].y.v, f[2].z.v}});
  } else if constexpr (W == 8) {
    detail::add_balanced8(
        rows, index, {{f[0].x.v, f[0].y.v, f[0].z.v}, {f[1].x.v, f[1].y.v, f[1].z.v}, {f[2].x.v, f[2].y.v, f[2].z.v}});
  } else {
    for (int k = 0; k < W; ++k) {
      double* base = rows + 4 * index[0][k];
      for (int i = 0; i < 3; ++i) {
        double* node = rows + 4 * index[i + 1][k];
        node[0] += f[i].x.v[k], node[1] += f[i].y.v[k], node[2] += f[i].z.v[k];
        base[0] -= f[i].x.v[k], base[1] -= f[i].y.v[k], base[2] -= f[i].z.v[k];
      }
    }
  }
}

/// Adds the first `lanes` of the W vectors to the rows `index`, one after another.
template <int W>
void add_rows(double* rows, const std::int32_t* index, int lanes, const Vector3<Pack<W>>& value) {
  if constexpr (W == 4) {
    detail::add4(rows, index, lanes, value.x.v, value.y.v, value.z.v);
  } else if constexpr (W == 8) {
    detail::add4(rows, index, lanes, __builtin_shufflevector(value.x.v, value.x.v, 0, 1, 2, 3),
                 __builtin_shufflevector(value.y.v, value.y.v, 0, 1, 2, 3),
                 __builtin_shufflevector(value.z.v, value.z.v, 0, 1, 2, 3));
    if (lanes > 4)
      detail::add4(rows, index + 4, lanes - 4, __builtin_shufflevector(value.x.v, value.x.v, 4, 5, 6, 7),
                   __builtin_shufflevector(value.y.v, value.y.v, 4, 5, 6, 7),
                   __builtin_shufflevector(value.z.v, value.z.v, 4, 5, 6, 7));
  } else {
    for (int i = 0; i < lanes; ++i) {
      double* node = rows + 4 * index[i];
      node[0] += value.x.v[i], node[1] += value.y.v[i], node[2] += value.z.v[i];
    }
  }
}

} // namespace mpfem
