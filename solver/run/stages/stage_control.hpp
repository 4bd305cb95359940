#pragma once
// What every type of stage must answer while it runs. Each type is one class in one file of this folder.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/fields.hpp"
#include "solver/boundary/cell.hpp"
#include "solver/boundary/grips.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/output/stage_result.hpp"
#include "solver/run/stages/sample.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// What a stage sees of the packing at a time level.
struct StageObservation {
  double time = 0;        ///< s since the stage began, by the stage's clock (loading_rate.hpp)
  double step = 0;        ///< s since the observation before
  double rate_factor = 1; ///< current speed over the stage's own
  Cell cell{};
  std::array<double, 3> force{};              ///< N, mean of the two faces across each axis; compression positive
  double mean_stress = 0;                     ///< MPa, of all faces
  double plastic_dissipation = 0;             ///< mJ
  std::optional<double> damage_dissipation{}; ///< mJ; required where `needs_damage`
  const Tools* tools = nullptr;               ///< with what they bear
};

/// The cell and the packing in it when a stage begins.
struct StageStart {
  Cell cell{};
  double mean_stress = 0; ///< MPa
  Sample sample{};
};

/// How messages name a stage.
struct StageLabel {
  std::string name;
  KeyPlaces places{}; ///< of its keys in the scenario
};

/// One stage while it runs, made concrete by the cell with which it begins.
class StageControl {
public:
  virtual ~StageControl() = default;
  StageControl() = default;
  StageControl(const StageControl&) = delete;
  StageControl& operator=(const StageControl&) = delete;

  // ---- plan
  /// What the stage does, for the plan: "all walls inwards, to a relative density".
  virtual std::string describe() const = 0;
  /// s by the stage's clock; infinite if something other than time ends the stage.
  virtual double duration() const { return std::numeric_limits<double>::infinity(); }
  /// s in which the stage is expected to end; the duration if that is known.
  virtual double expected_duration() const = 0;
  /// Changes the cell to what is expected of it when the stage ends.
  virtual void expect_end(Cell& cell) const = 0;
  /// A message that says why the stage cannot come to its end from this start; empty where it can, or is there already.
  virtual std::string unreachable_end() const { return {}; }
  /// The grips that the stage moves, where it moves grips.
  virtual const GripMotion* grips() const { return nullptr; }

  // ---- run
  /// Whether an observation at this step number needs the dissipation by damage, for which all bonds are visited.
  virtual bool needs_damage(std::int64_t /*step*/) const { return false; }
  /// Takes in the current time level. Throws SimulationError if the stage's end cannot be reached.
  virtual void observe(const StageObservation& seen) = 0;
  /// Changes the cell by one step of `step` s, `clock_step` s by the stage's clock, to the stage's time `time`.
  virtual void move(Cell& cell, double time, double clock_step, double step) const = 0;
  /// mm that the high grip has slid across the axis against the low one, at a time of the stage.
  virtual std::array<double, 3> sliding(double /*time*/) const { return {}; }
  /// mm/s of every tool in the next step; empty where all are at rest.
  virtual std::span<const std::array<double, 3>> tool_velocities() const { return {}; }
  /// Whether what was last observed ends the stage. Stages with a duration end by that.
  virtual bool ended() const { return false; }
  /// Part of the stage that is done at its time `time` (s) and the current mean stress (MPa), in [0, 1].
  virtual double fraction_done(double time, double mean_stress) const = 0;

  // ---- end
  /// The outcome of the stage at its last observation. The caller fills in the name.
  virtual StageResult result(const StageObservation& last) const = 0;

  // ---- checkpoints
  virtual void write(FieldWriter& /*to*/) const {}
  virtual void read(FieldReader& /*from*/) {}
};

/// The control of a stage. Throws InputError where its target cannot be reached from the start by this type of stage.
std::unique_ptr<StageControl> make_stage_control(const Stage& stage, const StageStart& start);

/// Fraction of a target by which a stage may begin beyond it: the stage before ended there.
inline constexpr double already_there = 0.01;
/// Relative change of the cell's lengths at which an isotropic change of stress is expected to end.
inline constexpr double expected_isotropic_strain = 0.03;

} // namespace mpfem
