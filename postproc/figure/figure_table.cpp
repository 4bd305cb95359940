#include "postproc/figure/figure_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "postproc/figure/filter_notes.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

namespace {

using Json = nlohmann::ordered_json;

/// The JSON files of metrics, each read once.
class MetricFiles {
public:
  const Json& at(const std::string& path) {
    const auto known = files_.find(path);
    if (known != files_.end()) return known->second;
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: no such file; the figure's rules make it first", one_line(path)));
    Json json = Json::parse(file, nullptr, false);
    if (!json.is_object())
      throw InputError(fmt::format("{}: found no JSON object, allowed: the JSON file of a metric", one_line(path)));
    return files_.emplace(path, std::move(json)).first->second;
  }

  std::vector<std::string> paths() const {
    std::vector<std::string> paths;
    for (const auto& [path, json] : files_) paths.push_back(path);
    return paths;
  }

private:
  std::map<std::string, Json> files_;
};

/// The value of a metric's key. It is empty for every key if the metric could not be measured ("value" is null);
/// otherwise a missing key is an error.
Value value_of_key(const Json& metric, const std::string& key, const std::string& path, const Place& place) {
  const auto found = metric.find(key);
  if (found == metric.end()) {
    const auto value = metric.find("value");
    if (value != metric.end() && value->is_null()) return {};
    std::vector<std::string> keys;
    for (const auto& [name, entry] : metric.items()) keys.push_back(name);
    place.fail(fmt::format("{} has no key '{}'{}", one_line(path), key, suggestion(key, keys)));
  }
  if (found->is_null()) return {};
  if (found->is_number()) return {found->dump(), found->get<double>()};
  if (found->is_string()) return {found->get<std::string>(), {}};
  if (found->is_boolean()) return {found->get<bool>() ? "true" : "false", {}};
  place.fail(fmt::format("{}: key '{}' is a list or a table, allowed: a number or a text", one_line(path), key));
}

/// A row of a history, with the row in which its stage began.
struct HistoryRow {
  const HistoryTable& history;
  std::size_t row, begin;
  double operator()(const char* column) const { return history[column][row]; }
  double then(const char* column) const { return history[column][begin]; }
  double since(const char* column) const { return (*this)(column)-then(column); }
};

struct CurveColumn {
  std::string name, meaning;
  std::function<double(const HistoryRow&)> value;
};

/// Number of times, up to `row`, that the mean stress has begun to rise again after a fall to a fiftieth of its largest
/// value.
double cycles_before(const HistoryTable& h, std::size_t begin, std::size_t row) {
  const auto& p = h["mean_stress"];
  const double low = *std::max_element(p.begin(), p.end()) / 50;
  int cycles = 0;
  bool loaded = true;
  for (std::size_t i = begin + 1; i <= row; ++i) {
    if (!loaded && p[i] > p[i - 1]) {
      ++cycles;
      loaded = true;
    }
    if (p[i] <= low && p[i - 1] > p[i]) loaded = false;
  }
  return cycles;
}

/// Mean normal force (N) of the six walls.
double mean_wall_force(const HistoryRow& r) {
  const double x = r("box_lengths_0"), y = r("box_lengths_1"), z = r("box_lengths_2");
  return ((r("wall_stress_0") + r("wall_stress_1")) * y * z + (r("wall_stress_2") + r("wall_stress_3")) * z * x +
          (r("wall_stress_4") + r("wall_stress_5")) * r.history.section(r.row)) /
         6;
}

const std::vector<CurveColumn>& curve_columns() {
  static const std::vector<CurveColumn> columns = {
      {"axial_stress", "mean of both z walls, MPa",
       [](const HistoryRow& r) { return (r("wall_stress_4") + r("wall_stress_5")) / 2; }},
      {"lateral_stress", "mean of the four lateral walls, MPa",
       [](const HistoryRow& r) {
         return (r("wall_stress_0") + r("wall_stress_1") + r("wall_stress_2") + r("wall_stress_3")) / 4;
       }},
      {"upper_plate_force", "force of the upper z wall, N",
       [](const HistoryRow& r) { return r("wall_stress_5") * r.history.section(r.row); }},
      {"mean_wall_force", "of the six walls, N", mean_wall_force},
      {"displacement", "approach of the z walls since the stage began, mm",
       [](const HistoryRow& r) { return r.then("box_lengths_2") - r("box_lengths_2"); }},
      {"stage_axial_strain", "logarithmic, since the stage began; compression positive",
       [](const HistoryRow& r) { return std::log(r.then("box_lengths_2") / r("box_lengths_2")); }},
      {"stage_volumetric_strain", "the same for the volume",
       [](const HistoryRow& r) {
         return std::log(r.history.container_volume(r.begin) / r.history.container_volume(r.row));
       }},
      {"stage_plastic_dissipation", "since the stage began, mJ",
       [](const HistoryRow& r) { return r.since("plastic_dissipation"); }},
      {"stage_damage_dissipation", "since the stage began, mJ",
       [](const HistoryRow& r) { return r.since("damage_dissipation"); }},
      {"dissipation", "plastic and damage, since the beginning of the first run of the chain, mJ",
       [](const HistoryRow& r) { return r("plastic_dissipation") + r("damage_dissipation"); }},
      {"cycle", "number of times that p has risen again from below a fiftieth of its largest value",
       [](const HistoryRow& r) { return cycles_before(r.history, r.begin, r.row); }},
      {"kinetic_ratio", "kinetic over internal energy of the row's stage; 0 where that is 0", {}}};
  return columns;
}

/// The internal energy of all rows is found once.
std::function<double(const HistoryRow&)> kinetic_ratio(const HistoryTable& history) {
  return [internal = internal_energy(history)](const HistoryRow& r) {
    return internal[r.row] > 0 ? r("kinetic_energy") / internal[r.row] : 0.0;
  };
}

std::function<double(const HistoryRow&)> curve_column(const HistoryTable& history, const std::string& name,
                                                      const Place& place) {
  if (name == "kinetic_ratio") return kinetic_ratio(history);
  for (const CurveColumn& column : curve_columns())
    if (column.name == name) return column.value;
  std::vector<std::string> names;
  for (const CurveColumn& column : curve_columns()) names.push_back(column.name);
  for (const Column& column : history.columns()) {
    if (column.name == name) return [name](const HistoryRow& r) { return r(name.c_str()); };
    names.push_back(column.name);
  }
  place.fail(fmt::format("the history has no column '{}'{}", name, suggestion(name, names)));
}

/// Path of the JSON file of the metric that a column names.
std::string metric_path(const Figure& figure, const ColumnSpec& column, const Place& place,
                        const ResultsFolder& results, const Case& row) {
  return fmt::format("{}/{}.json", results.of(folder_of(figure, figure.run(column.run, place), row)),
                     filled_at(place, column.metric, row.values));
}

/// [columns], divisors of a curve's columns: 1, or a metric's number.
std::vector<double> divisors_of(const Figure& figure, const TableSpec& spec, const ResultsFolder& results,
                                const Case& row, MetricFiles& files) {
  std::vector<double> divisors;
  for (const ColumnSpec& column : spec.columns) {
    divisors.push_back(1);
    if (column.run.empty()) continue;
    const std::string path = metric_path(figure, column, spec.place, results, row);
    divisors.back() = value_of_key(files.at(path), column.key, path, spec.place).number.value_or(std::nan(""));
  }
  return divisors;
}

/// A number in the column's format, otherwise with the table's digits; 17 digits stand for the shortest text that reads
/// back to the same number. Empty if it is not finite, as over a metric that could not be measured.
Value curve_cell(double number, const TableSpec& spec, const ColumnSpec& column) {
  if (!std::isfinite(number)) return {};
  if (!column.format.empty())
    return Value::of_text(
        filled_at(spec.place, fmt::format("{{value:{}}}", column.format), {{"value", Value::of(number)}}));
  return spec.digits == 17 ? Value::of(number) : Value::of_text(fmt::format("{:.{}g}", number, spec.digits));
}

/// `points` of the rows, evenly spaced from the first to the last; all rows if there are no more, or for 0.
std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& rows, std::size_t points) {
  if (points == 0 || rows.size() <= points) return rows;
  std::vector<std::size_t> spaced;
  for (std::size_t i = 0; i < points; ++i) spaced.push_back(rows[i * (rows.size() - 1) / (points - 1)]);
  return spaced;
}

