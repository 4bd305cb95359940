#include "postproc/figure/check_figure.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/nearest_word.hpp"

namespace mpfem {

namespace {

template <class Item>
void check_once(const std::vector<Item>& items, const char* kind) {
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (items[i].name == items[k].name)
        items[i].place.fail(fmt::format("a {} '{}' is declared twice", kind, items[i].name));
}

void check_column(const Figure& figure, const std::string& table, const std::string& column, const Place& place) {
  if (column.empty()) return;
  const TableSpec& spec = figure.table(table, place);
  std::vector<std::string> names;
  if (!spec.row.empty()) names.emplace_back("name");
  for (const ColumnSpec& c : spec.columns) names.push_back(c.name);
  if (std::find(names.begin(), names.end(), column) != names.end()) return;
  place.fail(fmt::format("table '{}' has no column '{}'{}", table, column, suggestion(column, names)));
}

/// The run at which a run begins; none if it begins with a packing.
const RunTemplate* parent_of(const Figure& figure, const RunTemplate& run) {
  if (run.from.empty()) return nullptr;
  return &figure.run(run.from.substr(0, run.from.find_first_of("@:")), run.place);
}

/// Refuses runs that begin at each other. A run of a chain may name itself.
void check_beginning(const Figure& figure, const RunTemplate& run) {
  std::size_t steps = 0;
  for (const RunTemplate* at = &run; at != nullptr; ++steps) {
    const RunTemplate* parent = parent_of(figure, *at);
    if (parent == at) return;
    if (steps > figure.runs.size())
      run.place.fail(fmt::format("from: found '{}', but that run begins in turn at '{}', allowed: runs of which the "
                                 "first begins with a packing",
                                 run.from, run.name));
    at = parent;
  }
}

void check_columns_once(const TableSpec& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (table.columns[i].name == table.columns[k].name)
        table.place.fail(fmt::format("table '{}' has the column '{}' twice", table.name, table.columns[i].name));
}

} // namespace

void check_names(const Figure& figure) {
  check_once(figure.runs, "run");
  check_once(figure.tables, "table");
  check_once(figure.fits, "fit");
  check_once(figure.plots, "plot");
  for (const RunTemplate& run : figure.runs) {
    check_beginning(figure, run);
    if (!run.packing.empty() && !figure.run(run.packing, run.place).is_packing)
      run.place.fail(fmt::format("packing: '{}' is a run, allowed: one of [[packings]]", run.packing));
  }
  for (const TableSpec& table : figure.tables) {
    check_columns_once(table);
    for (const ColumnSpec& column : table.columns)
      if (!column.run.empty()) figure.run(column.run, table.place);
    for (const std::string& curve : table.curves) figure.run(curve, table.place);
    if (!table.list.empty()) figure.run(table.list.substr(0, table.list.find('/')), table.place);
    for (const Filter& filter : table.keep) check_column(figure, table.name, filter.name, table.place);
    for (const std::string& column : table.spread) check_column(figure, table.name, column, table.place);
  }
  for (const FitSpec& fit : figure.fits)
    for (const std::string& column : {fit.x, fit.y, fit.z}) check_column(figure, fit.table, column, fit.place);
  for (const PlotSpec& plot : figure.plots)
    for (const SeriesSpec& series : plot.series) {
      if (!series.fit.empty()) figure.fit(series.fit, series.place);
      if (series.table.empty()) continue;
      for (const std::string& column : {series.x, series.y, series.error, series.group, series.colour_by})
        check_column(figure, series.table, column, series.place);
      for (const Filter& filter : series.where) check_column(figure, series.table, filter.name, series.place);
    }
  for (const PictureSpec& picture : figure.pictures) figure.run(picture.run, picture.place);
  for (const ScriptSpec& script : figure.scripts)
    if (!script.run.empty()) figure.run(script.run, script.place);
  for (const StatementSpec& statement : figure.statements)
    for (const QuantitySpec& q : statement.quantities) {
      if (!q.fit.empty()) figure.fit(q.fit, q.place);
      if (q.table.empty()) continue;
      for (const std::string& column : {q.column, q.over, q.by}) check_column(figure, q.table, column, q.place);
      for (const Filter& filter : q.where) check_column(figure, q.table, filter.name, q.place);
    }
}

} // namespace mpfem
