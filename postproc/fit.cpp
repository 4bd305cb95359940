#include "postproc/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "postproc/least_squares.hpp"
#include "postproc/statistics.hpp"

namespace mpfem {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Entry {
  std::string name, formula;
  std::size_t coefficients;
};

const std::vector<Entry>& table() {
  static const std::vector<Entry> entries = {
      {"linear", "y = a + b x", 2},
      {"bilinear", "y = y_kink + (x < kink ? slope_below : slope_above) (x - kink)", 4},
      {"log-log", "y = A x^b", 2},
      {"exponential", "y = A exp(B x)", 2},
      {"inverse-exponential", "y = A - B exp(-x / C)", 3},
      {"spriggs", "ln y = b - a P", 2},
      {"ryshkewitch-duckworth", "y = sigma_0 exp(-B P)", 2},
      {"rumpf", "y = c (1 - P) / P", 1},
      {"pc-gc-surface", "y = A - B exp(-x / C) exp(-z / D)", 4}};
  return entries;
}

bool takes_porosity(const std::string& model) {
  return model == "spriggs" || model == "ryshkewitch-duckworth" || model == "rumpf";
}

VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

std::size_t distinct(const std::vector<double>& values) {
  return std::set<double>(values.begin(), values.end()).size();
}

void need_positive(const std::vector<double>& values, const char* which, const FitPoints& points,
                   const std::string& model) {
  for (const double value : values)
    if (!(value > 0))
      throw InputError(
          fmt::format("{}: model '{}': found {} = {:g}, allowed: > 0", one_line(points.path), model, which, value));
}

[[noreturn]] void undetermined(const FitPoints& points, const std::string& model, const std::string& why) {
  throw InputError(fmt::format("{}: model '{}': the points do not determine its coefficients: {}",
                               one_line(points.path), model, why));
}

Coefficient symmetric(const std::string& name, double value, double half) {
  return {name, value, value - half, value + half};
}

void set_quality(Fit& result, const VectorXd& y, double squares) {
  const double total = (y.array() - y.mean()).square().sum();
  result.r_squared = total > 0 ? 1 - squares / total : std::numeric_limits<double>::quiet_NaN();
  const auto freedom = y.size() - static_cast<Index>(result.coefficients.size());
  result.scatter = freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0;
}

/// Coefficients that enter linearly, with one column of the basis each.
void fit_linear(Fit& result, const FitPoints& points, const MatrixXd& basis, const VectorXd& y,
                const std::vector<std::string>& names) {
  const auto solution = linear_least_squares(basis, y);
  if (!solution) undetermined(points, result.model, "x hardly varies");
  for (Index i = 0; i < basis.cols(); ++i)
    result.coefficients.push_back(
        symmetric(names[static_cast<std::size_t>(i)], solution->parameters[i], solution->half_width[i]));
  set_quality(result, y, solution->squares);
}

/// y = sum over k of linear[k] * basis_k(point; nonlinear).
struct Separable {
  std::vector<std::string> linear, nonlinear;                                               ///< names
  std::function<void(std::size_t point, const VectorXd& nonlinear, VectorXd& basis)> basis; ///< one value per linear
  std::vector<std::vector<double>> grid; ///< values of each nonlinear coefficient to begin from, ascending
  bool positive = false;                 ///< the nonlinear ones stay above 0
};

MatrixXd basis_of(const Separable& model, std::size_t points, const VectorXd& nonlinear) {
  MatrixXd basis(static_cast<Index>(points), static_cast<Index>(model.linear.size()));
  VectorXd row(static_cast<Index>(model.linear.size()));
  for (std::size_t i = 0; i < points; ++i) {
    model.basis(i, nonlinear, row);
    basis.row(static_cast<Index>(i)) = row;
  }
  return basis;
}

ResidualFunction residuals_of(const Separable& model, const VectorXd& y) {
  return [&model, &y](const VectorXd& parameters, VectorXd& residual, MatrixXd& jacobian) {
    const auto points = static_cast<std::size_t>(y.size());
    const auto linear = static_cast<Index>(model.linear.size()), nonlinear = static_cast<Index>(model.nonlinear.size());
    const VectorXd a = parameters.head(linear), b = parameters.tail(nonlinear);
    if (model.positive && !(b.minCoeff() > 0)) return false;
    jacobian.resize(y.size(), linear + nonlinear);
    jacobian.leftCols(linear) = basis_of(model, points, b);
    residual = jacobian.leftCols(linear) * a - y;
    for (Index k = 0; k < nonlinear; ++k) { // central differences: error of the order 1e-10 of the derivative
      const double step = 1e-5 * std::max(std::abs(b[k]), 1e-8);
      VectorXd above = b, below = b;
      above[k] += step;
      below[k] -= step;
      jacobian.col(linear + k) = (basis_of(model, points, above) - basis_of(model, points, below)) * a / (2 * step);
    }
    return residual.allFinite() && jacobian.allFinite();
  };
}

void fit_separable(Fit& result, const FitPoints& points, const Separable& model, const VectorXd& y) {
  struct Start {
    double squares;
    VectorXd parameters;
  };
  std::vector<Start> starts;
  const std::size_t dimensions = model.grid.size();
  std::vector<std::size_t> index(dimensions, 0);
  for (bool more = true; more;) {
    VectorXd nonlinear(static_cast<Index>(dimensions));
    for (std::size_t d = 0; d < dimensions; ++d) nonlinear[static_cast<Index>(d)] = model.grid[d][index[d]];
    const MatrixXd basis = basis_of(model, points.x.size(), nonlinear);
    if (basis.allFinite())
      if (const auto solution = linear_least_squares(basis, y)) {
        VectorXd parameters(solution->parameters.size() + nonlinear.size());
        parameters << solution->parameters, nonlinear;
        starts.push_back({solution->squares, parameters});
      }
    std::size_t d = 0;
    while (d < dimensions && ++index[d] == model.grid[d].size()) index[d++] = 0;
    more = d < dimensions;
  }
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.squares < b.squares; });
  std::optional<LeastSquares> best;
  constexpr std::size_t starts_refined = 8;
  for (std::size_t i = 0; i < std::min(starts.size(), starts_refined); ++i) {
    const auto solution = levenberg_marquardt(residuals_of(model, y), starts[i].parameters);
    if (solution && (!best || solution->squares < best->squares)) best = solution;
  }
  if (!best) undetermined(points, result.model, "different sets fit equally well");
  const auto linear = static_cast<Index>(model.linear.size());
  for (Index i = 0; i < best->parameters.size(); ++i) {
    const auto k = static_cast<std::size_t>(i < linear ? i : i - linear);
    result.coefficients.push_back(
        symmetric(i < linear ? model.linear[k] : model.nonlinear[k], best->parameters[i], best->half_width[i]));
    if (i >= linear && model.positive &&
        (best->parameters[i] < model.grid[k].front() || best->parameters[i] > model.grid[k].back()))
      undetermined(points, result.model,
                   fmt::format("{} = {:.3g} lies beyond {:.3g} … {:.3g}, so that the points show no saturation",
                               model.nonlinear[k], best->parameters[i], model.grid[k].front(), model.grid[k].back()));
  }
  set_quality(result, y, best->squares);
}

