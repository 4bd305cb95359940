// fit: models through the points of a CSV file.

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/files/csv_file.hpp"
#include "postproc/files/notes.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/fits/fit.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

namespace {

/// The columns of the file that are fitted; `z` for surfaces only.
struct NamedPoints {
  Column x, y;
  std::optional<Column> z;
  std::size_t rows_left_out = 0; ///< with an empty cell in these columns
};

std::array<double, 2> whole_range(const std::vector<double>& values) {
  return range_of(values, 0, values.size() - 1);
}

/// y of every fit at 201 values of x over the range of the points.
std::vector<Column> curves_of(const std::vector<Fit>& fits, const NamedPoints& points) {
  constexpr int intervals = 200;
  const auto [low, high] = whole_range(points.x.values);
  std::vector<Column> table = {{points.x.name, points.x.unit, {}}};
  for (int i = 0; i <= intervals; ++i) table[0].values.push_back(low + (high - low) * i / intervals);
  for (const Fit& fit : fits) {
    Column curve{fit.model, points.y.unit, {}};
    for (const double x : table[0].values) curve.values.push_back(fit.at(x, 0));
    table.push_back(std::move(curve));
  }
  return table;
}

nlohmann::ordered_json column_json(const Column& column) {
  return {{"column", column.name}, {"unit", column.unit}, {"range", whole_range(column.values)}};
}

nlohmann::ordered_json fits_json(const std::vector<Fit>& fits, const NamedPoints& points, bool x_is_relative_density) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Fit& fit : fits) {
    nlohmann::ordered_json one = to_json(fit);
    one["x"] = column_json(points.x);
    one["x"]["porosity_is_1_minus_x"] = x_is_relative_density;
    one["y"] = column_json(points.y);
    if (points.z) one["z"] = column_json(*points.z);
    one["rows_left_out"] = points.rows_left_out;
    list.push_back(one);
  }
  return list;
}

/// "-" where the points do not determine it.
std::string number_text(const char* format, double number) {
  return std::isfinite(number) ? fmt::format(fmt::runtime(format), number) : "-";
}

std::string text_of(const Fit& fit) {
  std::string coefficients;
  for (const Coefficient& c : fit.coefficients)
    coefficients += fmt::format("{} = {:.5g} [{}, {}], ", c.name, c.value, number_text("{:.4g}", c.low),
                                number_text("{:.4g}", c.high));
  return fmt::format("{}: {}; {}R^2 = {} of {}, {} points\n", fit.model, fit.formula, coefficients,
                     number_text("{:.4f}", fit.r_squared), fit.fitted_in, fit.points);
}

class FitCommand : public ResultCommand {
public:
  explicit FitCommand(CLI::App& app)
      : ResultCommand(
            app, "fit",
            "Fits models to points of a CSV file: coefficients with their 95 % intervals and R^2.\nModels:\n" +
                fit_help() +
                "Example: postproc fit strength.csv --x porosity --y strength --model "
                "ryshkewitch-duckworth,rumpf -o fits.json\n"
                "Example: postproc fit q.csv --x p_c --z G_c --y q --model pc-gc-surface",
            "JSON file to write, a list of fits", json_file) {
    add_input("points", points_,
              "CSV file with a heading, \"name [unit],…\"; columns that are not used may hold text, rows with "
              "an empty cell in those that are used are left out")
        ->required();
    options().add_option("--x", x_, "Column, without its unit")->required();
    options().add_option("--y", y_, "Column")->required();
    options().add_option("--z", z_, "Column: G^c of pc-gc-surface");
    separated_by_commas(options().add_option("--model", models_, "Models, separated by commas"))->required();
    options().add_flag("--relative-density", x_is_relative_density_,
                       "x holds relative densities: the porosity P is 1 - x");
    add_output("--curve", curve_, "CSV file to write: the fitted curves at 201 values of x", csv_file);
  }

private:
  NamedPoints read_points() const {
    std::vector<WantedColumn> wanted = {{x_, "--x"}, {y_, "--y"}};
    if (!z_.empty()) wanted.push_back({z_, "--z"});
    const CompleteRows rows = read_complete_rows(points_, wanted);
    NamedPoints points{rows.columns[0], rows.columns[1], {}, rows.left_out};
    if (!z_.empty()) points.z = rows.columns[2];
    return points;
  }

  /// Empty if no row is left out.
  static std::string left_out_text(const NamedPoints& points) {
    if (points.rows_left_out == 0) return {};
    return fmt::format("rows left out, because a column of the fit is empty there: {} of {}", points.rows_left_out,
                       points.rows_left_out + points.x.values.size());
  }

  std::vector<Fit> fits_of(const NamedPoints& points) const {
    const std::string left_out = left_out_text(points);
    const FitPoints values{points.x.values, points.y.values, points.z ? points.z->values : std::vector<double>(),
                           left_out.empty() ? points_ : fmt::format("{} ({})", points_, left_out)};
    std::vector<Fit> fits;
    for (const std::string& model : models_) fits.push_back(fit(model, values, x_is_relative_density_));
    return fits;
  }

  void execute() const override {
    const NamedPoints points = read_points();
    const std::vector<Fit> fits = fits_of(points);
    if (!curve_.empty()) {
      if (points.z) throw InputError("--curve: found a surface, allowed: a model of x alone");
      write_file(curve_, csv_text(curves_of(fits, points)));
    }
    if (!output().empty()) write_file(output(), fits_json(fits, points, x_is_relative_density_).dump(2) + "\n");
    if (quiet()) return;
    if (points.rows_left_out > 0) print_notes({left_out_text(points)});
    for (const Fit& fit : fits) {
      fmt::print("{}", text_of(fit));
      for (const std::string& note : fit.notes) print_notes({fmt::format("{}: {}", fit.model, note)});
    }
  }

  std::string points_, x_, y_, z_, curve_; ///< files and columns
  std::vector<std::string> models_;
  bool x_is_relative_density_ = false;
};

} // namespace

std::unique_ptr<Command> fit_command(CLI::App& app) {
  return std::make_unique<FitCommand>(app);
}

} // namespace mpfem
