#pragma once
// A number that counts the operations done with it, to tell how many a law of physics takes.

#include <cmath>
#include <cstdint>

namespace mpfem {

/// A double whose arithmetic adds to `operations`.
struct Counted {
  double v;
  static inline std::int64_t operations = 0; ///< additions, multiplications, divisions and square roots so far

  Counted() = default;
  Counted(double value) : v(value) {}
  static Counted result(double value) {
    ++operations;
    return {value};
  }
  friend Counted operator+(Counted a, Counted b) { return result(a.v + b.v); }
  friend Counted operator-(Counted a, Counted b) { return result(a.v - b.v); }
  friend Counted operator*(Counted a, Counted b) { return result(a.v * b.v); }
  friend Counted operator/(Counted a, Counted b) { return result(a.v / b.v); }
  Counted operator-() const { return {-v}; } // a sign costs nothing in a fused multiply-add
  friend bool operator<(Counted a, Counted b) { return a.v < b.v; }
  friend bool operator>(Counted a, Counted b) { return a.v > b.v; }
  friend bool operator<=(Counted a, Counted b) { return a.v <= b.v; }
  friend bool operator>=(Counted a, Counted b) { return a.v >= b.v; }
};
/// The functions that laws of physics use besides arithmetic (pack.hpp).
inline Counted select(bool mask, Counted yes, Counted no) {
  return mask ? yes : no;
}
/// The larger, the smaller; counted as no operation.
inline Counted max(Counted a, Counted b) {
  return a > b ? a : b;
}
inline Counted min(Counted a, Counted b) {
  return a < b ? a : b;
}
inline Counted sqrt(Counted a) {
  return Counted::result(std::sqrt(a.v));
}
inline Counted exp(Counted a) {
  return Counted::result(std::exp(a.v));
}
inline Counted log(Counted a) {
  return Counted::result(std::log(a.v));
}

} // namespace mpfem
