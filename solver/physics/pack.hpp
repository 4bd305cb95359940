#pragma once
// A pack of scalars that computes lane by lane, so that each law of physics is written once and serves as plain double
// and as SIMD. `select` stands for `if`. Built on the compiler's vector types; but for one test,
// no instruction set is named here.

#include <cmath>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace mpfem {

/// Lanes of a native pack of doubles on the machine that the program is built for.
#if defined(__AVX512F__)
inline constexpr int native_lanes = 8;
#elif defined(__AVX__)
inline constexpr int native_lanes = 4;
#else
inline constexpr int native_lanes = 2;
#endif

/// The compiler's vector types. Written out per width: gcc drops the attribute where the width is a template parameter.
template <int W>
struct NativeVector;
template <>
struct NativeVector<2> {
  typedef double Numbers __attribute__((vector_size(16)));
  typedef std::int64_t Truths __attribute__((vector_size(16)));
};
template <>
struct NativeVector<4> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef std::int64_t Truths __attribute__((vector_size(32)));
};
template <>
struct NativeVector<8> {
  typedef double Numbers __attribute__((vector_size(64)));
  typedef std::int64_t Truths __attribute__((vector_size(64)));
};

/// Lane-wise truth values of a Pack<W>.
template <int W>
struct Mask {
  using Native = typename NativeVector<W>::Truths;
  Native v;
  friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
  Mask operator!() const { return {~v}; }
};

template <int W>
struct Pack {
  using Native = typename NativeVector<W>::Numbers;
  static constexpr int lanes = W;
  Native v;

  Pack() = default;
  Pack(Native native) : v(native) {}
  Pack(double scalar) : v(Native{} + scalar) {}

  double operator[](int lane) const { return v[lane]; }

  static Pack load(const double* aligned) { return *reinterpret_cast<const Native*>(aligned); }
  void store(double* aligned) const { *reinterpret_cast<Native*>(aligned) = v; }

  friend Pack operator+(Pack a, Pack b) { return a.v + b.v; }
  friend Pack operator-(Pack a, Pack b) { return a.v - b.v; }
  friend Pack operator*(Pack a, Pack b) { return a.v * b.v; }
  friend Pack operator/(Pack a, Pack b) { return a.v / b.v; }
  Pack operator-() const { return -v; }
  Pack& operator+=(Pack b) {
    v += b.v;
    return *this;
  }
  Pack& operator-=(Pack b) {
    v -= b.v;
    return *this;
  }
  Pack& operator*=(Pack b) {
    v *= b.v;
    return *this;
  }
  friend Mask<W> operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Mask<W> operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Mask<W> operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  friend Mask<W> operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
};

using NativePack = Pack<native_lanes>;

template <int W>
Pack<W> select(Mask<W> mask, Pack<W> yes, Pack<W> no) {
  return mask.v ? yes.v : no.v;
}
template <int W>
Pack<W> max(Pack<W> a, Pack<W> b) {
  return a.v > b.v ? a.v : b.v;
}
template <int W>
Pack<W> min(Pack<W> a, Pack<W> b) {
  return a.v < b.v ? a.v : b.v;
}
template <int W>
bool any(Mask<W> mask) {
#if defined(__AVX__)
  if constexpr (W == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.v)) != 0; // one instruction for ten
#endif
  std::int64_t bits = 0;
  for (int i = 0; i < W; ++i) bits |= mask.v[i];
  return bits != 0;
}
template <int W>
Pack<W> sqrt(Pack<W> a) {
  Pack<W> root;
  for (int i = 0; i < W; ++i) root.v[i] = std::sqrt(a.v[i]);
  return root;
}
// exp and log are Eigen's vectorised ones (errors of a few units in the last place).
template <int W>
Pack<W> exp(Pack<W> a) {
  Pack<W> result;
  Eigen::Map<Eigen::Array<double, W, 1>, Eigen::Aligned16>(reinterpret_cast<double*>(&result.v)) =
      Eigen::Map<const Eigen::Array<double, W, 1>, Eigen::Aligned16>(reinterpret_cast<const double*>(&a.v)).exp();
  return result;
}
template <int W>
Pack<W> log(Pack<W> a) {
  Pack<W> result;
  Eigen::Map<Eigen::Array<double, W, 1>, Eigen::Aligned16>(reinterpret_cast<double*>(&result.v)) =
      Eigen::Map<const Eigen::Array<double, W, 1>, Eigen::Aligned16>(reinterpret_cast<const double*>(&a.v)).log();
  return result;
}
template <int W>
double sum(Pack<W> a) {
  double total = 0;
  for (int i = 0; i < W; ++i) total += a.v[i];
  return total;
}
template <int W>
double largest(Pack<W> a) {
  double value = a.v[0];
  for (int i = 1; i < W; ++i) value = a.v[i] > value ? a.v[i] : value;
  return value;
}
template <int W>
double smallest(Pack<W> a) {
  double value = a.v[0];
  for (int i = 1; i < W; ++i) value = a.v[i] < value ? a.v[i] : value;
  return value;
}

// The same vocabulary for one plain double.
inline double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
inline double max(double a, double b) {
  return a > b ? a : b;
}
inline double min(double a, double b) {
  return a < b ? a : b;
}
inline bool any(bool mask) {
  return mask;
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline double exp(double a) {
  return std::exp(a);
}
inline double log(double a) {
  return std::log(a);
}
inline double sum(double a) {
  return a;
}
inline double largest(double a) {
  return a;
}
inline double smallest(double a) {
  return a;
}

} // namespace mpfem
