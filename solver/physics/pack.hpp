#pragma once
// A pack of scalars that computes lane by lane, so that each law of physics is written once and serves as plain double
// and as SIMD, of doubles or floats. `select` stands for `if`. It is built on the compiler's vector types; except in
// one test, no instruction set is named here.

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#if defined(__AVX__)
#include <immintrin.h>
#endif

/// Put before functions whose calls are all to be inlined: packs passed to functions go through memory. Builds with
/// sanitizers leave it out (cmake/compiler.cmake): gcc needs more time for the element pass, inlined and instrumented,
/// than for everything else together.
#ifndef MPFEM_FLATTEN
#define MPFEM_FLATTEN [[gnu::flatten]]
#endif

namespace mpfem {

/// Bytes of a native pack on the machine that the program is built for, and the lanes of such a pack of doubles or
/// floats. A scalar build, for comparison, has packs of one double; float kernels use at least four lanes.
#if defined(MPFEM_SCALAR)
inline constexpr int native_bytes = 8;
#elif defined(__AVX512F__)
inline constexpr int native_bytes = 64;
#elif defined(__AVX__)
inline constexpr int native_bytes = 32;
#else
inline constexpr int native_bytes = 16;
#endif
template <class Real>
inline constexpr int native_lanes_of = sizeof(Real) == 4 && native_bytes < 16 ? 4 : native_bytes / int{sizeof(Real)};
inline constexpr int native_lanes = native_lanes_of<double>;

/// The compiler's vector types. Written out one by one: gcc drops the attribute where the width is a template
/// parameter.
template <int W, class Real>
struct NativeVector;
template <>
struct NativeVector<1, double> {
  typedef double Numbers __attribute__((vector_size(8)));
  typedef std::int64_t Truths __attribute__((vector_size(8)));
};
template <>
struct NativeVector<2, double> {
  typedef double Numbers __attribute__((vector_size(16)));
  typedef std::int64_t Truths __attribute__((vector_size(16)));
};
template <>
struct NativeVector<4, double> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef std::int64_t Truths __attribute__((vector_size(32)));
};
template <>
struct NativeVector<8, double> {
  typedef double Numbers __attribute__((vector_size(64)));
  typedef std::int64_t Truths __attribute__((vector_size(64)));
};
template <>
struct NativeVector<4, float> {
  typedef float Numbers __attribute__((vector_size(16)));
  typedef std::int32_t Truths __attribute__((vector_size(16)));
};
template <>
struct NativeVector<8, float> {
  typedef float Numbers __attribute__((vector_size(32)));
  typedef std::int32_t Truths __attribute__((vector_size(32)));
};
template <>
struct NativeVector<16, float> {
  typedef float Numbers __attribute__((vector_size(64)));
  typedef std::int32_t Truths __attribute__((vector_size(64)));
};

/// Lane-wise truth values of a Pack<W, Real>.
template <int W, class Real = double>
struct Mask {
  using Native = typename NativeVector<W, Real>::Truths;
  Native v;
  friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
  Mask operator!() const { return {~v}; }
};

/// W numbers on which every operation acts lane by lane.
template <int W, class Real = double>
struct Pack {
  using Native = typename NativeVector<W, Real>::Numbers;
  using Truths = Mask<W, Real>;
  static constexpr int lanes = W;
  Native v;

  Pack() = default;
  Pack(Native native) : v(native) {}
  Pack(double scalar) : v(Native{} + static_cast<Real>(scalar)) {}

  Real operator[](int lane) const { return v[lane]; }

  static Pack load(const Real* aligned) { return *reinterpret_cast<const Native*>(aligned); }
  void store(Real* aligned) const { *reinterpret_cast<Native*>(aligned) = v; }

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
  friend Truths operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Truths operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Truths operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  friend Truths operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
};

using NativePack = Pack<native_lanes>;

