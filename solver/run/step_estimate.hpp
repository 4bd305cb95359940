#pragma once
// When the stable step is estimated again, and which grain sets it.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/boundary/box.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/kernels/thread_team.hpp"
#include "solver/model/grain_steps.hpp"
#include "solver/model/model.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// What grains touch besides each other.
struct Boundaries {
  const Box& box;
  const Tools& tools;
};

/// The stable step, and when it has to be estimated again.
class StepEstimate {
public:
  struct State {
    double stable_step = 0;                ///< s, estimate times safety factor
    bool controlled_by_contact = false;    ///< contact lowers the step by more than 5 %
    double strain_rate = 0;                ///< 1/s, largest in the last step
    std::int64_t steps_since_estimate = 0; ///< since all grains were estimated

    template <class Self, class Visitor>
    static void for_each_field(Self& s, Visitor&& visit) {
      visit("step.stable", s.stable_step), visit("step.controlled_by_contact", s.controlled_by_contact);
      visit("step.strain_rate", s.strain_rate), visit("step.steps_since_estimate", s.steps_since_estimate);
    }
  };

  StepEstimate(const Model& model, const NumericsParameters& numerics, const Communicator& ranks);

  const State& state() const { return state_; }
  const GrainSteps& grain_steps() const { return grain_steps_; }
  double stable_step() const { return state_.stable_step; }

  /// Takes in the largest strain of a grain's tets in a step; returns their sum since the grain's estimate. For grains
  /// that differ, it may be called from several threads at once.
  double add_strain(std::int32_t grain, double strain);
  /// The largest of all grains.
  struct StrainOfStep {
    double largest;        ///< of a tet in the last step
    double since_estimate; ///< what add_strain() returned
  };
  /// True after a step (s) if the estimate is to be renewed.
  bool is_due_after(const StrainOfStep& strain, double step);
  /// Collective. Estimates the stable step of the grains that are due; sets their tets' lengths in the model. `anew`:
  /// of all grains, by the frequency of each as it is now.
  void renew(Model& model, const Contact& contact, const Boundaries& boundaries, std::span<const Bounds> bounds,
             ThreadTeam& team, bool anew);
  /// The next step is followed by an estimate: nothing has touched yet.
  void renew_after_next_step();
  /// Restore what a checkpoint holds.
  void restore(const State& state) { state_ = state; }
  void restore(GrainSteps grain_steps) { grain_steps_ = std::move(grain_steps); }

private:
  /// What a grain's estimate depends on.
  struct Surroundings {
    Model& model;
    const Contact& contact;
    const Boundaries& boundaries;
    std::span<const Bounds> bounds;
    double rate;              ///< 1/s, largest volumetric rate
    double quadratic_damping; ///< share of the critical damping that quadratic bulk viscosity may reach at that rate
  };
  /// An estimate as ranks exchange it.
  struct GrainStep {
    double step;          ///< s
    double contact_share; ///< as in GrainSteps
    double computed;      ///< 1: set by a computed frequency, 0: by a bound on what has grown since
  };
  bool all_are_due() const;
  std::vector<std::int32_t> due_grains(const Model& model, bool all) const;
  void set_stiffness_rate(const Surroundings& now, std::int32_t grain);
  bool spectrum_is_due(const Surroundings& now, std::size_t grain) const;
  double compute_spectrum(const Surroundings& now, std::int32_t grain, double step);
  double bound_since_spectrum(const Model& model, std::int32_t grain, double growth);
  void estimate(const Surroundings& now, std::int32_t grain, bool anew);
  GrainStep last_estimate(std::int32_t grain) const;
  std::int32_t grain_with_shortest_step(const Ownership& ownership) const;
  GrainStep shortest_step(const Surroundings& now);

  const Communicator* ranks_;
  NumericsParameters numerics_;
  State state_;
  GrainSteps grain_steps_;
  LazyArray<double> stiffness_rate_; ///< 1/s^2, [nodes], of contact and walls
};

} // namespace mpfem
