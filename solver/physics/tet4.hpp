#pragma once
// The linear tetrahedron with one Gauss point: its new stress and nodal forces from the positions of its nodes and
// their motion in the last step. One function serves packs of tets, plain numbers, and the count of its operations.

#include "solver/physics/elasticity.hpp"
#include "solver/physics/kinematics.hpp"
#include "solver/physics/plasticity.hpp"
#include "solver/physics/stable_step.hpp"

namespace mpfem {

/// What all tets of a grain share in one step.
struct TetConstants {
  ElasticModuli moduli;
  BulkViscosity viscosity;
  double wave_speed; ///< dilatational, mm/s
  double density;    ///< tonne/mm^3, in the reference state
  double step;       ///< s, the step that led to the current positions
};

/// The state of one tet.
template <class S>
struct TetState {
  Deviator<S> deviator; ///< Cauchy, MPa
  HardeningState<S> hardening;
};

/// What one step gives for a tet.
template <class S>
struct TetUpdate {
  TetState<S> state;
  Vector3<S> force[3]; ///< N, on nodes 1, 2, 3; minus their sum on node 0
  S volume;            ///< mm^3, at the end
  S volume_ratio;      ///< J
  S mean;              ///< MPa, mean stress with the viscous part
  S plastic_work;      ///< MPa, per volume
  S viscous_work;      ///< MPa, per volume
  S hypoelastic_work;  ///< MPa, per volume, that the rate form of the elastic law does not return
  S strain_increment_square;
};

/// One step of a tet. `edge` are nodes 1, 2, 3 relative to node 0 at the end of the step (mm), `displacement` their
/// displacements relative to node 0 in the step (mm); `inverse_volume` 1 over the reference volume
/// (1/mm^3); `length` the length of bulk viscosity (mm). `elastic_mean` gives the elastic mean stress (MPa) for the
/// tet's own volume ratio: this is where elements that average pressure differ.
template <class S, class Law, class ElasticMean>
TetUpdate<S> update_tet(const Law& law, const TetConstants& c, const Vector3<S> (&edge)[3],
                        const Vector3<S> (&displacement)[3], const TetState<S>& old, const S& inverse_volume,
                        const S& length, const ElasticMean& elastic_mean) {
  TetUpdate<S> result;
  // What does not depend on the stress comes first, so that processors work on it while they wait for divisions.
  // 1. Geometry at the half step and at the end.
  Vector3<S> middle[3];
  for (int i = 0; i < 3; ++i) middle[i] = edge[i] - S(0.5) * displacement[i];
  const auto middle_geometry = tet_geometry(middle[0], middle[1], middle[2]);
  const auto geometry = tet_geometry(edge[0], edge[1], edge[2]);
  result.volume = S(1.0 / 6.0) * geometry.det;
  result.volume_ratio = result.volume * inverse_volume;

  // 2. Strain increment and rotation at the half step; pressure from the volume at the end, bulk viscosity from the
  //    rate; deviator.
  const auto increment = displacement_increment(middle_geometry, displacement);
  const auto& e = increment.strain;
  const S volumetric_strain = e.xx + e.yy + e.zz;
  const S viscous = viscous_pressure(c.viscosity, c.wave_speed, S(c.density) / result.volume_ratio, length,
                                     volumetric_strain * S(1.0 / c.step));
  result.mean = elastic_mean(result.volume_ratio) - viscous;
  result.viscous_work = -(viscous * volumetric_strain);
  const auto returned = update_deviator(law, c.moduli, old.deviator, old.hardening, increment);
  result.state = {returned.deviator, returned.hardening};
  result.plastic_work = returned.plastic_work;
  result.hypoelastic_work = hypoelastic_work(c.moduli, returned.deviator, volumetric_strain);

  // 3. Forces f_i = -V sigma grad N_i = -sigma a_i / 6.
  for (int i = 0; i < 3; ++i)
    result.force[i] = S(-1.0 / 6.0) * traction(returned.deviator, result.mean, geometry.area[i]);
  result.strain_increment_square =
      e.xx * e.xx + e.yy * e.yy + e.zz * e.zz + S(2.0) * (e.xy * e.xy + e.yz * e.yz + e.zx * e.zx);
  return result;
}

} // namespace mpfem