double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// From a hundredth to a hundred times `scale`, each a third of a decade after the one before.
std::vector<double> decades(double scale) {
  std::vector<double> values;
  for (int third = -6; third <= 6; ++third) values.push_back(scale * std::pow(10.0, third / 3.0));
  return values;
}

/// Rates of both signs over x of this spread, and none.
std::vector<double> rates(double scale) {
  std::vector<double> values;
  for (const double rate : decades(1 / scale)) {
    values.push_back(rate);
    values.push_back(-rate);
  }
  values.push_back(0);
  return values;
}

/// y = first * exp(sign * rate * x).
void fit_exponential(Fit& result, const FitPoints& points, const std::vector<double>& x, const std::string& first,
                     const std::string& rate, double sign) {
  const Separable model{
      {first},
      {rate},
      [&](std::size_t i, const VectorXd& b, VectorXd& basis) { basis[0] = std::exp(sign * b[0] * x[i]); },
      {rates(spread(x))},
      false};
  fit_separable(result, points, model, as_vector(points.y));
  const double a = result.coefficients[0].value, b = sign * result.coefficients[1].value;
  result.at = [a, b](double at, double) { return a * std::exp(b * at); };
}

void fit_bilinear(Fit& result, const FitPoints& points) {
  const VectorXd x = as_vector(points.x), y = as_vector(points.y);
  const std::set<double> sorted(points.x.begin(), points.x.end());
  // Two points or more on either side: else one of the lines is free.
  const double low = *std::next(sorted.begin()), high = *std::prev(sorted.end(), 2);
  const auto solve = [&](double kink) {
    MatrixXd basis(x.size(), 3);
    basis.col(0).setOnes();
    basis.col(1) = (x.array() - kink).cwiseMin(0);
    basis.col(2) = (x.array() - kink).cwiseMax(0);
    return linear_least_squares(basis, y);
  };
  constexpr int kinks = 4000;
  std::vector<double> squares(kinks + 1);
  const auto kink_at = [&](int i) { return low + (high - low) * i / kinks; };
  int best = 0;
  for (int i = 0; i <= kinks; ++i) {
    const auto solution = solve(kink_at(i));
    squares[static_cast<std::size_t>(i)] = solution ? solution->squares : std::numeric_limits<double>::infinity();
    if (squares[static_cast<std::size_t>(i)] < squares[static_cast<std::size_t>(best)]) best = i;
  }
  const auto solution = solve(kink_at(best));
  if (!solution) undetermined(points, result.model, "x hardly varies");
  const auto freedom = static_cast<std::size_t>(x.size()) - 4;
  // The kink's interval is that of its profile: kinks whose squares are not larger than chance allows (Student's t).
  // The least squares are kept off 0, where points lie on two lines to rounding.
  const double t = student_t_95(freedom);
  const double least = std::max(solution->squares, 1e-24 * y.squaredNorm());
  const double limit = least * (1 + t * t / static_cast<double>(freedom));
  int from = best, to = best;
  for (int i = 0; i <= kinks; ++i)
    if (squares[static_cast<std::size_t>(i)] <= limit) {
      from = std::min(from, i);
      to = std::max(to, i);
    }
  const double kink = kink_at(best), step = (high - low) / kinks;
  result.coefficients.push_back(
      {"kink", kink, std::max(low, kink_at(from) - step), std::min(high, kink_at(to) + step)});
  // Half widths at the best kink, widened for the degree of freedom that the kink takes.
  const double widen =
      t / student_t_95(freedom + 1) * std::sqrt(static_cast<double>(freedom + 1) / static_cast<double>(freedom));
  const std::vector<std::string> names = {"y_kink", "slope_below", "slope_above"};
  for (Index i = 0; i < 3; ++i)
    result.coefficients.push_back(
        symmetric(names[static_cast<std::size_t>(i)], solution->parameters[i], widen * solution->half_width[i]));
  set_quality(result, y, solution->squares);
  if (from == 0 || to == kinks)
    result.notes.emplace_back("the kink's interval reaches the last points on a side: hardly better than one line");
  const VectorXd p = solution->parameters;
  result.at = [kink, p](double at, double) { return p[0] + (at < kink ? p[1] : p[2]) * (at - kink); };
}

} // namespace