void add_curve(TextTable& table, const TableSpec& spec, const Words& values, const std::vector<double>& divisors,
               const std::string& path) {
  table.sources.push_back(path);
  const schema::FileReader file(path, schema::FileKind::run);
  const HistoryTable history(file, NotFinite::kept); // the curve of a run that diverged is drawn as far as it goes
  if (!history.not_finite().empty()) table.notes.push_back(history.not_finite() + "; such cells are empty");
  const auto stages = stages_of(history, scenario_facts(file));
  std::set<int> wanted;
  for (const int stage : spec.stages) wanted.insert(stage_by_number(stages, stage, path).number);
  std::vector<std::function<double(const HistoryRow&)>> sources;
  for (const ColumnSpec& column : spec.columns)
    sources.push_back(column.history.empty() ? nullptr : curve_column(history, column.history, spec.place));
  const auto& number = history["stage"];
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < history.rows(); ++row)
    if (wanted.empty() || wanted.contains(static_cast<int>(number[row]))) rows.push_back(row);
  for (const std::size_t row : evenly_spaced(rows, spec.points)) {
    std::size_t begin = 0;
    for (const StageRows& s : stages)
      if (s.number == number[row]) begin = s.first;
    std::vector<Value> cells;
    for (std::size_t c = 0; c < sources.size(); ++c)
      cells.push_back(sources[c] ? curve_cell(sources[c]({history, row, begin}) / divisors[c], spec, spec.columns[c])
                                 : Value::of_text(filled_at(spec.place, spec.columns[c].pattern, values)));
    table.rows.push_back(std::move(cells));
  }
}

