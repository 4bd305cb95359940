#pragma once
// The explicit time integration of a packing: its state and one step.
//
// Time level n: positions x_n, stresses and internal forces at x_n, velocities of the half step n - 1/2. A step is
//   evaluate_forces()   contact and walls at x_n added to the internal forces
//   advance()           v_{n+1/2}, x_{n+1}, stresses and internal forces at x_{n+1}
// and everything is observed between the two, where all terms of the energy balance belong to time n.
//
// simulation.cpp has the step, simulation_stages.cpp the beginning of stages, simulation_state.cpp checkpoints and
// branches.

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/boundary/box.hpp"
#include "solver/boundary/container.hpp"
#include "solver/boundary/grips.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/boundary/wall_friction.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/kernels/surface.hpp"
#include "solver/kernels/thread_team.hpp"
#include "solver/model/model.hpp"
#include "solver/output/history_row.hpp"
#include "solver/run/energy_ledger.hpp"
#include "solver/run/ghosts.hpp"
#include "solver/run/profile.hpp"
#include "solver/run/stage_run.hpp"
#include "solver/run/step_estimate.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Where the run is, and the values of its last step that no other part keeps.
struct RunState {
  std::int64_t step = 0;
  std::int64_t stage = 0;                  ///< index
  double time = 0;                         ///< s
  double last_step = 0;                    ///< s, the step that led to the current positions; 0 at the start
  double damping_force = 0;                ///< N, sum of magnitudes at the last advance
  double weight_potential = 0;             ///< mJ, work of gravity from the origin to where the nodes are
  std::array<double, 3> initial_lengths{}; ///< mm, of the cell

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("run.step", s.step), visit("run.stage", s.stage);
    visit("run.time", s.time), visit("run.last_step", s.last_step), visit("run.damping_force", s.damping_force);
    visit("run.weight_potential", s.weight_potential);
    visit("run.initial_lengths", s.initial_lengths);
  }
};

/// Sums over the last evaluation of forces, of one grain or of all.
struct ForceSums {
  double weight_potential = 0; ///< mJ, work of gravity from the origin to where the nodes are; 0 without gravity
  ContactSums contact;
  BoxSums box;
  WallFrictionSums wall_friction;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    visit.sum(s.weight_potential);
    ContactSums::for_each_term(s.contact, visit);
    BoxSums::for_each_term(s.box, visit);
    WallFrictionSums::for_each_term(s.wall_friction, visit);
  }
};

/// Sums over the last advance, of one grain or of all.
struct MotionSums {
  AdvanceSums advance;
  ElementSums elements;
  double travel = 0;                ///< mm, largest of a grain since the search
  double strain_since_estimate = 0; ///< sum of the largest strains of a tet in each step

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    AdvanceSums::for_each_term(s.advance, visit);
    ElementSums::for_each_term(s.elements, visit);
    visit.largest(s.travel), visit.largest(s.strain_since_estimate);
  }
};

/// A packing with everything that acts on it, and one step of its motion.
class Simulation {
public:
  /// Begins at rest apart from the scenario's initial velocities. With `branch`, the first stage is not begun: that
  /// waits for restore() and begin_branch(). `scenario`, `team` and `ranks` must outlive the simulation. Throws
  /// InputError if grains overlap at the start. `model` divides the grains among the ranks. With several ranks, this
  /// and all non-const members are collective, and so are observe() and others that say so.
  Simulation(Model model, const Scenario& scenario, ThreadTeam& team, bool branch = false,
             const Communicator& ranks = alone());

  // ---- the step
  /// Adds contact and wall forces at the current positions. Throws SimulationError where contact cannot hold.
  void evaluate_forces();
  /// One step of central differences. Throws SimulationError naming the element or grain that failed.
  void advance();

  // ---- stages
  /// Begins the stage of this index with the current cell.
  void begin_stage(std::int64_t stage);
  void begin_next_stage() { begin_stage(state_.stage + 1); }
  bool stage_complete() const { return stage_run_->complete(); }
  /// The result of a stage that is complete, after evaluate_forces().
  StageResult stage_result() const;

  // ---- what can be observed, between evaluate_forces() and advance()
  HistoryRow observe() const; ///< collective
  double relative_density() const;
  /// At the start of a branch, energies jump if its settings differ. This is no part of the balance, so the residual of
  /// the branch's first row is removed from it.
  void reset_energy_balance(HistoryRow& first_row);

