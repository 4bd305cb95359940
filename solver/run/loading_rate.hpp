#pragma once
// A stage that chooses its own speed: as fast as its tolerances of quasi-static loading allow.
//
// Two signs of inertia are watched while the packing bears load. One is kinetic energy over internal energy, which here
// is the elastic energy of the grains and what plastic flow has dissipated since the stage began; reports also count
// bonds, their damage, friction and the penalty of contact (common/stage_energy.hpp). The other is the stress that
// inertia bears: along each axis, with f the total force on a node and x its distance from the box's centre,
//   sum f / A                the difference of opposite walls' stresses,
//   sum f x / V              the walls' mean stress less that inside the grains,
// both of which vanish in equilibrium. (The second also shows symmetric vibration, which the first does not.)
// Kinetic energy grows with the square of the speed, stresses with the speed; the larger of
//   sqrt(kinetic / (tolerance internal)),   stress / (tolerance largest wall stress)
// is the load L. The rate factor r, the current speed over the stage's own, follows d ln r/dt = (aim - L) / transit,
// between bounds: waves need about a transit to show a change. The stage's clock runs r times as fast as time. When
// walls are about to stop, r returns to 1: the stage decides how gently they stop.

#include <array>
#include <cstdint>
#include <string>

#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// State of the control.
struct LoadingRateState {
  double factor = 1;                 ///< current speed over the stage's own
  double dissipation_at_start = 0;   ///< mJ, plastic, when the stage began
  double slowest = 1, fastest = 1;   ///< of `factor` so far
  std::array<double, 3> imbalance{}; ///< MPa, of opposite walls across each axis, averaged over a transit
  std::array<double, 3> dynamic{};   ///< MPa, walls' stresses less those inside the grains, likewise
  double largest_kinetic = 0;        ///< largest kinetic over internal energy while the packing bore load
  double largest_stress = 0;         ///< largest stress borne by inertia over the largest wall stress, likewise
  double time_loaded = 0;            ///< s, in which the packing bore load
  double time_beyond = 0;            ///< s, the part of it beyond a tolerance
  bool at_slowest = false;           ///< the tolerances required less than the slowest speed

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("loading_rate.factor", s.factor), visit("loading_rate.dissipation_at_start", s.dissipation_at_start);
    visit("loading_rate.slowest", s.slowest), visit("loading_rate.fastest", s.fastest);
    visit("loading_rate.imbalance", s.imbalance), visit("loading_rate.dynamic", s.dynamic);
    visit("loading_rate.largest_kinetic", s.largest_kinetic), visit("loading_rate.largest_stress", s.largest_stress);
    visit("loading_rate.time_loaded", s.time_loaded), visit("loading_rate.time_beyond", s.time_beyond);
    visit("loading_rate.at_slowest", s.at_slowest);
  }
};

/// What is observed every `steps_between_observations` steps.
struct LoadingRateObservation {
  /// s since the observation before, taken as `steps_between_observations` times the last step: exact only where all of
  /// these steps were as long as the last, and belonged to the stage.
  double elapsed = 0;
  double kinetic_energy = 0;           ///< mJ
  double elastic_energy = 0;           ///< mJ, of the grains
  double plastic_dissipation = 0;      ///< mJ, since the run began
  std::array<double, 3> wall_stress{}; ///< MPa, mean of the two walls across each axis; 0 where they are away
  std::array<double, 3> imbalance{};   ///< MPa, of the two walls
  std::array<double, 3> dynamic{};     ///< MPa, walls' stress less that inside the grains
  bool stopping = false;               ///< the stage nears an end where walls come to rest
};

/// The control of one stage.
class LoadingRateControl {
public:
  static constexpr std::int64_t steps_between_observations = 25;

  /// `transit`: s, in which waves cross the packing.
  LoadingRateControl(const QuasiStatic& tolerances, double wall_speed, double transit);
  /// Takes in an observation and changes the rate factor.
  void update(LoadingRateState& state, const LoadingRateObservation& seen) const;
  /// "wall speed chosen between 900 and 8000 mm/s; under load, kinetic over internal energy was at most 0.8 %, …".
  std::string text(const LoadingRateState& state) const;

private:
  QuasiStatic tolerances_;
  double wall_speed_;
  double transit_;
};

} // namespace mpfem
