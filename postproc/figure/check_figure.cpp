#include "postproc/figure/check_figure.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/nearest_word.hpp"
#include "postproc/figure/figure_table.hpp"
#include "postproc/figure/verdict.hpp"
#include "postproc/fits/fit.hpp"

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
  const std::vector<std::string> names = figure.table(table, place).column_names();
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

void check_filters(const Figure& figure, const std::string& table, const std::vector<Filter>& filters,
                   const Place& place) {
  for (const Filter& filter : filters) check_column(figure, table, filter.name, place);
}

/// Refuses names of series that no case has.
void check_series(const Figure& figure, const std::vector<std::string>& names, const Place& place) {
  std::vector<std::string> known;
  for (const CaseBlock& block : figure.cases) known.push_back(block.series);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      place.fail(fmt::format("series: there are no [[cases]] of the series '{}'{}", name, suggestion(name, known)));
}

/// The names of the values that a block's cases have.
std::set<std::string> value_names(const Figure& figure, const CaseBlock& block) {
  std::set<std::string> names = {"series", "MESH"};
  for (const auto& [name, value] : figure.defaults) names.insert(name);
  for (const auto& [name, list] : block.values) names.insert(name);
  for (const auto& [name, of_text] : figure.follows)
    for (const auto& [text, words] : of_text)
      for (const auto& [key, value] : words) names.insert(key);
  return names;
}

/// Refuses what would show no row: a name or a value of `only` that the block does not have.
void check_only(const Figure& figure, const CaseBlock& block) {
  const std::set<std::string> names = value_names(figure, block);
  for (const Filter& filter : block.only) {
    if (!names.contains(filter.name))
      block.place.fail(fmt::format("only: these cases have no value '{}'{}", filter.name,
                                   suggestion(filter.name, {names.begin(), names.end()})));
    const auto list = std::find_if(block.values.begin(), block.values.end(),
                                   [&](const auto& entry) { return entry.first == filter.name; });
    if (list == block.values.end()) continue;
    const auto is_pattern = [](const Value& value) { return value.text.find('{') != std::string::npos; };
    if (std::ranges::any_of(list->second, is_pattern)) continue;
    std::vector<std::string> texts;
    for (const Value& value : list->second) texts.push_back(value.text);
    for (const Value& value : filter.equal)
      if (std::find(list->second.begin(), list->second.end(), value) == list->second.end())
        block.place.fail(
            fmt::format("only: found {} = {}, allowed: {}", filter.name, value.text, fmt::join(texts, ", ")));
  }
}

/// The names of the values that follow from that called `name`, directly or through others.
std::set<std::string> following(const Figure& figure, const std::string& name) {
  std::set<std::string> found;
  std::vector<std::string> open = {name};
  while (!open.empty()) {
    const auto of_text = figure.follows.find(open.back());
    open.pop_back();
    if (of_text == figure.follows.end()) continue;
    for (const auto& [text, words] : of_text->second)
      for (const auto& [key, value] : words)
        if (found.insert(key).second) open.push_back(key);
  }
  return found;
}

void check_cases(const Figure& figure) {
  for (const CaseBlock& block : figure.cases) check_only(figure, block);
  for (const auto& [name, of_text] : figure.follows)
    if (following(figure, name).contains(name))
      figure.follows_place.fail(fmt::format(
          "found values that follow from '{0}', and from which '{0}' follows, allowed: only one way", name));
}

void check_runs(const Figure& figure) {
  for (const RunTemplate& run : figure.runs) {
    check_beginning(figure, run);
    check_series(figure, run.series, run.place);
    if (!run.packing.empty() && !figure.run(run.packing, run.place).is_packing)
      run.place.fail(fmt::format("packing: '{}' is a run, allowed: one of [[packings]]", run.packing));
  }
}

/// Refuses numbers of stages that the scenario of one of a table's curves does not have.
void check_stages(const Figure& figure, const TableSpec& table) {
  for (const std::string& curve : table.curves) {
    const RunTemplate& run = figure.run(curve, table.place);
    if (table.stages.empty()) return;
    const int stages = static_cast<int>(stage_names(run.programme).size());
    for (const int stage : table.stages)
      if (stage >= stages || stage < -stages)
        table.place.fail(
            fmt::format("stage: found {}, but {} has stages 0 … {}, allowed: one of them, or from the end, "
                        "-1 … -{}",
                        stage, run.programme, stages - 1, stages));
  }
}