void add_curves(TextTable& table, const Figure& figure, const TableSpec& spec, const ResultsFolder& results,
                const std::vector<Case>& cases, MetricFiles& files) {
  std::vector<std::string> drawn;
  for (const Case& row : cases)
    for (const std::string& name : spec.curves) {
      const RunTemplate& run = figure.run(name, spec.place);
      const std::string folder = folder_of(figure, run, row);
      if (!belongs_to(run, row) || std::find(drawn.begin(), drawn.end(), folder) != drawn.end()) continue;
      drawn.push_back(folder);
      Words values = row.values;
      values["run"] = {name, {}};
      add_curve(table, spec, values, divisors_of(figure, spec, results, row, files), results.of(folder) + "/run.h5");
    }
}

/// Adds all rows of the CSV file next to a metric's JSON.
void add_list(TextTable& table, const Figure& figure, const TableSpec& spec, const ResultsFolder& results,
              const Case& row) {
  const std::size_t slash = spec.list.find('/');
  const std::string folder = folder_of(figure, figure.run(spec.list.substr(0, slash), spec.place), row);
  const TextTable list = read_text_table(fmt::format("{}/{}.csv", results.of(folder), spec.list.substr(slash + 1)));
  table.sources.push_back(list.path);
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    std::vector<Value> cells;
    for (const ColumnSpec& column : spec.columns)
      cells.push_back(column.history.empty() ? Value::of_text(filled_at(spec.place, column.pattern, row.values))
                                             : list.rows[i][list.column(column.history, spec.place)]);
    table.rows.push_back(std::move(cells));
  }
}

void keep_rows(TextTable& table, const Figure& figure, const TableSpec& spec) {
  if (spec.keep.empty()) return;
  const std::vector<std::string> notes = notes_on_kept(figure, spec, table);
  table.notes.insert(table.notes.end(), notes.begin(), notes.end());
  std::vector<std::vector<Value>> kept;
  for (const std::size_t row : table.rows_of(spec.keep, spec.place)) kept.push_back(table.rows[row]);
  table.rows = std::move(kept);
}

/// Lists of cases that share a run are the same.
void drop_repeated_rows(TextTable& table) {
  std::vector<std::vector<Value>> rows;
  for (auto& row : table.rows)
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(std::move(row));
  table.rows = std::move(rows);
}

