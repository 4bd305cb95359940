#pragma once
// The explicit time integration of a packing: state, one step, and what can be observed between two halves of a step.
//
// Time level n: positions x_n, stresses and internal forces at x_n, velocities of the half step n - 1/2. A step is
//   evaluate_forces()   contact and walls at x_n added to the internal forces
//   advance()           v_{n+1/2}, x_{n+1}, stresses and internal forces at x_{n+1}
// and everything is observed between the two, where all terms of the energy balance belong to time n.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/boundary/grips.hpp"
#include "solver/boundary/walls.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/model/surface.hpp"
#include "solver/kernels/thread_team.hpp"
#include "solver/model/model.hpp"
#include "solver/run/loading.hpp"
#include "solver/run/pace.hpp"
#include "solver/run/profile.hpp"
#include "solver/run/programme.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Everything of a run besides the model and its contact points. Plain numbers: a checkpoint stores them as they are.
struct RunState {
  // counters
  std::int64_t step = 0;
  std::int64_t stage = 0;
  std::int64_t rows_in_stage = 0;         ///< history rows written in this stage
  std::int64_t snapshots_passed = 0;      ///< relative densities of output.snapshot_relative_densities already passed
  std::int64_t steps_since_estimate = 0;  ///< since the stable step was estimated
  std::int64_t controlled_by_contact = 0; ///< 1: contact lowers the step by more than 5 %
  std::int64_t searches = 0;
  std::int64_t stage_ended = 0;              ///< 1: the stage has reached what ends it
  std::int64_t absent_axes = 0;              ///< axes whose walls are away, as bits 1 (x), 2 (y), 4 (z)
  std::int64_t checkpoints_passed = 0;       ///< of output.checkpoint_relative_densities
  std::int64_t estimates_since_spectrum = 0; ///< of the stable step, since the frequencies of whole grains were found
  // times
  double time = 0;        ///< s
  double stage_time = 0;  ///< s, since the stage began, by the stage's clock (solver/run/pace.hpp)
  double stable_step = 0; ///< s, estimate times safety factor
  double last_step = 0;   ///< s, the step that led to the present positions; 0 at the start
  double strain_since_estimate = 0;
  double strain_rate = 0;   ///< 1/s, largest in the last step
  double spectrum_rate = 0; ///< 1/s, volumetric, when the frequencies of whole grains were last found
  // energies, mJ
  double initial_energy = 0;
  double plastic_dissipation = 0;
  double viscous_dissipation = 0;
  double damping_dissipation = 0;
  double external_work = 0;
  double grip_work_ahead = 0;   ///< half of the grips' forces times the step that follows
  double damping_force = 0;     ///< N, sum of magnitudes at the last advance
  double mean_stress = 0;       ///< MPa, at the last evaluation
  double stage_mean_stress = 0; ///< MPa, when the stage began
  // walls
  std::array<double, 3> initial_lengths{}; ///< mm
  std::array<double, 3> stage_low{};       ///< mm, box when the stage began
  std::array<double, 3> stage_high{};
  std::array<double, 3> low{}; ///< mm, now
  std::array<double, 3> high{};
  std::array<double, 6> last_wall_force{}; ///< N, at the time level before
  std::array<double, 6> last_wall_move{};  ///< mm inward, in the last step
  LoadingState loading;                    ///< of the stage, where its walls are driven or held by stresses
  PaceState pace;                          ///< of the stage, where it chooses its speed
};

/// Grains when the largest frequency of each as a whole was last found, and how much that may have grown since; [grains] but for one.
struct GrainSteps {
  std::vector<double> whole;   ///< s, stable step
  std::vector<double> growth;  ///< factor by which single tets' frequencies squared have grown since, at most
  std::vector<double> contact; ///< 1/s^2, [nodes]: share of contact in the frequency squared, then
};

/// How a stage ended.
struct StageResult {
  std::string name;
  std::string ended_by;   ///< "relative density 0.92", and which speed it chose where it was to
  double overshoot = 0;   ///< MPa by which a stress that ended or turned the stage was passed
  double hold_error = 0;  ///< MPa, largest deviation of a held stress, averaged over a transit of the box
  double hold_stress = 0; ///< MPa, the largest stress to be held
  double hold_rms = 0;    ///< MPa, root mean square of the deviation at every step
};

