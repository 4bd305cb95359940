#pragma once
// How fields are named and scaled in pictures.

#include <string>
#include <utility>
#include <vector>

namespace mpfem {

/// "von Mises stress" for von_mises; the same for pressure and plastic_strain.
std::string field_label(const std::string& field);

/// "LABEL (UNIT)", without the unit where it is 1.
std::string with_unit(const std::string& label, const std::string& unit);

/// The ends of a colour scale for these values and their areas: 0 (or, where lower, the 0.5th percentile) … the 99.5th
/// percentile by area, wider than nothing. What is not finite does not count: a failed run's last state may hold some.
std::pair<double, double> colour_range(std::vector<std::pair<double, double>> value_and_area);

} // namespace mpfem