void add_row(TextTable& table, const Figure& figure, const TableSpec& spec, const ResultsFolder& results,
             const Case& row, MetricFiles& files) {
  std::vector<Value> cells;
  if (!spec.row.empty()) cells.push_back(Value::of_text(filled_at(spec.place, spec.row, row.values)));
  for (const ColumnSpec& column : spec.columns) {
    if (column.run.empty()) {
      cells.push_back(Value::of_text(filled_at(spec.place, column.pattern, row.values)));
      continue;
    }
    if (!belongs_to(figure.run(column.run, spec.place), row)) {
      cells.emplace_back();
      continue;
    }
    const std::string path = metric_path(figure, column, spec.place, results, row);
    Value value = value_of_key(files.at(path), column.key, path, spec.place);
    if (value.number && !column.format.empty())
      value = Value::of_text(filled_at(spec.place, fmt::format("{{value:{}}}", column.format), {{"value", value}}));
    cells.push_back(std::move(value));
  }
  table.rows.push_back(std::move(cells));
}

} // namespace

std::string ResultsFolder::of(const std::string& folder) const {
  if (!folder.starts_with("../")) return fmt::format("{}/{}", path, folder);
  return (std::filesystem::path(path).parent_path() / folder.substr(3)).string(); // the other mesh's, for any seed
}

std::string file_of(const RunInstance& run, const ResultsFolder& results, const std::string& packing) {
  if (!run.is_packing) return results.of(run.folder) + "/run.h5";
  if (!run.command.empty()) return results.of(run.folder) + "/packing.h5";
  if (run.size.empty()) return packing;
  return (std::filesystem::path(packing).parent_path() / fmt::format("mesh-{}.h5", run.size)).string();
}

std::vector<std::string> runs_of(const TableSpec& spec) {
  std::vector<std::string> names = spec.curves;
  if (const std::size_t slash = spec.list.find('/'); slash != std::string::npos)
    names.push_back(spec.list.substr(0, slash));
  for (const ColumnSpec& column : spec.columns)
    if (!column.run.empty()) names.push_back(column.run);
  return names;
}

std::string folder_beside(const Figure& figure, const ResultsFolder& results) {
  const BesideSpec& beside = figure.beside;
  const auto name_of = [](const std::filesystem::path& folder) { return (folder / "").parent_path().filename(); };
  if (beside.folder.empty() || name_of(beside.folder) == name_of(results.path)) return "";
  const auto& meshes = beside.meshes;
  if (!meshes.empty() && std::find(meshes.begin(), meshes.end(), results.mesh) == meshes.end()) return "";
  const std::string folder = fmt::format("{}/{}", beside.folder, figure.name);
  return std::filesystem::is_directory(folder) ? folder : "";
}

std::vector<Case> available_cases(const Figure& figure, const std::vector<std::string>& series,
                                  const std::vector<Filter>& where, const std::vector<std::string>& runs,
                                  const ResultsFolder& results, const Place& place) {
  auto cases = cases_of(figure, series, where, results.mesh, place);
  std::erase_if(cases, [&](const Case& row) {
    return std::any_of(runs.begin(), runs.end(), [&](const std::string& name) {
      const std::string folder = folder_of(figure, figure.run(name, place), row);
      return folder.starts_with("../") && !std::filesystem::exists(results.of(folder) + "/run.h5");
    });
  });
  return cases;
}

TextTable make_table(const Figure& figure, const TableSpec& spec, const ResultsFolder& results) {
  TextTable table;
  table.path = spec.name;
  table.notes = notes_on_cases(figure, spec);
  if (!spec.row.empty()) table.add_column("name");
  for (const ColumnSpec& column : spec.columns) table.add_column(column.title);
  const auto cases = available_cases(figure, spec.series, spec.where, runs_of(spec), results, spec.place);
  MetricFiles files;
  if (!spec.curves.empty()) add_curves(table, figure, spec, results, cases, files);
  for (const Case& row : cases)
    if (!spec.list.empty())
      add_list(table, figure, spec, results, row);
    else if (spec.curves.empty())
      add_row(table, figure, spec, results, row, files);
  if (spec.distinct) drop_repeated_rows(table);
  keep_rows(table, figure, spec);
  const auto metrics = files.paths();
  table.sources.insert(table.sources.end(), metrics.begin(), metrics.end());
  return table;
}

std::string curve_help() {
  std::string text;
  for (const CurveColumn& column : curve_columns()) text += fmt::format("  {:<26} {}\n", column.name, column.meaning);
  return text;
}