/// The spread over packings is that of rows which are found in the tables of all of them.
void check_rows_of_spread(const Figure& figure, const TableSpec& table) {
  if (table.spread.empty()) return;
  for (const std::string& column : table.spread) check_column(figure, table.name, column, table.place);
  if (!table.curves.empty())
    table.place.fail("spread: found with 'curves', allowed: a table with a row for each case, or a list");
  if (columns_of_same_row(table).empty())
    table.place.fail("spread: found rows that have no name, allowed: a table with 'row', a column 'name' or a value of "
                     "the case");
}

void check_tables(const Figure& figure) {
  for (const TableSpec& table : figure.tables) {
    check_columns_once(table);
    check_series(figure, table.series, table.place);
    for (const ColumnSpec& column : table.columns) {
      if (!column.run.empty()) figure.run(column.run, table.place);
      if (!column.format.empty())
        filled_at(table.place, fmt::format("{{value:{}}}", column.format), {{"value", Value::of(1)}});
    }
    check_stages(figure, table);
    if (const std::size_t slash = table.list.find('/'); slash != std::string::npos)
      figure.run(table.list.substr(0, slash), table.place);
    else if (!table.list.empty())
      table.place.fail(fmt::format("list: found '{}', allowed: RUN/METRIC", table.list));
    check_filters(figure, table.name, table.keep, table.place);
    check_rows_of_spread(figure, table);
  }
}

/// Refuses coefficients that a model does not have, and a model that lacks one.
void check_model(const SeriesSpec& series) {
  const std::vector<std::string> needed = coefficients_of(series.fit_model);
  std::vector<std::string> given;
  for (const auto& [name, value] : series.model) given.push_back(name);
  const auto fault = [&](const std::string& what, const std::string& name) {
    series.place.fail(
        fmt::format("model '{}': {} '{}', allowed: {}", series.fit_model, what, name, fmt::join(needed, ", ")));
  };
  for (const std::string& name : given)
    if (std::find(needed.begin(), needed.end(), name) == needed.end()) fault("found the coefficient", name);
  for (const std::string& name : needed)
    if (std::find(given.begin(), given.end(), name) == given.end()) fault("found no coefficient", name);
}

/// Refuses names in a caption that no case has.
void check_caption(const Figure& figure, const CommandSpec& command) {
  Words words;
  for (const CaseBlock& block : figure.cases)
    if (command.series.empty() || std::ranges::find(command.series, block.series) != command.series.end())
      for (const std::string& name : value_names(figure, block)) words[name] = Value::of(1);
  if (!figure.cases.empty()) filled_at(command.place_of_caption, command.caption, words);
}

void check_command(const Figure& figure, const CommandSpec& command) {
  if (!command.run.empty()) figure.run(command.run, command.place);
  check_series(figure, command.series, command.place);
  check_caption(figure, command);
}

/// Mean and deviation over packings are drawn of columns that the table's `spread` names.
void check_spread(const Figure& figure, const SeriesSpec& series) {
  const std::vector<std::string>& columns = figure.table(series.table, series.place).spread;
  for (const std::string& column : {series.x, series.y})
    if (series.spread && std::find(columns.begin(), columns.end(), column) == columns.end())
      series.place.fail(
          fmt::format("spread: found true, but 'spread' of the table '{}' has no column '{}', allowed: x and "
                      "y of the series in it",
                      series.table, column));
}

void check_plots(const Figure& figure) {
  for (const PlotSpec& plot : figure.plots) {
    for (const SeriesSpec& series : plot.series) {
      if (!series.fit.empty()) figure.fit(series.fit, series.place);
      if (!series.fit_model.empty()) check_model(series);
      if (series.table.empty()) continue;
      for (const std::string& column : {series.x, series.y, series.error, series.group, series.colour_by})
        check_column(figure, series.table, column, series.place);
      check_filters(figure, series.table, series.where, series.place);
      check_spread(figure, series);
    }
    if (plot.inset && !plot.series.empty())
      check_filters(figure, plot.series.front().table, plot.inset->where, plot.place);
  }
}

