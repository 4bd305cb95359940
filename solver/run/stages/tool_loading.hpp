#pragma once
// Rigid tools move or hold a force until something happens: pressing, holding, unloading, ejection, crushing between
// plates.

#include <vector>

#include "solver/run/stages/driven_speed.hpp"
#include "solver/run/stages/stage_control.hpp"
#include "solver/run/stages/stress_servo.hpp"

namespace mpfem {

/// Why a loading by tools ended.
enum class ToolEnd { none, relative_density, axial_stress, travel, force, force_drop, forces_reached, duration };

/// Velocities of the tools until one of the stage's ends is reached.
class ToolLoadingControl final : public StageControl {
public:
  ToolLoadingControl(const ToolLoading& stage, const StageLabel& label, const StageStart& start);

  std::string describe() const override;
  double expected_duration() const override { return expected_duration_; }
  void expect_end(Cell& cell) const override;
  std::string unreachable_end() const override;
  void observe(const StageObservation& seen) override;
  void move(Cell& cell, double time, double clock_step, double step) const override;
  std::span<const std::array<double, 3>> tool_velocities() const override { return velocity_; }
  bool ended() const override { return state_.ended_by != ToolEnd::none; }
  double fraction_done(double time, double mean_stress) const override;
  StageResult result(const StageObservation& last) const override;
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

private:
  /// What a stage of tools sees at a time level.
  struct Seen {
    double time = 0, step = 0;            ///< s
    double height = 0, area = 0;          ///< mm, mm^2, of the container or cell along z
    double density = 0, axial_stress = 0; ///< 1, MPa
    double push = 0;                      ///< N, of the watched tool
  };
  Seen see(const StageObservation& observation) const;
  void begin(const Seen& seen);
  double wanted_speed(const Seen& seen, double& left) const;
  void set_velocities(const StageObservation& observation, double part);
  ToolEnd find_end(const Seen& seen) const;
  double find_fraction_done(const Seen& seen) const;
  std::string missed_pushes(const Tools& tools) const;
  double height_at(double density, double area) const;
  double closing_speed() const;
  bool misses_push(std::size_t drive) const;
  bool is_away(std::size_t tool) const;
  bool only_punches_change_density() const;
  const ToolDrive* drive_of(std::size_t tool) const;

  /// State of a loading by tools.
  struct State {
    bool begun = false;
    ToolEnd ended_by = ToolEnd::none;
    double fraction_done = 0;
    double travelled = 0;    ///< mm, of the fastest tool driven at a velocity
    double start_stress = 0; ///< MPa, axial
    double start_push = 0;   ///< N, of the watched tool
    double start_density = 0;
    double watched = 0; ///< N, push of the watched tool, averaged over a transit
    double peak = 0;    ///< N, of `watched`

    template <class Self, class Visitor>
    static void for_each_field(Self& s, Visitor&& visit) {
      visit("tools.begun", s.begun), visit("tools.ended_by", s.ended_by);
      visit("tools.fraction_done", s.fraction_done), visit("tools.travelled", s.travelled);
      visit("tools.start_stress", s.start_stress), visit("tools.start_push", s.start_push);
      visit("tools.start_density", s.start_density);
      visit("tools.watched", s.watched), visit("tools.peak", s.peak);
    }
  };

  ToolLoading stage_;
  StageLabel label_;
  StageStart start_;
  double transit_;               ///< s
  double ramp_ = 0;              ///< s, to full speed
  double expected_duration_ = 0; ///< s
  State state_;
  /// A drive that holds a push.
  struct HeldTool {
    ServoState servo;
    bool reached = false; ///< the push has been reached; before, the tool closes its gap
    template <class Self, class Visitor>
    static void for_each_field(Self& s, Visitor&& visit) {
      ServoState::for_each_field(s.servo, visit);
      visit("tools.reached", s.reached);
    }
  };
  double wanted_stress(const ToolDrive& drive) const;
  HoldQuality hold_quality() const;

  DrivenSpeed part_;                            ///< of the full speed
  std::vector<HeldTool> held_;                  ///< [drives]
  HoldQuality quality_;                         ///< of all drives that hold a push, since they reached it
  std::vector<std::array<double, 3>> velocity_; ///< mm/s, [tools up to the last one that moves]
};

} // namespace mpfem
