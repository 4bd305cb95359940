#include "postproc/figure/filter_notes.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "postproc/figure/run_graph.hpp"

namespace mpfem {

namespace {

/// Filters of one table, and who has them.
struct FilterUse {
  std::string what, key; ///< "plot 'p', series of …"; "where"
  const std::vector<Filter>& filters;
  const Place& place;
};

bool contains(const std::vector<Value>& values, const Value& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// The texts of different values, at most twenty of them.
std::string listed(const std::vector<Value>& values) {
  constexpr std::size_t most = 20;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(values.size(), most); ++i) texts.push_back(values[i].text);
  return fmt::format("{}{}", fmt::join(texts, ", "), values.size() > most ? ", …" : "");
}

/// The cases of these series (empty: of all) with any mesh.
std::vector<Case> cases_of_all_meshes(const Figure& figure, const std::vector<std::string>& series,
                                      const std::vector<Filter>& where, const Place& place) {
  std::set<std::string> meshes = {""};
  for (const CaseBlock& block : figure.cases) meshes.insert(block.meshes.begin(), block.meshes.end());
  std::vector<Case> all;
  for (const std::string& mesh : meshes) {
    const std::vector<Case> cases = cases_of(figure, series, where, mesh, place);
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

/// What a column shows of the cases' values, as "{density:.2f}"; empty for other columns.
std::string pattern_of(const TableSpec& table, const std::string& column) {
  if (!table.file.empty()) return "";
  for (const ColumnSpec& c : table.columns)
    if (c.name == column) return c.pattern;
  return column == "name" ? table.row : "";
}

/// The texts that a pattern becomes with any mesh.
std::vector<Value> values_of_pattern(const Figure& figure, const TableSpec& table, const std::string& pattern) {
  const std::vector<std::string> runs = table.curves.empty() ? std::vector<std::string>{""} : table.curves;
  std::vector<Value> values;
  for (const Case& row : cases_of_all_meshes(figure, table.series, table.where, table.place))
    for (const std::string& run : runs) {
      Words words = row.values;
      words["run"] = {run, {}};
      values.push_back(Value::of_text(filled_at(table.place, pattern, words)));
    }
  return values;
}

/// Whether a column may have the value with some mesh, as far as the cases tell: one that a script or a metric's list
/// fills, if any case has the value, whatever it is called there.
bool is_of_some_case(const Figure& figure, const TableSpec& table, const std::string& column, const Value& value) {
  if (const std::string pattern = pattern_of(table, column); !pattern.empty()) {
    try {
      return contains(values_of_pattern(figure, table, pattern), value);
    } catch (const InputError&) {
      return true; // cases of other meshes lack what this table selects or shows: nobody can tell
    }
  }
  const std::vector<Case> cases = cases_of_all_meshes(figure, {}, {}, table.place);
  return std::any_of(cases.begin(), cases.end(), [&](const Case& row) {
    return std::any_of(row.values.begin(), row.values.end(), [&](const auto& word) { return word.second == value; });
  });
}

bool is_of_metric(const TableSpec& table, const std::string& column) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [&](const ColumnSpec& c) { return c.name == column && !c.run.empty() && c.history.empty(); });
}

/// The different values in a column; none if a cell is empty.
std::vector<Value> values_in(const TextTable& rows, std::size_t column) {
  std::vector<Value> values;
  for (const auto& row : rows.rows) {
    if (row[column].text.empty()) return {};
    if (!contains(values, row[column])) values.push_back(row[column]);
  }
  return values;
}

std::vector<std::string> notes_on(const FilterUse& use, const Figure& figure, const TableSpec& table,
                                  const TextTable& rows) {
  std::vector<std::string> notes;
  for (const Filter& filter : use.filters) {
    if (is_of_metric(table, filter.name)) continue;
    const std::vector<Value> found = values_in(rows, rows.column(filter.name, use.place));
    for (const Value& value : filter.equal)
      if (!found.empty() && !contains(found, value) && !is_of_some_case(figure, table, filter.name, value))
        notes.push_back(use.place.note(fmt::format("{}: {}: no row of the table '{}' has {} = {}, found: {}", use.what,
                                                   use.key, table.name, filter.name, value.text, listed(found))));
  }
  return notes;
}

/// Adds the notes on filters of a table that has been made, without those that are there.
void add_notes(std::vector<std::string>& notes, const FilterUse& use, const std::string& table, FigureData& data) {
  if (use.filters.empty() || !data.has_table(table)) return;
  const Figure& figure = data.figure();
  for (const std::string& note : notes_on(use, figure, figure.table(table, use.place), data.table(table)))
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

} // namespace

std::vector<std::string> notes_on_plot(const PlotSpec& plot, FigureData& data) {
  std::vector<std::string> notes;
  for (const SeriesSpec& s : plot.series)
    if (!s.table.empty())
      add_notes(notes, {fmt::format("plot '{}', {} over {}", plot.name, s.y, s.x), "where", s.where, s.place}, s.table,
                data);
  if (plot.inset && !plot.series.empty() && !plot.series.front().table.empty())
    add_notes(notes, {fmt::format("inset of plot '{}'", plot.name), "where", plot.inset->where, plot.place},
              plot.series.front().table, data);
  return notes;
}

std::vector<std::string> notes_on_fits(FigureData& data) {
  std::vector<std::string> notes;
  for (const FitSpec& fit : data.figure().fits)
    add_notes(notes, {fmt::format("fit '{}'", fit.name), "where", fit.where, fit.place}, fit.table, data);
  return notes;
}

std::vector<std::string> notes_on_statements(FigureData& data, const std::string& mesh) {
  std::vector<std::string> notes;
  for (const StatementSpec& statement : data.figure().statements) {
    const auto& meshes = statement.meshes;
    if (!meshes.empty() && std::find(meshes.begin(), meshes.end(), mesh) == meshes.end()) continue;
    for (const QuantitySpec& q : statement.quantities) {
      if (q.table.empty() || q.take == "count" || q.otherwise) continue;
      const std::string what = fmt::format("quantity '{}'", q.name);
      add_notes(notes, {what, "where", q.where, q.place}, q.table, data);
      add_notes(notes, {what, "relative_to", q.relative_to, q.place}, q.table, data);
    }
  }
  return notes;
}

std::vector<std::string> notes_on_cases(const Figure& figure, const TableSpec& table) {
  std::vector<std::string> notes;
  const std::vector<Case> cases = cases_of_all_meshes(figure, table.series, {}, table.place);
  for (const Filter& filter : table.where) {
    std::vector<Value> found;
    for (const Case& row : cases)
      if (const auto value = row.values.find(filter.name); value != row.values.end() && !contains(found, value->second))
        found.push_back(value->second);
    for (const Value& value : filter.equal)
      if (!found.empty() && !contains(found, value))
        notes.push_back(table.place.note(fmt::format("table '{}': where: no case has {} = {}, found: {}", table.name,
                                                     filter.name, value.text, listed(found))));
  }
  return notes;
}

std::vector<std::string> notes_on_kept(const Figure& figure, const TableSpec& table, const TextTable& rows) {
  return notes_on({fmt::format("table '{}'", table.name), "keep", table.keep, table.place}, figure, table, rows);
}

} // namespace mpfem