namespace {

/// Mean and deviation of one row over several tables, column by column.
class RowMoments {
public:
  void add(const std::vector<double>& values) {
    mean_.resize(values.size());
    squares_.resize(values.size());
    ++count_;
    for (std::size_t c = 0; c < values.size(); ++c) { // Welford's method: no difference of large sums
      const double change = values[c] - mean_[c];
      mean_[c] += change / static_cast<double>(count_);
      squares_[c] += change * (values[c] - mean_[c]);
    }
  }
  std::size_t count() const { return count_; }
  /// Empty cells where there are too few rows.
  std::array<Value, 2> mean_and_deviation(std::size_t column) const {
    const auto cell = [](double value) { return Value::of_text(fmt::format("{:.10g}", value)); };
    return {count_ > 0 ? cell(mean_[column]) : Value{},
            count_ > 1 ? cell(std::sqrt(squares_[column] / static_cast<double>(count_ - 1))) : Value{}};
  }

private:
  std::size_t count_ = 0;
  std::vector<double> mean_, squares_;
};

/// The columns of mean and deviation of "TITLE [UNIT]".
void add_spread_columns(TextTable& result, const std::string& name, const std::string& title) {
  const std::size_t bracket = title.find(" [");
  result.add_column(title);
  result.add_column(name + "_deviation" + (bracket == std::string::npos ? "" : title.substr(bracket)));
}

/// The numbers of a row in these columns; empty if one of them is missing.
std::optional<std::vector<double>> numbers_of(const std::vector<Value>& row, const std::vector<std::size_t>& columns) {
  std::vector<double> numbers;
  for (const std::size_t column : columns) {
    if (!row[column].number) return {};
    numbers.push_back(*row[column].number);
  }
  return numbers;
}

/// The cells of a row by which it is found in the tables of other packings, separated by line ends.
std::string same_row(const TableSpec& spec, const TextTable& table, const std::vector<Value>& row) {
  std::string cells;
  for (const std::string& name : columns_of_same_row(spec)) cells += row[table.column(name)].text + '\n';
  return cells;
}

/// The text under "name" in a table of spreads: the row's own, otherwise the cells by which it is found.
std::string name_of_same_row(const TextTable& table, const std::vector<Value>& row, std::string cells) {
  if (table.has("name")) return row[table.column("name")].text;
  cells.pop_back();
  std::replace(cells.begin(), cells.end(), '\n', ' ');
  return cells;
}

} // namespace

std::vector<std::string> columns_of_same_row(const TableSpec& spec) {
  std::vector<std::string> names;
  if (!spec.row.empty()) names.emplace_back("name");
  for (const ColumnSpec& column : spec.columns)
    if ((column.run.empty() && column.history.empty()) || column.name == "name") names.push_back(column.name);
  return names;
}

void refuse_same_rows(const TableSpec& spec, const std::string& name) {
  spec.place.fail(fmt::format("spread: found two rows '{}', allowed: rows that differ in 'row', in a column 'name' or "
                              "in a value of the case",
                              one_line(name)));
}

TextTable spread_of(const TableSpec& spec, const std::vector<std::string>& files) {
  TextTable result;
  result.path = spec.name;
  result.add_column("name");
  result.add_column("packings");
  std::vector<std::pair<std::string, std::string>> rows; // of the first table: name, and cells by which it is found
  std::map<std::string, RowMoments> moments;
  for (const std::string& path : files) {
    const TextTable table = read_text_table(path);
    const bool own = path == files.front();
    std::vector<std::size_t> columns;
    for (const std::string& name : spec.spread) {
      columns.push_back(table.column(name));
      if (own) add_spread_columns(result, name, table.titles[columns.back()]);
    }
    for (const auto& row : table.rows) {
      const std::string cells = same_row(spec, table, row);
      const auto [known, added] = moments.try_emplace(cells);
      if (own && !added) refuse_same_rows(spec, name_of_same_row(table, row, cells));
      if (own) rows.emplace_back(name_of_same_row(table, row, cells), cells);
      if (const auto numbers = numbers_of(row, columns)) known->second.add(*numbers);
    }
  }
  for (const auto& [name, cells] : rows) {
    const RowMoments& m = moments[cells];
    std::vector<Value> row = {{name, {}}, Value::of(static_cast<double>(m.count()))};
    for (std::size_t c = 0; c < spec.spread.size(); ++c)
      for (Value& cell : m.mean_and_deviation(c)) row.push_back(std::move(cell));
    result.rows.push_back(std::move(row));
  }
  return result;
}

} // namespace mpfem