/// One line of the history; the columns are those of /history in results-schema.
struct HistoryRow {
  double time, step, stage, relative_density, relative_density_current;
  std::array<double, 3> box_lengths;
  std::array<double, 6> wall_stress;
  double mean_stress, deviatoric_stress, axial_strain, volumetric_strain;
  double kinetic_energy, elastic_energy, plastic_dissipation, damage_dissipation, bond_energy, contact_energy,
      viscous_dissipation, damping_dissipation, external_work, energy_residual;
  double contact_area, surface_area, bonded_area, bonds, mean_damage, coordination_number, max_penetration,
      damping_drag_ratio, time_step;
};

class Simulation {
public:
  /// Begins at rest apart from the scenario's initial velocities. With `branch`, the first stage is not begun: that waits
  /// for a checkpoint and begin_branch(). Throws InputError where grains overlap at the start.
  Simulation(Model model, const Scenario& scenario, ThreadTeam& team, bool branch = false);

  Model& model() { return model_; }
  const Model& model() const { return model_; }
  Contact& contact() { return contact_; }
  const Contact& contact() const { return contact_; }
  RunState& state() { return state_; }
  const RunState& state() const { return state_; }
  GrainSteps& grain_steps() { return grain_steps_; }
  const GrainSteps& grain_steps() const { return grain_steps_; }
  Profile& profile() { return profile_; }
  const Profile& profile() const { return profile_; }

  /// Takes up model, contact and state that were replaced from a checkpoint.
  void restored(Grips grips);

  /// Begins the stage `state().stage` at the present box.
  void begin_stage();
  /// After a checkpoint of another run: its state is the beginning of this scenario's first stage. Candidates and step
  /// are found anew with this scenario's settings; what energies jump by, where those differ, is not in the residual.
  void begin_branch();
  /// s: how long the stage takes, or is expected to take.
  double stage_duration() const { return loading_ ? loading_->expected_duration() : motion_->expected_duration(); }
  double stage_fraction_done() const {
    return loading_ ? state_.loading.fraction_done : motion_->fraction_done(state_.stage_time, state_.mean_stress);
  }
  /// True when the present time level is the stage's last.
  bool stage_complete() const { return state_.stage_ended != 0 || state_.stage_time >= motion_->duration(); }

  /// Adds contact and wall forces at the present positions.
  void evaluate_forces();
  /// One step of central differences. Throws SimulationError naming the element or grain that failed.
  void advance();

  /// All observed quantities; valid between evaluate_forces() and advance().
  HistoryRow observe();
  double relative_density() const;
  const Walls& walls() const { return walls_; }
  /// What is to be said of a stage that is complete, after evaluate_forces().
  StageResult stage_result();
  const Grips& grips() const { return grips_; }
  const Stage& stage() const { return scenario_.stages[static_cast<std::size_t>(state_.stage)]; }

private:
  /// What the next advance does: its step, where the walls go, and the constants of the velocity update.
  struct Plan {
    double step;
    double stage_time; ///< s, by which the stage's clock moves on
    Walls walls;
    std::array<double, 3> sliding; ///< mm, of the grips
    Advance advance;
  };
  Plan plan_step() const;
  BondSums total_bonds();
  void make_motion();
  void change_walls();
  void return_walls(std::size_t axis);
  LoadingObservation observe_loading();
  std::array<double, 6> wall_stress() const;
  void regulate_pace();
  double next_step() const;
  /// `anew`: with the frequencies of whole grains, whenever they were last found.
  void estimate_stable_step(bool anew = false);
  double damping_rate() const;
  [[noreturn]] void report_bad_grain(int grain) const;
  void refuse_overlap(int grain);

  Model model_;
  const Scenario& scenario_;
  ThreadTeam& team_;
  Contact contact_;
  Walls walls_;
  RunState state_;
  Profile profile_;
  std::optional<StageMotion> motion_;
  std::optional<LoadingControl> loading_;
  std::optional<PaceControl> pace_;
  Grips grips_;
  double margin_ = 0;       ///< mm, of the contact search
  double damping_rate_ = 0; ///< 1/s, of the next advance
  bool rebase_ledger_ = false;

  // per grain, summed in grain order
  std::vector<Bounds> bounds_;
  std::vector<ContactSums> contact_sums_;
  std::vector<WallSums> wall_sums_;
  std::vector<GripSums> grip_sums_;
  std::vector<AdvanceSums> advance_sums_;
  std::vector<ElementSums> element_sums_;
  std::vector<StableStep> stable_steps_;
  GrainSteps grain_steps_;
  std::optional<PaceState> regulated_; ///< takes over when the step has been made that is planned at the old pace
  std::vector<double> stiffness_rate_;
};

} // namespace mpfem