const std::vector<std::string>& fit_models() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Entry& entry : table()) list.push_back(entry.name);
    return list;
  }();
  return names;
}

std::string fit_help() {
  std::string text;
  for (const Entry& entry : table()) text += fmt::format("  {:<22} {}\n", entry.name, entry.formula);
  return text;
}

Fit fit(const std::string& model, const FitPoints& points, bool x_is_relative_density) {
  const auto entry = std::find_if(table().begin(), table().end(), [&](const Entry& e) { return e.name == model; });
  if (entry == table().end()) {
    const auto near = nearest_word(model, fit_models());
    throw InputError(fmt::format("--model: found '{}'; {}", one_line(model),
                                 near ? fmt::format("did you mean '{}'?", *near)
                                      : fmt::format("allowed: {}", fmt::join(fit_models(), ", "))));
  }
  const std::string path = one_line(points.path);
  const std::size_t n = points.x.size();
  if (n < entry->coefficients + 1)
    throw InputError(fmt::format("{}: model '{}' has {} coefficients: found {} points, allowed: {} or more", path,
                                 model, entry->coefficients, n, entry->coefficients + 1));
  if (x_is_relative_density && !takes_porosity(model))
    throw InputError(
        fmt::format("--relative-density has no meaning with model '{}', which is not one of porosity", model));
  const bool surface = model == "pc-gc-surface";
  if (surface && points.z.size() != n)
    throw InputError(fmt::format("model '{}': found no --z, allowed: the column that holds G^c", model));
  if (!surface && !points.z.empty()) throw InputError(fmt::format("--z has no meaning with model '{}'", model));
  const std::size_t values_of_x = model == "bilinear" ? 5 : model == "rumpf" ? 1 : entry->coefficients;
  if (!surface && distinct(points.x) < values_of_x)
    throw InputError(fmt::format("{}: model '{}': found {} different x, allowed: {} or more", path, model,
                                 distinct(points.x), values_of_x));
  if (surface &&
      (std::min(distinct(points.x), distinct(points.z)) < 2 || std::max(distinct(points.x), distinct(points.z)) < 3))
    throw InputError(
        fmt::format("{}: model '{}': found {} different x and {} different z, allowed: 2 or more of each and 3 "
                    "of one",
                    path, model, distinct(points.x), distinct(points.z)));

  Fit result;
  result.model = model;
  result.formula = entry->formula;
  result.points = n;
  const VectorXd y = as_vector(points.y);
  std::vector<double> x = points.x; // as the model takes it: porosity where it does
  if (x_is_relative_density)
    for (double& value : x) value = 1 - value;
  const auto line_basis = [&](const VectorXd& abscissa) {
    MatrixXd basis(abscissa.size(), 2);
    basis << VectorXd::Ones(abscissa.size()), abscissa;
    return basis;
  };
  const auto value = [&](std::size_t i) { return result.coefficients[i].value; };

  if (model == "linear") {
    fit_linear(result, points, line_basis(as_vector(x)), y, {"a", "b"});
    result.at = [a = value(0), b = value(1)](double at, double) { return a + b * at; };
  } else if (model == "bilinear") {
    fit_bilinear(result, points);
  } else if (model == "log-log") {
    need_positive(x, "x", points, model);
    need_positive(points.y, "y", points, model);
    result.fitted_in = "ln y";
    fit_linear(result, points, line_basis(as_vector(x).array().log()), y.array().log(), {"A", "b"});
    Coefficient& a = result.coefficients[0];
    a = {"A", std::exp(a.value), std::exp(a.low), std::exp(a.high)};
    result.at = [a = value(0), b = value(1)](double at, double) { return a * std::pow(at, b); };
  } else if (model == "spriggs") {
    need_positive(points.y, "y", points, model);
    result.fitted_in = "ln y";
    fit_linear(result, points, line_basis(-as_vector(x)), y.array().log(), {"b", "a"});
    const Coefficient& b = result.coefficients[0];
    result.derived.push_back({"at_zero_porosity", std::exp(b.value), std::exp(b.low), std::exp(b.high)});
    result.at = [b = value(0), a = value(1)](double at, double) { return std::exp(b - a * at); };
  } else if (model == "rumpf") {
    for (const double p : x)
      if (!(p > 0 && p < 1))
        throw InputError(fmt::format("{}: model 'rumpf': found a porosity of {:g}, allowed: between 0 and 1", path, p));
    fit_linear(result, points, (1 - as_vector(x).array()) / as_vector(x).array(), y, {"c"});
    result.at = [c = value(0)](double at, double) { return c * (1 - at) / at; };
  } else if (model == "exponential") {
    fit_exponential(result, points, x, "A", "B", 1);
  } else if (model == "ryshkewitch-duckworth") {
    fit_exponential(result, points, x, "sigma_0", "B", -1);
  } else if (model == "inverse-exponential") {
    const Separable separable{
        {"A", "B"},
        {"C"},
        [&](std::size_t i, const VectorXd& c, VectorXd& basis) { basis << 1, -std::exp(-x[i] / c[0]); },
        {decades(spread(x))},
        true};
    fit_separable(result, points, separable, y);
    result.at = [a = value(0), b = value(1), c = value(2)](double at, double) { return a - b * std::exp(-at / c); };
  } else {
    const Separable separable{{"A", "B"},
                              {"C", "D"},
                              [&](std::size_t i, const VectorXd& c, VectorXd& basis) {
                                basis << 1, -std::exp(-x[i] / c[0] - points.z[i] / c[1]);
                              },
                              {decades(spread(x)), decades(spread(points.z))},
                              true};
    fit_separable(result, points, separable, y);
    result.at = [a = value(0), b = value(1), c = value(2), d = value(3)](double at, double z) {
      return a - b * std::exp(-at / c - z / d);
    };
  }
  if (x_is_relative_density)
    result.at = [of_porosity = result.at](double at, double z) { return of_porosity(1 - at, z); };

  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double residual = points.y[i] - result.at(points.x[i], points.z.empty() ? 0.0 : points.z[i]);
    squares += residual * residual;
  }
  const double total = (y.array() - y.mean()).square().sum();
  result.r_squared_of_y = total > 0 ? 1 - squares / total : std::numeric_limits<double>::quiet_NaN();
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