/// What a scalar type resolves: `tiny` keeps divisors and arguments of logarithms from zero; an iteration has converged
/// once its number changes by less than `settled` of itself.
template <class S>
struct Resolution {
  static constexpr double tiny = 1e-300, settled = 1e-15;
};
template <int W>
struct Resolution<Pack<W, float>> {
  static constexpr double tiny = 1e-37, settled = 5e-7;
};

/// Lane by lane `yes` where the mask holds, else `no`.
template <int W, class Real>
Pack<W, Real> select(Mask<W, Real> mask, Pack<W, Real> yes, Pack<W, Real> no) {
  return mask.v ? yes.v : no.v;
}
template <int W, class Real>
Pack<W, Real> max(Pack<W, Real> a, Pack<W, Real> b) {
  return a.v > b.v ? a.v : b.v;
}
template <int W, class Real>
Pack<W, Real> min(Pack<W, Real> a, Pack<W, Real> b) {
  return a.v < b.v ? a.v : b.v;
}
/// True if the mask holds in at least one lane.
template <int W, class Real>
bool any(Mask<W, Real> mask) {
#if defined(__AVX512F__) // one instruction instead of twenty
  if constexpr (sizeof(mask.v) == 64) {
    const auto bits = reinterpret_cast<__m512i>(mask.v);
    return _mm512_test_epi64_mask(bits, bits) != 0;
  }
#endif
#if defined(__AVX__) // one instruction instead of ten
  if constexpr (sizeof(mask.v) == 32) {
    if constexpr (W == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.v)) != 0;
    return _mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)) != 0;
  }
#endif
  std::int64_t bits = 0;
  for (int i = 0; i < W; ++i) bits |= mask.v[i];
  return bits != 0;
}
template <int W, class Real>
Pack<W, Real> sqrt(Pack<W, Real> a) {
  Pack<W, Real> root;
  for (int i = 0; i < W; ++i) root.v[i] = std::sqrt(a.v[i]);
  return root;
}
// exp and log are Eigen's vectorised ones (errors of a few units in the last place).
namespace detail {
template <int W, class Real>
auto as_array(Pack<W, Real>& a) {
  return Eigen::Map<Eigen::Array<Real, W, 1>, Eigen::Aligned16>(reinterpret_cast<Real*>(&a.v));
}
} // namespace detail
template <int W, class Real>
Pack<W, Real> exp(Pack<W, Real> a) {
  Pack<W, Real> result;
  detail::as_array(result) = detail::as_array(a).exp();
  return result;
}
template <int W, class Real>
Pack<W, Real> log(Pack<W, Real> a) {
  Pack<W, Real> result;
  detail::as_array(result) = detail::as_array(a).log();
  return result;
}
/// Sum of all lanes, added in doubles.
template <int W, class Real>
double sum(Pack<W, Real> a) {
  double total = 0;
  for (int i = 0; i < W; ++i) total += a.v[i];
  return total;
}
/// The largest of all lanes.
template <int W, class Real>
double largest(Pack<W, Real> a) {
  Real value = a.v[0];
  for (int i = 1; i < W; ++i) value = a.v[i] > value ? a.v[i] : value;
  return value;
}
/// The smallest of all lanes.
template <int W, class Real>
double smallest(Pack<W, Real> a) {
  Real value = a.v[0];
  for (int i = 1; i < W; ++i) value = a.v[i] < value ? a.v[i] : value;
  return value;
}

/// A sum of many packs that is exact to the rounding of its terms, for floats too: partial sums of floats go into a
/// double now and then.
template <class S>
class LongSum {
public:
  void add(const S& term) {
    part_ += term;
    if constexpr (sizeof(term.v[0]) < sizeof(double)) {
      if (++terms_ % 16 != 0) return;
      total_ += sum(part_);
      part_ = S(0.0);
    }
  }
  double value() const { return total_ + sum(part_); }

private:
  S part_{0.0};
  double total_ = 0;
  int terms_ = 0;
};

// The same functions for one plain double.
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
