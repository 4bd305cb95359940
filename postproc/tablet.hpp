#pragma once
// A tablet from press to rest: forces of the punches, wall of the die, ejection, and what it measures out of the die.

#include <optional>
#include <string>
#include <vector>

#include "postproc/measurement.hpp"

namespace mpfem {

/// Names of stages in the scenario. Of those that are not given, the default names count where the run has them.
struct TabletStages {
  std::string press = "press";
  std::optional<std::string> hold, unload, eject;
};

/// Names of the rigid tools in /history/tools.
struct TabletTools {
  std::string upper = "upper", lower = "lower", die = "die";
};

struct TabletRule {
  TabletStages stages;
  TabletTools tools;
  int snapshot = -1;                   ///< of the tablet out of the die
  std::optional<double> face_distance; ///< mm; without it a twentieth of the mean grain's diameter
};

/// One number of a tablet; without a value where the run does not tell it.
struct TabletNumber {
  std::string name, unit;
  std::optional<double> value, uncertainty; ///< in the unit; no uncertainty where the number is exact
};

struct TabletMeasurement {
  Measurement measurement; ///< its value is the relative density in the die at the peak
  std::vector<TabletNumber> numbers;
};

/// All numbers and their rules stand in docs/metrics.md, "tablet". Forces are read at the largest smoothed force of the
/// upper punch while it presses and holds; lateral area is pi D H, H the distance of the punches, after unloading that
/// where the upper punch left. Wall friction is janssen.hpp's, thickness and diameter tablet_shape.hpp's, between the
/// snapshot at the end of the pressing and that of the rule. Throws InputError where tools or the stage that presses
/// are missing; what later stages or snapshots do not tell has no value, and a note says why.
TabletMeasurement measure_tablet(const schema::FileReader& file, const TabletRule& rule);

/// A line a number: name, value ± uncertainty, unit.
std::string to_table(const std::vector<TabletNumber>& numbers);

} // namespace mpfem
