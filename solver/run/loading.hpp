#pragma once
// Walls that are driven until something happens, and walls that are held at a stress.
//
// The law of a held wall. With e = wanted - measured stress of an axis (mean of its two walls), both walls move inwards at
//   u = f + s,   tau df/dt = P e - f,   ds/dt = I e,
// bounded by the stage's wall speed. From force to velocity this is two masses side by side, one (1/I an area) free, the
// other (tau/P) behind a dashpot: a passive machine. Whatever is passive itself, as a packing is, cannot be made to
// oscillate by it, however stiff or soft it is and however long its waves take, so no stiffness has to be known; P, I
// and tau only decide how fast and how well damped the walls follow. They are set by the packing's own impedance (P: a
// wall that is much easier to move than the packing), mass (I) and transit time (tau); see docs/numerics.md.

#include <array>
#include <optional>
#include <string>

#include "solver/boundary/walls.hpp"
#include "solver/model/model.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// State of a loading. Numbers only: a checkpoint stores them as they are.
struct LoadingState {
  double begun = 0;                      ///< 1: the values at the start are known
  double ended_by = 0;                   ///< LoadingEnd
  double fraction_done = 0;              ///< [0, 1]
  std::array<double, 3> speed{};         ///< mm/s inwards, of both walls across each axis
  std::array<double, 3> fast{}, slow{};  ///< mm/s, the two parts of a held axis's speed
  std::array<double, 3> error{};         ///< MPa, wanted less measured stress of a held axis, averaged over a transit
  std::array<double, 3> start_stress{};  ///< MPa, of each axis
  std::array<double, 3> start_force{};   ///< N
  double start_dissipation = 0;          ///< mJ
  double dissipation = 0;                ///< mJ, plastic and damage; of the damage what was last asked for
  double damage_dissipation = 0;         ///< mJ, when it was last asked for
  double sign = 1;                       ///< driven walls: 1 inwards, -1 outwards
  double drive = 0;                      ///< mm/s, speed of driven walls inwards
  double leg_start = 0;                  ///< MPa, mean stress where the present leg of a stress target began
  double legs = 0;                       ///< half cycles done
  double path = 0, path_rate = 0;        ///< probe: way along the path in MPa of its leading axis, and its rate, MPa/s
  double watched = 0, peak = 0;          ///< MPa, the stress whose fall may end the stage, averaged over a transit
  double inside = 0;                     ///< 1: the mean stress has been in the lower half of a cycle's range
  double overshoot = 0;                  ///< MPa, largest amount by which the mean stress passed a turning point
  double hold_error = 0;                 ///< MPa, largest magnitude of `error` so far
  double hold_stress = 0;                ///< MPa, largest wanted stress so far
  double hold_square = 0, hold_time = 0; ///< MPa^2 s, s: integral of the square of wanted less measured stress
};

/// Why a loading ended.
enum class LoadingEnd {
  none,
  axial_strain,
  relative_density,
  axial_stress,
  mean_stress,
  deviatoric_stress,
  stress_drop,
  dissipation_ratio,
  duration,
  cycles,
};

/// The packing as a loading sees it.
struct Sample {
  double mass = 0;                ///< tonne, as scaled
  double solid_volume = 0;        ///< mm^3, of all grains at the start
  double constrained_modulus = 0; ///< MPa, K + 4 G/3 of the grains, the mean over their volumes
  double contact_stiffness = 0;   ///< MPa/mm, the largest penalty of a grain
};
Sample sample_of(const Model& model);

/// s, in which waves cross the longest side of a box (mm): in a compact that is a tenth as stiff as its grains.
double wave_transit(const Sample& sample, const std::array<double, 3>& low, const std::array<double, 3>& high);

