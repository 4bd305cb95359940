#include "postproc/fits/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/bilinear_fit.hpp"
#include "postproc/fits/separable_fit.hpp"

namespace mpfem {

namespace {

using Eigen::VectorXd;

std::size_t distinct(const std::vector<double>& values) {
  return std::set<double>(values.begin(), values.end()).size();
}

void need_positive(const FitProblem& problem, const std::vector<double>& values, const char* which) {
  for (const double value : values)
    if (!(value > 0))
      throw InputError(fmt::format("{}: model '{}': found {} = {:g}, allowed: > 0", one_line(problem.points.path),
                                   problem.model, which, value));
}

double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// From a hundredth to a hundred times `scale`, three values per decade.
std::vector<double> decades(double scale) {
  std::vector<double> values;
  for (int third = -6; third <= 6; ++third) values.push_back(scale * std::pow(10.0, third / 3.0));
  return values;
}

/// Rates of both signs for x with a range of `scale`, and 0.
std::vector<double> rates(double scale) {
  std::vector<double> values;
  for (const double rate : decades(1 / scale)) {
    values.push_back(rate);
    values.push_back(-rate);
  }
  values.push_back(0);
  return values;
}

Fit fit_line(const FitProblem& problem) {
  const FitPoints& points = problem.points;
  Fit result = linear_fit(problem, line_basis(as_vector(points.x)), as_vector(points.y), {"a", "b"});
  const double a = result.coefficients[0].value, b = result.coefficients[1].value;
  result.at = [a, b](double at, double) { return a + b * at; };
  return result;
}

Fit fit_log_log(const FitProblem& problem) {
  const FitPoints& points = problem.points;
  need_positive(problem, points.x, "x");
  need_positive(problem, points.y, "y");
  Fit result =
      linear_fit(problem, line_basis(as_vector(points.x).array().log()), as_vector(points.y).array().log(), {"A", "b"});
  result.fitted_in = "ln y";
  Coefficient& first = result.coefficients[0];
  first = {"A", std::exp(first.value), std::exp(first.low), std::exp(first.high)};
  result.at = [a = first.value, b = result.coefficients[1].value](double at, double) { return a * std::pow(at, b); };
  return result;
}

void need_porosity(const FitProblem& problem) {
  for (const double porosity : problem.points.x)
    if (!(porosity >= 0 && porosity < 1))
      throw InputError(fmt::format("{}: model '{}': found a porosity of {:g}, allowed: from 0 to below 1",
                                   one_line(problem.points.path), problem.model, porosity));
}

Fit fit_spriggs(const FitProblem& problem) {
  const FitPoints& points = problem.points;
  need_porosity(problem);
  need_positive(problem, points.y, "y");
  Fit result = linear_fit(problem, line_basis(-as_vector(points.x)), as_vector(points.y).array().log(), {"b", "a"});
  result.fitted_in = "ln y";
  const Coefficient& offset = result.coefficients[0];
  result.derived.push_back({"at_zero_porosity", std::exp(offset.value), std::exp(offset.low), std::exp(offset.high)});
  result.at = [b = offset.value, a = result.coefficients[1].value](double at, double) { return std::exp(b - a * at); };
  return result;
}

Fit fit_rumpf(const FitProblem& problem) {
  const FitPoints& points = problem.points;
  for (const double porosity : points.x)
    if (!(porosity > 0 && porosity < 1))
      throw InputError(fmt::format("{}: model 'rumpf': found a porosity of {:g}, allowed: between 0 and 1",
                                   one_line(points.path), porosity));
  const VectorXd x = as_vector(points.x);
  Fit result = linear_fit(problem, (1 - x.array()) / x.array(), as_vector(points.y), {"c"});
  result.at = [c = result.coefficients[0].value](double at, double) { return c * (1 - at) / at; };
  return result;
}

/// y = first * exp(sign * rate * x).
Fit fit_exponential(const FitProblem& problem, const std::string& first, const std::string& rate, double sign) {
  const std::vector<double>& x = problem.points.x;
  Fit result = separable_fit(
      problem, {{first},
                {rate},
                [&](std::size_t i, const VectorXd& b, VectorXd& basis) { basis[0] = std::exp(sign * b[0] * x[i]); },
                {rates(spread(x))},
                false});
  const double a = result.coefficients[0].value, b = sign * result.coefficients[1].value;
  result.at = [a, b](double at, double) { return a * std::exp(b * at); };
  return result;
}

Fit fit_growth(const FitProblem& problem) {
  return fit_exponential(problem, "A", "B", 1);
}

Fit fit_ryshkewitch_duckworth(const FitProblem& problem) {
  need_porosity(problem);
  return fit_exponential(problem, "sigma_0", "B", -1);
}

Fit fit_saturation(const FitProblem& problem) {
  const std::vector<double>& x = problem.points.x;
  Fit result = separable_fit(
      problem, {{"A", "B"},
                {"C"},
                [&](std::size_t i, const VectorXd& c, VectorXd& basis) { basis << 1, -std::exp(-x[i] / c[0]); },
                {decades(spread(x))},
                true});
  const double a = result.coefficients[0].value, b = result.coefficients[1].value, c = result.coefficients[2].value;
  result.at = [a, b, c](double at, double) { return a - b * std::exp(-at / c); };
  return result;
}

Fit fit_surface(const FitProblem& problem) {
  const std::vector<double>&x = problem.points.x, &z = problem.points.z;
  const auto basis_at = [&](std::size_t i, const VectorXd& c, VectorXd& basis) {
    basis << 1, -std::exp(-x[i] / c[0] - z[i] / c[1]);
  };
  Fit result =
      separable_fit(problem, {{"A", "B"}, {"C", "D"}, basis_at, {decades(spread(x)), decades(spread(z))}, true});
  const auto value = [&](std::size_t i) { return result.coefficients[i].value; };
  result.at = [a = value(0), b = value(1), c = value(2), d = value(3)](double at, double z_at) {
    return a - b * std::exp(-at / c - z_at / d);
  };
  return result;
}

void need_density(const FitProblem& problem, double largest) {
  for (const double density : problem.points.y)
    if (!(density > 0 && density <= largest))
      throw InputError(fmt::format("{}: model '{}': found y = {:g}, allowed: above 0, up to {:g}",
                                   one_line(problem.points.path), problem.model, density, largest));
}

/// 1/slope of a line, with its interval. Throws InputError where the slope is not positive.
Coefficient inverse_slope(const FitProblem& problem, const std::string& name, const Coefficient& slope) {
  if (!(slope.value > 0)) refuse_undetermined(problem, "y does not grow with x as the model has it");
  const double half = 0.5 * (slope.high - slope.low) / (slope.value * slope.value);
  return symmetric(name, 1 / slope.value, half);
}

/// Beyond this relative density the logarithm turns small errors of the density into large errors of the pressure.
constexpr double largest_heckel_density = 0.98;

Fit fit_heckel(const FitProblem& problem) {
  need_density(problem, largest_heckel_density);
  const VectorXd y = -(-as_vector(problem.points.y).array()).log1p();
  Fit result = linear_fit(problem, line_basis(as_vector(problem.points.x)), y, {"A", "P_y"});
  result.fitted_in = "ln 1/(1 - y)";
  result.coefficients[1] = inverse_slope(problem, "P_y", result.coefficients[1]);
  result.at = [a = result.coefficients[0].value, p = result.coefficients[1].value](double at, double) {
    return -std::expm1(-(at / p + a));
  };
  return result;
}

Fit fit_kawakita(const FitProblem& problem) {
  need_positive(problem, problem.points.x, "x");
  need_density(problem, 1);
  const VectorXd x = as_vector(problem.points.x), y = x.array() / as_vector(problem.points.y).array();
  Fit result = linear_fit(problem, line_basis(x), y, {"1/(ab)", "a"});
  const double slope = result.coefficients[1].value;
  const Coefficient a = inverse_slope(problem, "a", result.coefficients[1]);
  const double inverse_b = result.coefficients[0].value / slope;
  if (!(inverse_b > 0)) refuse_undetermined(problem, "x/y does not begin above 0, so b is not positive");
  // The line is 0 at x = -1/b: its uncertainty there, over its slope, is the uncertainty of 1/b.
  const Fit at_root = linear_fit(problem, line_basis(x.array() + inverse_b), y, {"root", "slope"});
  const double half = 0.5 * (at_root.coefficients[0].high - at_root.coefficients[0].low) / slope;
  result.fitted_in = "x/y";
  result.coefficients = {a, symmetric("b", 1 / inverse_b, half / (inverse_b * inverse_b))};
  result.derived.push_back(symmetric("inverse_b", inverse_b, half));
  result.at = [a = a.value, b = 1 / inverse_b](double at, double) { return a * b * at / (1 + b * at); };
  return result;
}

Fit fit_walker(const FitProblem& problem) {
  need_positive(problem, problem.points.x, "x");
  need_density(problem, 1);
  const VectorXd y = 100 / as_vector(problem.points.y).array();
  Fit result = linear_fit(problem, line_basis(-as_vector(problem.points.x).array().log10()), y, {"c", "W"});
  result.fitted_in = "100/y";
  result.at = [c = result.coefficients[0].value, w = result.coefficients[1].value](double at, double) {
    return 100 / (c - w * std::log10(at));
  };
  return result;
}

Fit fit_gurnham(const FitProblem& problem) {
  need_positive(problem, problem.points.x, "x");
  need_density(problem, 1);
  const VectorXd y = 1 - as_vector(problem.points.y).array();
  Fit result = linear_fit(problem, line_basis(-as_vector(problem.points.x).array().log()), y, {"d", "c"});
  result.fitted_in = "1 - y";
  result.at = [d = result.coefficients[0].value, c = result.coefficients[1].value](double at, double) {
    return 1 - d + c * std::log(at);
  };
  return result;
}

enum class Takes { x, porosity, x_and_z };

struct Model {
  std::string name, formula;
  std::vector<std::string> coefficients;
  std::size_t different_x; ///< number that it needs; unused for surfaces
  Takes takes;
  Fit (*fit)(const FitProblem&);
  std::vector<std::string> derived = {};
};

const std::vector<Model>& models() {
  static const std::vector<Model> list = {
      {"linear", "y = a + b x", {"a", "b"}, 2, Takes::x, fit_line},
      {"bilinear",
       "y = y_kink + (x < kink ? slope_below : slope_above) (x - kink)",
       {"kink", "y_kink", "slope_below", "slope_above"},
       5,
       Takes::x,
       bilinear_fit},
      {"log-log", "y = A x^b", {"A", "b"}, 2, Takes::x, fit_log_log},
      {"exponential", "y = A exp(B x)", {"A", "B"}, 2, Takes::x, fit_growth},
      {"inverse-exponential", "y = A - B exp(-x / C)", {"A", "B", "C"}, 3, Takes::x, fit_saturation},
      {"spriggs", "ln y = b - a P", {"a", "b"}, 2, Takes::porosity, fit_spriggs, {"at_zero_porosity"}},
      {"ryshkewitch-duckworth",
       "y = sigma_0 exp(-B P)",
       {"sigma_0", "B"},
       2,
       Takes::porosity,
       fit_ryshkewitch_duckworth},
      {"rumpf", "y = c (1 - P) / P", {"c"}, 1, Takes::porosity, fit_rumpf},
      {"heckel", "ln 1/(1 - y) = x / P_y + A", {"P_y", "A"}, 2, Takes::x, fit_heckel},
      {"kawakita", "y = a b x / (1 + b x)", {"a", "b"}, 2, Takes::x, fit_kawakita, {"inverse_b"}},
      {"walker", "100/y = c - W log10 x", {"c", "W"}, 2, Takes::x, fit_walker},
      {"gurnham", "1 - y = d - c ln x", {"d", "c"}, 2, Takes::x, fit_gurnham},
      {"pc-gc-surface", "y = A - B exp(-x / C) exp(-z / D)", {"A", "B", "C", "D"}, 0, Takes::x_and_z, fit_surface}};
  return list;
}

/// Throws InputError that suggests the nearest name where there is no such model.
const Model& model_by_name(const std::string& name) {
  for (const Model& model : models())
    if (model.name == name) return model;
  throw InputError(fmt::format("--model: found '{}'{}", one_line(name), suggestion(name, fit_models())));
}

/// Throws InputError where the points are too few for the model.
void check_different_values(const Model& model, const FitPoints& points) {
  const std::size_t of_x = distinct(points.x);
  if (model.takes != Takes::x_and_z) {
    if (of_x < model.different_x)
      throw InputError(fmt::format("{}: model '{}': found {} different x, allowed: {} or more", one_line(points.path),
                                   model.name, of_x, model.different_x));
    return;
  }
  const std::size_t of_z = distinct(points.z);
  if (std::min(of_x, of_z) < 2 || std::max(of_x, of_z) < 3)
    throw InputError(
        fmt::format("{}: model '{}': found {} different x and {} different z, allowed: 2 or more of each and 3 "
                    "of one",
                    one_line(points.path), model.name, of_x, of_z));
}

/// Throws InputError where the points, or the meaning given for x, do not suit the model.
void check_points(const Model& model, const FitPoints& points, bool x_is_relative_density) {
  const std::size_t n = points.x.size();
  const std::size_t coefficients = model.coefficients.size();
  if (n < coefficients + 1)
    throw InputError(fmt::format("{}: model '{}' has {} coefficients: found {} points, allowed: {} or more",
                                 one_line(points.path), model.name, coefficients, n, coefficients + 1));
  if (x_is_relative_density && model.takes != Takes::porosity)
    throw InputError(
        fmt::format("--relative-density cannot be used with model '{}', which is not one of porosity", model.name));
  const bool surface = model.takes == Takes::x_and_z;
  if (surface && points.z.size() != n)
    throw InputError(fmt::format("model '{}': found no --z, allowed: the column that holds G^c", model.name));
  if (!surface && !points.z.empty()) throw InputError(fmt::format("--z cannot be used with model '{}'", model.name));
  check_different_values(model, points);
}

/// R^2 of y itself, whatever quantity was fitted.
double r_squared_of_y(const Fit& fit, const FitPoints& points) {
  double squares = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double residual = points.y[i] - fit.at(points.x[i], points.z.empty() ? 0.0 : points.z[i]);
    squares += residual * residual;
  }
  const VectorXd y = as_vector(points.y);
  const double total = (y.array() - y.mean()).square().sum();
  return total > 0 ? 1 - squares / total : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

const std::vector<std::string>& fit_models() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Model& model : models()) list.push_back(model.name);
    return list;
  }();
  return names;
}

