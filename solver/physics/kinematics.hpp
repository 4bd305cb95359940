#pragma once
// Incremental kinematics of the linear tetrahedron: strain increment and spin at the half step, and the
// Hughes-Winget rotation that makes the Jaumann rate exact under rigid rotation (Hughes & Winget 1980).

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Edges from node 0 and their cross products. det = 6 V; gradient of shape function i is area[i-1] / det (i = 1, 2, 3)
/// and that of node 0 minus their sum.
template <class S>
struct TetGeometry {
  Vector3<S> area[3]; ///< mm^2: e2 x e3, e3 x e1, e1 x e2
  S det;              ///< mm^3
};

/// From the edges (mm) from node 0 to nodes 1, 2, 3.
template <class S>
TetGeometry<S> tet_geometry(const Vector3<S>& e1, const Vector3<S>& e2, const Vector3<S>& e3) {
  TetGeometry<S> geometry{{cross(e2, e3), cross(e3, e1), cross(e1, e2)}, S(0.0)};
  geometry.det = dot(e1, geometry.area[0]);
  return geometry;
}

/// Symmetric part and axial vector of the displacement increment's gradient.
template <class S>
struct Increment {
  SymmetricTensor<S> strain; ///< dimensionless
  Vector3<S> rotation;       ///< axial vector of the spin increment, rad
};

/// Gradient of the displacement increment with respect to the half-step configuration. `du` are the displacement
/// increments of nodes 1, 2, 3 relative to node 0 (mm); `middle` the geometry half way.
template <class S>
Increment<S> displacement_increment(const TetGeometry<S>& middle, const Vector3<S> (&du)[3]) {
  const Vector3<S>* a = middle.area;
  const S hxx = du[0].x * a[0].x + du[1].x * a[1].x + du[2].x * a[2].x; // the gradient times det
  const S hxy = du[0].x * a[0].y + du[1].x * a[1].y + du[2].x * a[2].y;
  const S hxz = du[0].x * a[0].z + du[1].x * a[1].z + du[2].x * a[2].z;
  const S hyx = du[0].y * a[0].x + du[1].y * a[1].x + du[2].y * a[2].x;
  const S hyy = du[0].y * a[0].y + du[1].y * a[1].y + du[2].y * a[2].y;
  const S hyz = du[0].y * a[0].z + du[1].y * a[1].z + du[2].y * a[2].z;
  const S hzx = du[0].z * a[0].x + du[1].z * a[1].x + du[2].z * a[2].x;
  const S hzy = du[0].z * a[0].y + du[1].z * a[1].y + du[2].z * a[2].y;
  const S hzz = du[0].z * a[0].z + du[1].z * a[1].z + du[2].z * a[2].z;
  const S inverse = S(1.0) / middle.det, half = S(0.5) * inverse;
  return {{inverse * hxx, inverse * hyy, inverse * hzz, half * (hxy + hyx), half * (hyz + hzy), half * (hzx + hxz)},
          {half * (hzy - hyz), half * (hxz - hzx), half * (hyx - hxy)}};
}

/// R s R^T with R = (I - W/2)^-1 (I + W/2), W the spin increment with axial vector `rotation`. In closed form
/// R = I + 2 (T + T^2) / (1 + t.t), t = rotation/2, T its cross-product matrix: a proper rotation for any increment.
template <class S>
Deviator<S> rotated(const Deviator<S>& s, const Vector3<S>& rotation) {
  const Vector3<S> t = S(0.5) * rotation;
  const S two(2.0), one(1.0);
  const S c = two / (one + dot(t, t));
  const S rxx = one - c * (t.y * t.y + t.z * t.z), ryy = one - c * (t.x * t.x + t.z * t.z),
          rzz = one - c * (t.x * t.x + t.y * t.y);
  const S rxy = c * (t.x * t.y - t.z), ryx = c * (t.x * t.y + t.z);
  const S rxz = c * (t.x * t.z + t.y), rzx = c * (t.x * t.z - t.y);
  const S ryz = c * (t.y * t.z - t.x), rzy = c * (t.y * t.z + t.x);
  const S szz = s.zz();
  // rows of R s
  const S axx = rxx * s.xx + rxy * s.xy + rxz * s.zx, axy = rxx * s.xy + rxy * s.yy + rxz * s.yz,
          axz = rxx * s.zx + rxy * s.yz + rxz * szz;
  const S ayx = ryx * s.xx + ryy * s.xy + ryz * s.zx, ayy = ryx * s.xy + ryy * s.yy + ryz * s.yz,
          ayz = ryx * s.zx + ryy * s.yz + ryz * szz;
  const S azx = rzx * s.xx + rzy * s.xy + rzz * s.zx, azy = rzx * s.xy + rzy * s.yy + rzz * s.yz,
          azz = rzx * s.zx + rzy * s.yz + rzz * szz;
  return {axx * rxx + axy * rxy + axz * rxz, ayx * ryx + ayy * ryy + ayz * ryz, axx * ryx + axy * ryy + axz * ryz,
          ayx * rzx + ayy * rzy + ayz * rzz, azx * rxx + azy * rxy + azz * rxz};
}

} // namespace mpfem
