#include "postproc/figure/figure_fits.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

using Json = nlohmann::ordered_json;

Json axis_json(const std::string& column, const TextTable& table, const std::vector<double>& values) {
  const std::string& title = table.titles[table.column(column)];
  const std::size_t bracket = title.find(" [");
  Json json = {{"column", column}};
  json["unit"] = bracket == std::string::npos ? "1" : title.substr(bracket + 2, title.find(']') - bracket - 2);
  if (!values.empty()) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    json["range"] = {*low, *high};
  }
  return json;
}

} // namespace

FitPoints fit_points(const FitSpec& spec, const TextTable& table) {
  FitPoints points;
  points.path = table.path;
  const std::size_t x = table.column(spec.x, spec.place), y = table.column(spec.y, spec.place);
  const std::size_t z = spec.z.empty() ? x : table.column(spec.z, spec.place);
  for (const std::size_t row : table.rows_of(spec.where, spec.place)) {
    const auto x_here = table.number(row, x, spec.place), y_here = table.number(row, y, spec.place),
               z_here = table.number(row, z, spec.place);
    if (!x_here || !y_here || !z_here) continue;
    points.x.push_back(*x_here);
    points.y.push_back(*y_here);
    if (!spec.z.empty()) points.z.push_back(*z_here);
  }
  return points;
}

Json make_fits(const Figure& figure, const std::string& folder) {
  Json list = Json::array();
  for (const FitSpec& spec : figure.fits) {
    const TextTable table = read_text_table(path_of_table(figure.table(spec.table, spec.place), folder));
    const FitPoints points = fit_points(spec, table);
    Json json = {{"name", spec.name}, {"table", spec.table}};
    try {
      json.update(to_json(fit(spec.model, points, spec.relative_density)));
    } catch (const InputError& error) {
      json["model"] = spec.model;
      json["points"] = 0;
      json["refused"] = error.what();
    }
    json["relative_density"] = spec.relative_density;
    json["x"] = axis_json(spec.x, table, points.x);
    json["y"] = axis_json(spec.y, table, points.y);
    if (!spec.z.empty()) json["z"] = axis_json(spec.z, table, points.z);
    list.push_back(json);
  }
  return list;
}

const Json& fit_by_name(const Json& fits, const std::string& name) {
  for (const Json& fit : fits)
    if (fit.value("name", "") == name) return fit;
  throw InputError(fmt::format("the list of fits has no '{}'; run postproc fits again", one_line(name)));
}

std::function<double(double, double)>
model_with(const std::string& model, const std::map<std::string, double>& coefficients, bool x_is_relative_density) {
  const auto c = [&](const char* name) {
    const auto found = coefficients.find(name);
    if (found == coefficients.end())
      throw InputError(fmt::format("model '{}': coefficient {} is missing", model, name));
    return found->second;
  };
  const auto porosity = [x_is_relative_density](double x) { return x_is_relative_density ? 1 - x : x; };
  if (model == "linear") return [a = c("a"), b = c("b")](double x, double) { return a + b * x; };
  if (model == "bilinear")
    return [kink = c("kink"), y = c("y_kink"), below = c("slope_below"), above = c("slope_above")](double x, double) {
      return y + (x < kink ? below : above) * (x - kink);
    };
  if (model == "log-log") return [a = c("A"), b = c("b")](double x, double) { return a * std::pow(x, b); };
  if (model == "exponential") return [a = c("A"), b = c("B")](double x, double) { return a * std::exp(b * x); };
  if (model == "inverse-exponential")
    return [a = c("A"), b = c("B"), d = c("C")](double x, double) { return a - b * std::exp(-x / d); };
  if (model == "spriggs")
    return [a = c("a"), b = c("b"), porosity](double x, double) { return std::exp(b - a * porosity(x)); };
  if (model == "ryshkewitch-duckworth")
    return [s = c("sigma_0"), b = c("B"), porosity](double x, double) { return s * std::exp(-b * porosity(x)); };
  if (model == "rumpf") return [f = c("c"), porosity](double x, double) { return f * (1 - porosity(x)) / porosity(x); };
  if (model == "heckel") return [p = c("P_y"), a = c("A")](double x, double) { return -std::expm1(-(x / p + a)); };
  if (model == "kawakita") return [a = c("a"), b = c("b")](double x, double) { return a * b * x / (1 + b * x); };
  if (model == "walker") return [w = c("W"), d = c("c")](double x, double) { return 100 / (d - w * std::log10(x)); };
  if (model == "gurnham") return [s = c("c"), d = c("d")](double x, double) { return 1 - d + s * std::log(x); };
  if (model == "pc-gc-surface")
    return [a = c("A"), b = c("B"), p = c("C"), g = c("D")](double x, double z) {
      return a - b * std::exp(-x / p) * std::exp(-z / g);
    };
  throw InputError(fmt::format("there is no model '{}'", one_line(model)));
}

} // namespace mpfem
