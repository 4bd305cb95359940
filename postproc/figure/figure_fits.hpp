#pragma once
// A figure's fits through the points of its tables.

#include "postproc/figure/text_table.hpp"
#include "postproc/fits/fit.hpp"

namespace mpfem {

/// The points of a fit; rows in which a column is empty are left out.
FitPoints fit_points(const FitSpec& spec, const TextTable& table);

/// All fits of a figure as a list, each with its name, table, columns and ranges. A fit that the points do not allow
/// has its reason, "refused", and no coefficients. Tables are read from `folder`. Throws InputError where a table or
/// column is missing.
nlohmann::ordered_json make_fits(const Figure& figure, const std::string& folder);

/// The fit of this name in such a list, refused or not. Throws InputError where there is none.
const nlohmann::ordered_json& fit_by_name(const nlohmann::ordered_json& fits, const std::string& name);

/// y of a model with these coefficients. Throws InputError: unknown model, missing coefficient.
std::function<double(double x, double z)>
model_with(const std::string& model, const std::map<std::string, double>& coefficients, bool x_is_relative_density);

} // namespace mpfem