  const Scenario& scenario() const { return *scenario_; }
  const Communicator& ranks() const { return *ranks_; }
  const Ghosts& ghosts() const { return ghosts_; }
  const Model& model() const { return model_; }
  const Contact& contact() const { return contact_; }
  const Box& box() const { return box_; }
  const WallFriction& wall_friction() const { return wall_friction_; }
  const Tools& tools() const { return tools_; }
  const Grips& grips() const { return grips_; }
  const RunState& state() const { return state_; }
  const EnergyLedger& energies() const { return energies_; }
  const StepEstimate& step_estimate() const { return step_estimate_; }
  const StageRun& stage_run() const { return *stage_run_; }
  const Stage& stage() const { return stage_run_->stage(); }
  const Profile& profile() const { return profile_; }
  Profile& profile() { return profile_; }

  // ---- checkpoints
  void write(FieldWriter& to) const;
  /// The arrays that a checkpoint replaces.
  struct Arrays {
    Model& model;
    Contact& contact;
    WallFriction& wall_friction;
    Tools& tools;
    GrainSteps& grain_steps;
    Grips* grips; ///< of a stage that grips, its axis set, or none
  };
  /// Restores the state of a checkpoint: `take(arrays)` replaces the arrays, `fields` the rest. It becomes the state of
  /// the checkpoint's own stage or, for a branch, of the scenario's first. `tools_of_branch`: for a branch, how many of
  /// the tools the checkpoint has. Throws std::invalid_argument if the fields are of another version.
  template <class Take>
  void restore(FieldReader& fields, std::optional<std::size_t> tools_of_branch, Take&& take) {
    read(fields, tools_of_branch);
    GrainSteps grain_steps;
    take(Arrays{model_, contact_, wall_friction_, tools_, grain_steps, prepare_grips()});
    set_grain_steps(std::move(grain_steps));
  }
  /// After restore(): its state is the beginning of this scenario's first stage. Candidates and step are found again
  /// with this scenario's settings. `gravity_before`: mm/s^2, of the scenario before.
  void begin_branch(const std::array<double, 3>& gravity_before);
  /// For tests and benchmarks that change positions, velocities or strains by hand.
  Model& model_to_disturb() { return model_; }

private:
  void read(FieldReader& fields, std::optional<std::size_t> tools_of_branch);
  Grips* prepare_grips();
  void take_over_from_gravity(const std::array<double, 3>& before);
  void set_grain_steps(GrainSteps grain_steps);
  static const Communicator& alone();
  void order_grains();
  void find_candidates();
  void search();
  void add_contact_and_walls();
  void add_up_forces(const std::exception_ptr& failure);
  void add_contact(std::span<const std::int32_t> grains);
  void add_reactions_and_walls();
  std::string too_deep(const std::string& what) const;
  void check_contact_depth() const;
  void check_penetration() const;
  std::array<double, 2> add_grips();
  void measure_walls(const std::array<double, 2>& grip_force);
  void regulate_loading_rate();
  Advance velocity_update(const StepPlan& plan) const;
  void move_and_strain(const Advance& update);
  void move_and_strain(std::span<const std::int32_t> grains, const Advance& update);
  StepEstimate::StrainOfStep add_up_step();
  void find_bounds();
  /// Axes whose walls are away in a stage.
  Axes withdrawn_in(std::int64_t stage) const;
  void change_walls(const Axes& withdrawn);
  void change_tools();
  std::array<double, 3> of_scaled_mass(std::array<double, 3> gravity) const;
  void add_work_of_gravity();
  void measure_tools();
  void return_walls(std::size_t axis);
  void grip_faces();
  void renew_step_estimate(const Box& box, bool anew);
  StageObservation observation() const;
  double damping_rate() const;
  [[noreturn]] void report_bad_grain() const;
  void fail_at_first_grain(const std::function<std::string(std::int32_t)>& text) const;

  const Scenario* scenario_;
  const Communicator* ranks_;
  ThreadTeam* team_;
  Profile profile_;
  Model model_;
  Contact contact_;
  Box box_;
  WallFriction wall_friction_;
  Tools tools_;
  std::optional<Container> container_;
  Grips grips_;
  RunState state_;
  EnergyLedger energies_;
  StepEstimate step_estimate_;
  std::optional<StageRun> stage_run_;
  Ghosts ghosts_;
  /// Own grains as loops take them: at the border to other ranks, and the others.
  struct Order {
    std::vector<std::int32_t> border, inside;
  };
  Order in_space_, by_number_;
  std::vector<Bounds> bounds_;          ///< [grains], of own grains; of all after a search
  std::vector<ForceSums> force_sums_;   ///< [grains], of own grains
  std::vector<MotionSums> motion_sums_; ///< [grains], of own grains
  ForceSums force_total_;               ///< of all grains of all ranks
  double travel_since_search_ = 0;      ///< mm, the largest of all grains
  std::optional<StepPlan> plan_;        ///< of the next step, if grips need it beforehand
  double margin_ = 0;                   ///< mm, of the contact search
  double damping_rate_ = 0;             ///< 1/s, of the next advance
  bool energy_balance_open_ = false;    ///< until the first row of a branch
};

} // namespace mpfem
