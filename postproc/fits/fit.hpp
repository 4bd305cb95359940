#pragma once
// Fits of the correlations that are usual in studies of compaction.

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace mpfem {

/// Points of a fit: x and y have the same length; z too, for surfaces, otherwise it is empty.
struct FitPoints {
  std::vector<double> x, y, z;
  std::string path = "points"; ///< for messages
};

/// A fitted coefficient with its interval.
struct Coefficient {
  std::string name;
  double value = 0, low = 0, high = 0; ///< low and high: ends of the 95 % interval
};

/// A model fitted to points.
struct Fit {
  std::string model, formula;
  std::string fitted_in = "y"; ///< "y", "ln y", "x/y" …: quantity whose squares are summed; r_squared is of it
  std::vector<Coefficient> coefficients;
  std::vector<Coefficient> derived; ///< what follows from them: spriggs gives E_p / E "at_zero_porosity"
  double r_squared = 0;
  double r_squared_of_y = 0; ///< of y itself, also where another quantity is fitted
  double scatter = 0;        ///< standard deviation of the residuals, in `fitted_in`
  std::size_t points = 0;
  std::vector<std::string> notes;
  std::function<double(double x, double z)> at; ///< y of the fitted model
};

/// Names of the models, in the order of the help.
const std::vector<std::string>& fit_models();

/// Names of a model's coefficients, and of what a fit derives from them. Throw InputError: unknown model.
std::vector<std::string> coefficients_of(const std::string& model);
std::vector<std::string> derived_of(const std::string& model);

/// For help texts: a line with name and formula for each model.
std::string fit_help();

/// Models (P = x is the porosity, or with `x_is_relative_density` 1 - x):
///   linear                y = a + b x
///   bilinear              two lines that meet at x = kink (paper, Fig. 10a)
///   log-log               ln y = ln A + b ln x (Figs. 10b, 13b)
///   exponential           y = A exp(B x) (Fig. 16b)
///   inverse-exponential   y = A - B exp(-x / C) (Fig. 16a)
///   spriggs               ln y = b - a P, y = E_p / E (Eq. 10 with the paper's offset b)
///   ryshkewitch-duckworth y = sigma_0 exp(-B P) (Eq. 11)
///   rumpf                 y = c (1 - P) / P, c = F / d^2 (Eq. 12)
///   heckel                ln 1/(1 - y) = x / P_y + A, x pressure, y relative density up to 0.98 (Heckel 1961)
///   kawakita              x/y = x/a + 1/(a b), y = (V_0 - V)/V_0 the loss of volume (Kawakita and Luedde 1971)
///   walker                100/y = c - W log10 x, y relative density (Walker 1923)
///   gurnham               1 - y = d - c ln x, y relative density (Gurnham and Masson 1946)
///   pc-gc-surface         y = A - B exp(-x / C) exp(-z / D), x = p_c, z = G^c (Eq. 13 with the sign of p_c corrected)
/// Models with coefficients that do not enter linearly are searched on a grid of these, with the linear ones solved at
/// each point, and refined by the Levenberg-Marquardt method from the best grid points: no start values are needed.
/// Throws InputError: unknown model, too few points, values outside a model's domain, points that do not determine a
/// coefficient.
Fit fit(const std::string& model, const FitPoints& points, bool x_is_relative_density = false);

/// All of it but the function `at`.
nlohmann::ordered_json to_json(const Fit& fit);

} // namespace mpfem