/// A quantity's coefficient is one of its fit's model, or follows from them.
void check_coefficient(const Figure& figure, const QuantitySpec& q) {
  const std::string& model = figure.fit(q.fit, q.place).model;
  if (q.coefficient.empty()) return;
  std::vector<std::string> names = coefficients_of(model);
  const std::vector<std::string> derived = derived_of(model);
  names.insert(names.end(), derived.begin(), derived.end());
  if (std::find(names.begin(), names.end(), q.coefficient) != names.end()) return;
  q.place.fail(fmt::format("quantity '{}': the model '{}' has no coefficient '{}', allowed: {}", q.name, model,
                           q.coefficient, fmt::join(names, ", ")));
}

/// The quantities and conditions of one statement.
class StatementCheck {
public:
  explicit StatementCheck(const Figure& figure) : figure_(figure) {}

  void operator()(const StatementSpec& statement) {
    known_.clear();
    for (const QuantitySpec& q : statement.quantities) {
      check_quantity(q);
      known_.push_back(q);
    }
    for (const auto* conditions : {&statement.require, &statement.judged_if})
      for (const ConditionSpec& condition : *conditions) check_condition(condition);
    check_texts(statement);
  }

private:
  /// One of the quantities so far.
  const QuantitySpec& quantity(const std::string& name, const Place& place) const {
    std::vector<std::string> names;
    for (const QuantitySpec& q : known_) {
      if (q.name == name) return q;
      names.push_back(q.name);
    }
    place.fail(fmt::format("there is no quantity '{}' here or above{}", name, suggestion(name, names)));
  }

  void check_quantity(const QuantitySpec& q) const {
    for (const std::string& other : {q.of, q.divided_by, q.minus})
      if (!other.empty()) quantity(other, q.place);
    if (!q.fit.empty()) check_coefficient(figure_, q);
    if (q.table.empty()) return;
    for (const std::string& column : {q.column, q.over, q.by}) check_column(figure_, q.table, column, q.place);
    check_filters(figure_, q.table, q.where, q.place);
    check_filters(figure_, q.table, q.relative_to, q.place);
    check_item(q);
  }

  /// The text of a list's items names columns. A file may have more of them than it declares.
  void check_item(const QuantitySpec& q) const {
    const TableSpec& table = figure_.table(q.table, q.place);
    if (q.take != "list" || !table.file.empty()) return;
    Words words = {{"value", Value::of(1)}, {"name", {"name", {}}}};
    for (const ColumnSpec& column : table.columns) words[column.name] = Value::of(1);
    filled_at(q.place, q.item, words);
  }

  void check_condition(const ConditionSpec& c) const {
    for (const ConditionSpec& one : c.either) check_condition(one);
    for (const Operand& operand : c.operands)
      if (!operand.number) quantity(operand.name, c.place);
    if (c.quantity.empty()) return;
    const QuantitySpec& q = quantity(c.quantity, c.place);
    if (c.predicate.starts_with("interval") && q.coefficient.empty())
      c.place.fail(fmt::format("'{}' is not a coefficient of a fit, so it has no interval", q.name));
    if (c.predicate != "rises" && c.predicate != "falls") return;
    if (q.table.empty())
      c.place.fail(fmt::format("'{}' is not a column of a table, and {} needs one", q.name, c.predicate));
    for (const std::string& column : {c.along, c.each}) check_column(figure_, q.table, column, c.place);
  }

  const Figure& figure_;
  std::vector<QuantitySpec> known_; ///< of the statement, up to the one that is checked
};

} // namespace

void check_names(const Figure& figure) {
  check_once(figure.runs, "run");
  check_once(figure.tables, "table");
  check_once(figure.fits, "fit");
  check_once(figure.plots, "plot");
  check_cases(figure);
  check_runs(figure);
  check_tables(figure);
  for (const FitSpec& fit : figure.fits) {
    for (const std::string& column : {fit.x, fit.y, fit.z}) check_column(figure, fit.table, column, fit.place);
    check_filters(figure, fit.table, fit.where, fit.place);
  }
  check_plots(figure);
  for (const PictureSpec& picture : figure.pictures) check_command(figure, picture);
  for (const ScriptSpec& script : figure.scripts) check_command(figure, script);
  StatementCheck check_statement(figure);
  for (const StatementSpec& statement : figure.statements) check_statement(statement);
}

} // namespace mpfem
