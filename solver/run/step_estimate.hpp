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
    double stable_step = 0;             ///< s, estimate times safety factor
    bool controlled_by_contact = false; ///< contact lowers the step by more than 5 %
    double strain_rate = 0;             ///< 1/s, largest in the last step
    double strain_since_estimate = 0;
    std::int64_t steps_since_estimate = 0;
    double spectrum_rate = 0; ///< 1/s, volumetric, when the frequencies of whole grains were last found
    std::int64_t estimates_since_spectrum = 0;

    template <class Self, class Visitor>
    static void for_each_field(Self& s, Visitor&& visit) {
      visit("step.stable", s.stable_step), visit("step.controlled_by_contact", s.controlled_by_contact);
      visit("step.strain_rate", s.strain_rate), visit("step.strain_since_estimate", s.strain_since_estimate);
      visit("step.steps_since_estimate", s.steps_since_estimate), visit("step.spectrum_rate", s.spectrum_rate);
      visit("step.estimates_since_spectrum", s.estimates_since_spectrum);
    }
  };

  StepEstimate(const Model& model, const NumericsParameters& numerics, const Communicator& ranks);

  const State& state() const { return state_; }
  const GrainSteps& grain_steps() const { return grain_steps_; }
  double stable_step() const { return state_.stable_step; }

  /// Takes in the largest strain of a step (s). True when the estimate is to be renewed.
  bool is_due_after(double strain, double step);
  /// Collective. Estimates the stable step of the current state; sets the tets' lengths in the model. `anew`: finds the
  /// frequencies of whole grains even if they were found recently.
  void renew(Model& model, const Contact& contact, const Boundaries& boundaries, std::span<const Bounds> bounds,
             ThreadTeam& team, bool anew);
  /// The next step is followed by an estimate: nothing has touched yet.
  void renew_after_next_step();
  /// Restore what a checkpoint holds.
  void restore(const State& state) { state_ = state; }
  void restore(GrainSteps grain_steps) { grain_steps_ = std::move(grain_steps); }

private:
  /// The step of a grain, s, and whether it is set by a computed frequency, not by a bound on what has grown since.
  struct GrainStep {
    double step;
    bool computed;
  };
  bool spectra_are_due(const Model& model, double rate);
  void set_stiffness_rate(const Model& model, const Contact& contact, const Boundaries& boundaries,
                          const Bounds& bounds, int grain);
  GrainStep step_of_grain(const Model& model, int grain, double rate, bool anew);
  double renew_grain(const Model& model, int grain, double rate);
  double bound_since_spectrum(const Model& model, int grain, double found) const;
  std::size_t compute_shortest(const Model& model, double rate, std::span<GrainStep> steps);

  const Communicator* ranks_;
  NumericsParameters numerics_;
  State state_;
  GrainSteps grain_steps_;
  std::vector<StableStep> of_tets_;  ///< [grains]
  LazyArray<double> stiffness_rate_; ///< 1/s^2, [nodes], of contact and walls
};

} // namespace mpfem
