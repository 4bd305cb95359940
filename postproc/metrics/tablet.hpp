#pragma once
// A tablet from pressing to ejection: punch forces, die wall, ejection, and its size out of the die.

#include <optional>
#include <string>
#include <vector>

#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Names of stages in the scenario. For those not given, "hold", "unload" and "eject" are used where the run has them.
struct TabletStages {
  std::string press = "press";
  std::optional<std::string> hold, unload, eject;
};

/// Names of the rigid tools in /history/tools.
struct TabletTools {
  std::string upper = "upper", lower = "lower", die = "die";
};

/// Which stages, tools and snapshot of a run are read.
struct TabletRule {
  TabletStages stages;
  TabletTools tools;
  int snapshot = -1;                   ///< shows the tablet out of the die; numbered as in snapshot_name
  std::optional<double> face_distance; ///< mm; default: a twentieth of the mean grain's diameter
};

/// One number of a tablet; without a value where the run does not give it.
struct TabletNumber {
  std::string name, unit;
  std::optional<double> value, uncertainty; ///< in `unit`; no uncertainty where the number is exact, NaN: not known
};

/// All numbers of a tablet.
struct TabletMeasurement {
  Measurement measurement; ///< its value is the relative density in the die at the peak
  std::vector<TabletNumber> numbers;
};

/// All numbers and their rules are listed in docs/metrics.md, "tablet". Forces are read at the largest smoothed force
/// of the upper punch while it presses and holds. The lateral area is pi D H, H the distance of the punches; after
/// unloading, their distance when the upper punch left. Wall friction is that of janssen.hpp; thickness and diameter
/// are those of tablet_shape.hpp, between the snapshot at the end of pressing and that of the rule. Throws InputError
/// where tools or the pressing stage are missing; numbers of later stages or snapshots that are missing have no value,
/// and a note says why.
TabletMeasurement measure_tablet(const schema::FileReader& file, const TabletRule& rule);

/// One line per number: name, value ± uncertainty, unit.
std::string to_table(const std::vector<TabletNumber>& numbers);

} // namespace mpfem
