#pragma once
// Where the walls are at each moment: the scenario's stages as functions of time.

#include <array>

#include "solver/kernels/integrate.hpp"
#include "solver/model/model.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Fraction of a motion that is done at the fraction `time` of its duration: constant speed between a smooth start and a
/// smooth end, each lasting `ramp` of the duration (speed follows 3 s^2 - 2 s^3), in [0, 1].
double motion_fraction(double time, double ramp);

/// One stage, made concrete by the box with which it starts.
class StageMotion {
public:
  /// `solid_volume` in mm^3. Throws InputError where the target cannot be reached by this kind of stage.
  StageMotion(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
              double solid_volume);

  double duration() const { return duration_; } ///< s
  /// Sets the planes to where they are at a time (s) since the stage began.
  void place(Walls& walls, double time) const;

private:
  std::array<double, 3> low_, high_;
  double end_scale_ = 1; ///< box length at the end over that at the start
  double ramp_ = 0;
  double duration_ = 0;
};

/// Checks all stages from `first_stage` on before anything moves: every target can be reached from where the stage before
/// ends, and no wall moves further in one stable step (s) than a small part of an element. Throws InputError.
void check_programme(const Scenario& scenario, std::int64_t first_stage, std::array<double, 3> low,
                     std::array<double, 3> high, const Model& model, double stable_step);

} // namespace mpfem