/// What is seen at a time level.
struct LoadingObservation {
  double time = 0;                          ///< s since the stage began
  double step = 0;                          ///< s since the observation before
  double pace = 1;                          ///< speed of the driven walls over the stage's own
  std::array<double, 3> low{};              ///< mm, box
  std::array<double, 3> high{};             ///< mm
  std::array<double, 3> force{};            ///< N, mean of the two walls across each axis
  double plastic_dissipation = 0;           ///< mJ
  std::optional<double> damage_dissipation; ///< mJ; has to be there where `needs_damage`
};

/// Part of the wall speed that an unloading keeps to its end. A packing under little stress is soft, and takes long to lose it.
double slowest_unloading(double target, double start);

/// MPa above its target at which an unloading by `way` (MPa) has arrived: single grains that still touch a wall keep a
/// little stress for long.
double unloading_tolerance(double target, double way);

/// Axes whose walls are away while a stage lasts, as bits 1 (x), 2 (y), 4 (z).
int absent_axes(const Scenario& scenario, const Stage& stage);

/// One loading, made concrete by the box with which it starts.
class LoadingControl {
public:
  LoadingControl(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
                 const Sample& sample);

  /// s, in which the stage is expected to end.
  double expected_duration() const { return expected_duration_; }
  /// Box lengths at the expected end over those at the start.
  std::array<double, 3> expected_scale() const { return expected_scale_; }
  /// Whether an observation at this step number has to come with the dissipation by damage, for which all bonds are
  /// visited.
  bool needs_damage(const LoadingState& state, std::int64_t step) const;
  /// New wall speeds from what is seen. Throws SimulationError where the end cannot be reached or lies behind, and where a
  /// hold ends far from its stress.
  void update(LoadingState& state, const LoadingObservation& seen) const;
  /// Moves the walls for one step (s).
  void move(Walls& walls, const LoadingState& state, double step) const;

  /// Why the stage ended, with the number: "axial strain 0.15".
  std::string end_text(const LoadingState& state) const;
  /// MPa by which a stress that was to end or turn the loading was passed, at the given last observation.
  double overshoot(const LoadingState& state, const LoadingObservation& last) const;

private:
  struct Seen; // stresses and strains of an observation
  Seen see(const LoadingObservation& observation) const;
  void begin(LoadingState& state, const Seen& seen, double damage) const;
  double approach(double left) const;
  double drive_towards(LoadingState& state, const Seen& seen, double wanted) const;
  void drive_isotropic(LoadingState& state, const Seen& seen) const;
  void drive_axial(LoadingState& state, const Seen& seen) const;
  void hold(LoadingState& state, const Seen& seen, std::size_t axis, double wanted) const;
  double brought_on(const Seen& seen, double start, double given) const;
  void hold_all(LoadingState& state, const Seen& seen) const;
  void hold_lateral(LoadingState& state, const Seen& seen) const;
  void follow_path(LoadingState& state, const Seen& seen) const;
  void watch_peak(LoadingState& state, const Seen& seen) const;
  LoadingEnd ended(const LoadingState& state, const Seen& seen) const;
  void check_limits(const LoadingState& state, const Seen& seen) const;
  void refuse_end_behind(LoadingEnd end, const Seen& seen) const;
  void refuse_missed_hold(const LoadingState& state, const Seen& seen) const;
  double fraction_done(const LoadingState& state, const Seen& seen) const;

  std::string name_;
  WallLoading loading_;
  std::array<double, 3> length_{};      ///< mm, of the box at the start
  std::array<double, 3> path_stress_{}; ///< probe: change of each axis's stress along the path, the largest 1
  double longest_ = 0;                  ///< mm
  double solid_volume_ = 0;
  double ramp_ = 0; ///< s, to full speed
  double expected_duration_ = 0;
  std::array<double, 3> expected_scale_{1, 1, 1};
  // of the servo
  double transit_ = 0;           ///< s, of a soft compact
  double gain_ = 0;              ///< P, mm/s per MPa
  double slow_gain_ = 0;         ///< I, mm/s^2 per MPa
  double contact_stiffness_ = 0; ///< MPa/mm
  double path_rate_ = 0;         ///< MPa/s, with which a path begins
};

} // namespace mpfem
