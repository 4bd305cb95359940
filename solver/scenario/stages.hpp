#pragma once
// Stages of a scenario as plain structs, one for each type. Only read_stages.cpp knows the keywords of the TOML file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/key_places.hpp"
#include "solver/scenario/tools.hpp"

namespace mpfem {

/// All six walls move inwards until the packing has reached a relative density; smooth start and end.
struct IsotropicCompaction {
  double relative_density = 0; ///< target, reference grain volume over box volume
  double wall_speed = 0;       ///< plateau speed of every wall, mm/s
  double ramp_fraction = 0.1;  ///< fraction of the stage's time spent in each of the smooth start and end
};

/// All six walls move inwards until the mean stress has risen to a target.
struct IsotropicLoading {
  double mean_stress = 0;     ///< target, MPa
  double wall_speed = 0;      ///< largest speed of every wall, mm/s
  double ramp_fraction = 0.1; ///< smooth start, as a fraction of the expected time
};

/// All six walls move apart until the mean stress has fallen to a target. They slow down as they come near it.
struct IsotropicUnloading {
  double mean_stress = 0;     ///< target, MPa
  double wall_speed = 0;      ///< largest speed of every wall, mm/s
  double ramp_fraction = 0.1; ///< smooth start, as a fraction of the time in which the box would grow by 3 % in length
};

/// All six walls move together, up and down between two mean stresses.
struct StressCycles {
  double lowest_mean_stress = 0;  ///< MPa
  double highest_mean_stress = 0; ///< MPa
  std::int64_t cycles = 0;        ///< up and down again
  double wall_speed = 0;          ///< largest speed of every wall, mm/s
  double ramp_fraction = 0.1;
};

/// What ends a loading: the first of those that are given. Strains are logarithmic, since the stage began, compression
/// positive; stresses are those of the walls, MPa.
struct LoadingEnds {
  std::optional<double> axial_strain{};      ///< negative: the walls move apart
  std::optional<double> relative_density{};  ///< reference grain volume over box volume
  std::optional<double> axial_stress{};      ///< MPa
  std::optional<double> mean_stress{};       ///< MPa
  std::optional<double> deviatoric_stress{}; ///< MPa
  std::optional<double>
      stress_drop{}; ///< fall below the peak of the axial stress (unconfined) or of |q|, over the peak
  std::optional<double> dissipation_ratio{}; ///< plastic and damage dissipation over its value when the stage began
  std::optional<double> duration{};          ///< s
};

/// The z walls are driven. What the x and y walls do is the rest of the stage's type.
struct AxialDrive {
  double wall_speed = 0; ///< largest speed of both walls, mm/s
  double ramp_fraction =
      0.1; ///< of the time of the whole travel (of 5 % of strain where that is not known) to full speed
  LoadingEnds ends;
};

/// The x and y walls are away.
struct UnconfinedCompression : AxialDrive {};

/// The x and y walls are at rest.
struct DieCompression : AxialDrive {};

/// The x and y walls are held at a force or stress.
struct TriaxialCompression : AxialDrive {
  double servo_speed = 0;                 ///< largest speed of the held walls, mm/s
  bool hold_force = true;                 ///< the walls' force is held; false: their stress
  std::optional<double> lateral_stress{}; ///< MPa, to be held; none: what acts when the stage begins
};

/// All walls are held on a straight path of mean and deviatoric stress.
struct StressProbe {
  std::array<double, 2> direction{}; ///< of the path, in mean and deviatoric stress
  double wall_speed = 0;             ///< largest speed of the walls along the path, mm/s
  double servo_speed = 0;            ///< largest speed of the walls, mm/s
  double ramp_fraction = 0.1;
  LoadingEnds ends;
};

/// All walls are held at one stress, for a time.
struct HeldStress {
  double mean_stress = 0; ///< MPa
  double duration = 0;    ///< s
  double servo_speed = 0; ///< largest speed of the walls, mm/s
};

/// Nothing moves: free flight, vibration, settling.
struct Rest {
  double duration = 0; ///< s
};

/// The nodes near two opposite faces of the box are gripped and moved along the box's axis. Walls take no part.
struct GripMotion {
  std::size_t axis = 2;            ///< 0 x, 1 y, 2 z
  double depth = 0;                ///< mm: nodes this close to a face of the box when the stage begins are gripped
  bool lateral_fixed = true;       ///< gripped nodes do not move across the axis
  double displacement = 0;         ///< mm, change of the distance between both grips; positive apart
  std::array<double, 3> sliding{}; ///< mm, of the high grip against the low one, across the axis
  double speed = 0;                ///< plateau speed of each grip, mm/s
  double ramp_fraction = 0.1;
};

/// What ends a loading by tools: the first of those that are given.
struct ToolEnds {
  std::optional<double> relative_density{}; ///< of the container
  std::optional<double> height{};           ///< mm, of the container; stands for the relative density that goes with it
  std::optional<double> axial_stress{};     ///< MPa, of the container's punches
  std::optional<double> travel{};           ///< mm, of the fastest tool driven at a velocity, since the stage began
  std::optional<double> force{};            ///< N, push of the watched tool along its direction
  std::optional<double> force_drop{};       ///< fall of that push below its peak, over the peak
  double smallest_peak = 0;                 ///< N, the smallest peak that counts
  bool forces_reached = false;              ///< every tool that holds a force or stress has reached it once
  std::optional<double> duration{};         ///< s
  std::size_t watched = 0;                  ///< the tool of `force` and `force_drop`
  std::array<double, 3> watched_direction{}; ///< unit vector along which the push of that tool is taken
};

/// Rigid tools move, hold a force, or are away. Walls of the box, if there are any, are at rest.
struct ToolLoading {
  std::vector<ToolDrive> drives; ///< of the tools that move; the others are at rest
  std::vector<std::size_t> away; ///< tools that touch nothing while the stage lasts
  double speed = 0;              ///< mm/s, of the fastest tool that is driven at a velocity
  double servo_speed = 0;        ///< mm/s, the largest of tools that hold a push
  double ramp_fraction = 0.1;    ///< of the time of the whole travel (of 5 % of the container's length) to full speed
  ToolEnds ends;
  std::optional<ContainerParameters> container{}; ///< the scenario's
};

/// What a stage does. A new type is added here, to the reader (read_stages.cpp) and to make_stage_control().
using StageType =
    std::variant<IsotropicCompaction, IsotropicLoading, IsotropicUnloading, StressCycles, UnconfinedCompression,
                 DieCompression, TriaxialCompression, StressProbe, HeldStress, Rest, GripMotion, ToolLoading>;

/// Mass-proportional damping of each grain's velocity relative to the affine velocity at the grain's centre. It fades
/// from full at mean stress 0 to nothing at `fade_stress`.
struct DampingParameters {
  double rate = 0;        ///< 1/s; force = -rate * m * (v - v_affine)
  double fade_stress = 0; ///< MPa
};

/// Tolerances and bounds within which a quasi-static stage chooses its speed (solver/run/loading_rate.hpp).
struct QuasiStatic {
  double kinetic_tolerance = 0.01; ///< kinetic energy over internal energy gained in the stage or stored at its start
  double stress_tolerance = 0.02;  ///< the part of the wall stresses that inertia balances, over the largest of them
  double slowest_speed = 0;        ///< mm/s
  double fastest_speed = 0;        ///< mm/s
  double loose_stress = 0;         ///< MPa: below this wall stress the packing is loose and the speed stays as it is
  KeyPlaces places{};              ///< of its keys in the scenario
};

/// One entry of [[stages]].
struct Stage {
  std::string name;
  StageType type;
  std::optional<QuasiStatic> quasi_static{}; ///< none: the stage keeps its speed
  DampingParameters damping;
  int snapshots = 0; ///< evenly over the stage's expected time, besides that at its end
  KeyPlaces places;  ///< of its keys in the scenario
};

/// mm/s of each driven wall or grip, if the stage keeps its speed; 0 if none is driven.
double driven_speed(const StageType& type);
/// mm/s, largest speed of walls that are held at a stress; none if no wall is held.
std::optional<double> servo_speed(const StageType& type);
/// What ends a loading; null for stages that are no loadings.
const LoadingEnds* loading_ends(const StageType& type);
/// Axes of the box, as flags.
using Axes = std::array<bool, 3>;
inline constexpr Axes all_axes{true, true, true};
/// Axes whose walls are away while a stage lasts.
Axes withdrawn_axes(const StageType& type);
/// Whether a stage needs walls.
bool moves_walls(const StageType& type);

} // namespace mpfem