std::vector<std::string> coefficients_of(const std::string& model) {
  return model_by_name(model).coefficients;
}

std::vector<std::string> derived_of(const std::string& model) {
  return model_by_name(model).derived;
}

std::string fit_help() {
  std::string text;
  for (const Model& model : models()) text += fmt::format("  {:<22} {}\n", model.name, model.formula);
  return text;
}

Fit fit(const std::string& name, const FitPoints& points, bool x_is_relative_density) {
  const Model& model = model_by_name(name);
  check_points(model, points, x_is_relative_density);
  FitProblem problem{name, points};
  if (x_is_relative_density)
    for (double& value : problem.points.x) value = 1 - value;
  Fit result = model.fit(problem);
  result.model = model.name;
  result.formula = model.formula;
  result.points = points.x.size();
  if (x_is_relative_density)
    result.at = [of_porosity = result.at](double at, double z) { return of_porosity(1 - at, z); };
  result.r_squared_of_y = r_squared_of_y(result, points);
  return result;
}

nlohmann::ordered_json to_json(const Fit& f) {
  nlohmann::ordered_json json = {{"model", f.model},         {"formula", f.formula},
                                 {"fitted_in", f.fitted_in}, {"points", f.points},
                                 {"r_squared", f.r_squared}, {"r_squared_of_y", f.r_squared_of_y},
                                 {"scatter", f.scatter}};
  for (const Coefficient& c : f.coefficients)
    json["coefficients"][c.name] = {{"value", c.value}, {"low", c.low}, {"high", c.high}};
  for (const Coefficient& c : f.derived)
    json["derived"][c.name] = {{"value", c.value}, {"low", c.low}, {"high", c.high}};
  json["notes"] = f.notes;
  return json;
}

} // namespace mpfem
