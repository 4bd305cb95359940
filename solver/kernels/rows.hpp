#pragma once
// Nodes are rows of four doubles (x, y, z, spare). Loading whole rows and transposing them in registers beats gathers
// (about twice as fast on AVX2 machines), and forces are added back row by row, so that no colouring is needed.

#include <cstdint>

#include "solver/physics/tensor.hpp"

namespace mpfem {

typedef double Row __attribute__((vector_size(32), aligned(32), may_alias));

namespace detail {

/// 4 x 4 transpose of rows a, b, c, d; the fourth column is dropped.
inline void transpose(Row a, Row b, Row c, Row d, Row& x, Row& y, Row& z) {
  const Row ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Row cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  x = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  z = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  y = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
}

inline Row row(const double* rows, std::int32_t index) {
  return *reinterpret_cast<const Row*>(rows + 4 * index);
}
inline void add_row(double* rows, std::int32_t index, Row value) {
  *reinterpret_cast<Row*>(rows + 4 * index) += value;
}

inline void load4(const double* rows, const std::int32_t* index, Row& x, Row& y, Row& z) {
  transpose(row(rows, index[0]), row(rows, index[1]), row(rows, index[2]), row(rows, index[3]), x, y, z);
}

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

/// x, y, z of the W nodes `index`.
template <int W>
Vector3<Pack<W>> load_rows(const double* rows, const std::int32_t* index) {
  Vector3<Pack<W>> result;
  if constexpr (W == 4) {
    detail::load4(rows, index, result.x.v, result.y.v, result.z.v);
  } else if constexpr (W == 8) {
    Row x0, y0, z0, x1, y1, z1;
    detail::load4(rows, index, x0, y0, z0);
    detail::load4(rows, index + 4, x1, y1, z1);
    result.x.v = __builtin_shufflevector(x0, x1, 0, 1, 2, 3, 4, 5, 6, 7);
    result.y.v = __builtin_shufflevector(y0, y1, 0, 1, 2, 3, 4, 5, 6, 7);
    result.z.v = __builtin_shufflevector(z0, z1, 0, 1, 2, 3, 4, 5, 6, 7);
  } else {
    for (int i = 0; i < W; ++i) {
      const double* node = rows + 4 * index[i];
      result.x.v[i] = node[0], result.y.v[i] = node[1], result.z.v[i] = node[2];
    }
  }
  return result;
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
