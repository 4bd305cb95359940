#pragma once
// Vectors and second-order tensors whose components are plain doubles or packs.

#include <array>
#include <cstddef>

#include "solver/physics/pack.hpp"

namespace mpfem {

/// A vector; its unit is that of its use.
template <class S>
struct Vector3 {
  S x, y, z;
  const S& operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(const S& a, const Vector3& b) { return {a * b.x, a * b.y, a * b.z}; }
  Vector3 operator-() const { return {-x, -y, -z}; }
};

/// The vector whose three components lie at `components`.
inline Vector3<double> vector_of(const double* components) {
  return {components[0], components[1], components[2]};
}
inline Vector3<double> vector_of(const std::array<double, 3>& components) {
  return vector_of(components.data());
}
inline std::array<double, 3> array_of(const Vector3<double>& v) {
  return {v.x, v.y, v.z};
}
/// `along` times the unit vector of a coordinate axis.
inline Vector3<double> along_axis(std::size_t axis, double along) {
  return {axis == 0 ? along : 0.0, axis == 1 ? along : 0.0, axis == 2 ? along : 0.0};
}

template <class S>
S dot(const Vector3<S>& a, const Vector3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
Vector3<S> cross(const Vector3<S>& a, const Vector3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S>
S norm(const Vector3<S>& a) {
  return sqrt(dot(a, a));
}

/// Symmetric tensor.
template <class S>
struct SymmetricTensor {
  S xx, yy, zz, xy, yz, zx;
};

/// Deviator: five independent components, zz = -(xx + yy).
template <class S>
struct Deviator {
  S xx, yy, xy, yz, zx;
  S zz() const { return -(xx + yy); }
};

/// s : s
template <class S>
S double_contraction(const Deviator<S>& s) {
  const S zz = s.zz();
  return s.xx * s.xx + s.yy * s.yy + zz * zz + S(2.0) * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
}

/// Von Mises stress, sqrt(3/2 s : s).
template <class S>
S von_mises(const Deviator<S>& s) {
  return sqrt(S(1.5) * double_contraction(s));
}

/// sigma . a with sigma = s + m I.
template <class S>
Vector3<S> traction(const Deviator<S>& s, const S& mean, const Vector3<S>& a) {
  return {(s.xx + mean) * a.x + s.xy * a.y + s.zx * a.z, s.xy * a.x + (s.yy + mean) * a.y + s.yz * a.z,
          s.zx * a.x + s.yz * a.y + (s.zz() + mean) * a.z};
}

} // namespace mpfem
