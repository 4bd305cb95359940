#pragma once
// How fields are named and scaled in pictures.

#include <string>
#include <utility>
#include <vector>

namespace mpfem {

/// Label of a field: von_mises, pressure, damage; that of the plastic strain for any other name.
std::string field_label(const std::string& field);

/// "LABEL (UNIT)", or "LABEL" for the unit 1.
std::string with_unit(const std::string& label, const std::string& unit);

/// The ends of a colour scale for these values and their areas: 0 (or the 0.5th percentile by area where that is lower)
/// and the 99.5th percentile; ends that coincide are set 1 apart. Values that are not finite do not count: the last
/// state of a failed run may hold some.
std::pair<double, double> colour_range(std::vector<std::pair<double, double>> value_and_area);

} // namespace mpfem
