#pragma once
// Where the walls are at each moment: the scenario's stages as functions of time.

#include <array>
#include <string>
#include <vector>

#include "solver/boundary/walls.hpp"
#include "solver/model/model.hpp"
#include "solver/run/loading.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Fraction of a motion that is done at the fraction `time` of its duration: constant speed between a smooth start and a
/// smooth end, each lasting `ramp` of the duration (speed follows 3 s^2 - 2 s^3), in [0, 1].
double motion_fraction(double time, double ramp);

/// One stage, made concrete by the box with which it starts. A loading (Stage::loading) is not moved from here; of it,
/// this class knows only that its end is open.
class StageMotion {
public:
  /// `solid_volume` in mm^3, `mean_stress` (MPa) when it starts. Throws InputError where the target cannot be reached by
  /// this kind of stage.
  StageMotion(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
              double solid_volume, double mean_stress);

  double duration() const { return duration_; } ///< s; infinite where the stage ends at a stress
  /// s: the duration, or where that is infinite, a time in which the stage is expected to end.
  double expected_duration() const { return expected_duration_; }
  /// Part of the stage that is done, in [0, 1].
  double fraction_done(double time, double mean_stress) const;
  /// Moves the planes from where they are to where they are at a time (s) since the stage began, `step` s later.
  void move(Walls& walls, double time, double step, double mean_stress) const;
  /// How far (mm) the high grip has slid across the axis against the low one at a time (s) since the stage began.
  std::array<double, 3> sliding(double time) const;
  /// Whether a stage that ends at a stress has reached it. Throws SimulationError where the walls have gone far without.
  bool reached(const Walls& walls, double mean_stress) const;
  /// What ends the stage: "relative density 0.92".
  std::string end_text() const;

private:
  double unloading_speed(double time, double mean_stress) const;

  Stage stage_;
  std::array<double, 3> low_, high_;
  std::array<double, 3> end_scale_{1, 1, 1}; ///< box lengths at the end over those at the start
  double longest_ = 0;                       ///< mm, box edge when the stage starts
  double mean_stress_ = 0;                   ///< MPa, when the stage starts
  double ramp_ = 0;
  double duration_ = 0, expected_duration_ = 0;
};

/// Why a stage that begins at a mean stress (MPa) cannot reach its own, in one line; empty where it can. An unloading may
/// begin at its stress or a little below.
std::string unreachable_stress(const Stage& stage, double mean_stress);

/// What is expected of a stage beforehand.
struct StageForecast {
  double duration = 0;          ///< s
  bool sure = true;             ///< false: the stage or one before it ends at what is not known beforehand
  std::array<double, 3> low{};  ///< mm, box at the end
  std::array<double, 3> high{}; ///< mm
};
/// Forecasts of the stages from `first_stage` on, which begins with the given box. Targets that cannot be reached from
/// where the stage before surely ends are refused. Throws InputError.
std::vector<StageForecast> forecast(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                                    std::array<double, 3> high, const Model& model);

/// Checks the stages from `first_stage` on before anything moves: every target can be reached from where the stage before
/// ends (as far as that is known beforehand), and no wall moves further in one stable step (s) than a small part of an element. Throws InputError.
void check_programme(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                     std::array<double, 3> high, const Model& model, double stable_step);

} // namespace mpfem
