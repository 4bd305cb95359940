#pragma once
// J2 plasticity: radial return of a trial deviator onto the von Mises cylinder (Simo & Hughes 1998, box 3.1).

#include "solver/physics/elasticity.hpp"
#include "solver/physics/hardening.hpp"
#include "solver/physics/kinematics.hpp"
#include "solver/physics/tensor.hpp"

namespace mpfem {

/// The state at the end of an increment.
template <class S>
struct ReturnedStress {
  Deviator<S> deviator; ///< MPa
  HardeningState<S> hardening;
  S plastic_work; ///< plastic work per volume in the increment, MPa
};

/// 1. trial von Mises stress; 2. admissible where it does not exceed the flow stress; 3. else scale the deviator back
/// to the flow stress at the end of the increment. `shear` in MPa.
template <class S, class Law>
ReturnedStress<S> radial_return(const Law& law, double shear, const Deviator<S>& trial, const HardeningState<S>& old) {
  if constexpr (!Law::yields) {
    return {trial, old, S(0.0)};
  } else {
    const S q_squared = S(1.5) * double_contraction(trial);
    const auto yielding = q_squared > old.flow_stress * old.flow_stress;
    if (!any(yielding)) return {trial, old, S(0.0)};
    const S q = select(yielding, sqrt(q_squared), old.flow_stress);
    const HardeningState<S> end = law.end_of_increment(q, old, 3.0 * shear);
    const S factor = select(yielding, end.flow_stress / max(q, S(Resolution<S>::tiny)), S(1.0));
    const S increment = select(yielding, end.plastic_strain - old.plastic_strain, S(0.0));
    // Mean of the flow stresses at both ends: second order in the increment.
    return {{factor * trial.xx, factor * trial.yy, factor * trial.xy, factor * trial.yz, factor * trial.zx},
            {select(yielding, end.flow_stress, old.flow_stress), old.plastic_strain + increment},
            S(0.5) * (end.flow_stress + old.flow_stress) * increment};
  }
}

/// The constitutive step of a material point: the elastic predictor, then the return. One half of the predictor is
/// added before the deviator is rotated with the material (Hughes-Winget), one half after. The strain increment is that
/// of the half-step configuration, half a rotation behind the end of the step. Added as a whole at the end, it would be
/// rotated by that angle against the stress: an elasticity without symmetry, which feeds energy into the vibrations of
/// a spinning grain.
template <class S, class Law>
ReturnedStress<S> update_deviator(const Law& law, const ElasticModuli& moduli, const Deviator<S>& old,
                                  const HardeningState<S>& hardening, const Increment<S>& increment) {
  const ElasticModuli half{0.5 * moduli.bulk, 0.5 * moduli.shear};
  const auto before = elastic_predictor(half, old, increment.strain);
  const auto trial = elastic_predictor(half, rotated(before, increment.rotation), increment.strain);
  return radial_return(law, moduli.shear, trial, hardening);
}

} // namespace mpfem
