#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "postproc/figure/figure.hpp"
#include "postproc/figure/figure_texts.hpp"
#include "postproc/fits/fit.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

/// A value in the syntax of `mpfem run --set`: numbers and words as they are, lists in brackets.
std::string setting_text(const toml::node& node, const Place& place) {
  if (const toml::array* list = node.as_array()) {
    std::vector<std::string> parts;
    for (const toml::node& element : *list) parts.push_back(setting_text(element, place));
    return fmt::format("[{}]", fmt::join(parts, ","));
  }
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return value_of(node, place).text;
}

Settings read_settings(TableReader reader) {
  Settings settings;
  for (const std::string& key : reader.keys())
    settings.emplace_back(key, setting_text(*reader.value(key), Place(reader, key)));
  return settings;
}

struct Heading {
  std::string name, unit;
};

Heading heading_of(const std::string& title) {
  const std::size_t bracket = title.find(" [");
  if (bracket == std::string::npos) return {title, "1"};
  return {title.substr(0, bracket), title.substr(bracket + 2, title.find(']') - bracket - 2)};
}

/// Place of the first such character outside of braces.
std::size_t find_outside_braces(const std::string& text, char wanted, std::size_t from) {
  bool inside = false;
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == wanted && !inside) return i;
    if (text[i] == '{' || text[i] == '}') inside = text[i] == '{';
  }
  return std::string::npos;
}

/// Reads "RUN/METRIC.KEY" or "RUN/METRIC.KEY:FORMAT"; a metric's name may hold values in braces, a key may hold dots
/// (at_0.80). False for other texts.
bool read_metric_key(const std::string& source, ColumnSpec& column) {
  const std::size_t slash = source.find('/');
  if (slash == std::string::npos || slash == 0) return false;
  const std::size_t dot = find_outside_braces(source, '.', slash);
  if (dot == std::string::npos) return false;
  const std::size_t colon = source.find(':', dot);
  column.run = source.substr(0, slash);
  column.metric = source.substr(slash + 1, dot - slash - 1);
  column.key = source.substr(dot + 1, colon == std::string::npos ? colon : colon - dot - 1);
  if (colon != std::string::npos) column.format = source.substr(colon + 1);
  return true;
}

ColumnSpec read_column(const std::string& text, bool curves, const Place& place) {
  const std::size_t equals = text.find(" = ");
  if (equals == std::string::npos)
    place.fail(fmt::format("found '{}', allowed: 'NAME [UNIT] = SOURCE' or the name of a list in [columns]", text));
  ColumnSpec column;
  column.title = text.substr(0, equals);
  const Heading heading = heading_of(column.title);
  column.name = heading.name;
  column.unit = heading.unit;
  std::string source = text.substr(equals + 3);
  if (const std::size_t over = source.find(" over "); curves && over != std::string::npos) {
    if (!read_metric_key(source.substr(over + 6), column))
      place.fail(fmt::format("found '{}', allowed: 'COLUMN over RUN/METRIC.KEY'", source));
    source.resize(over);
  }
  if (source.starts_with('\'')) {
    column.pattern = source.substr(1, source.find_last_of('\'') - 1);
  } else if (!curves && read_metric_key(source, column)) {
    return column;
  } else if (source.find('{') != std::string::npos) {
    column.pattern = source;
  } else if (curves && (source.find('/') == std::string::npos || source.starts_with("tools/"))) {
    const std::size_t colon = source.find(':');
    column.history = source.substr(0, colon);
    if (colon != std::string::npos) column.format = source.substr(colon + 1);
  } else {
    place.fail(fmt::format("found '{}', allowed: {}", source,
                           curves ? "a column of the history, or a value in braces"
                                  : "'RUN/METRIC.KEY' or a value in braces"));
  }
  return column;
}

AxisSpec read_axis(TableReader reader, const Words& words) {
  Texts t(reader, words);
  AxisSpec axis;
  axis.label = t.optional("label");
  axis.format = t.optional("format");
  axis.ticks = t.optional("ticks");
  axis.low = t.number("low");
  axis.high = t.number("high");
  axis.logarithmic = reader.boolean_or("logarithmic", false);
  reader.finish();
  return axis;
}

SeriesSpec read_series(Texts& t) {
  TableReader& r = t.reader();
  SeriesSpec s;
  s.place = Place(r, "");
  s.fit = t.optional("fit");
  if (auto model = r.optional_table("model")) {
    s.fit_model = model->choice("name", fit_models());
    for (const std::string& key : model->keys())
      if (key != "name") s.model.emplace_back(key, model->number(key));
  }
  if (s.fit.empty() && s.fit_model.empty()) {
    s.table = t.required("table");
    s.x = t.required("x");
    s.y = t.required("y");
    s.error = t.optional("error");
    s.group = t.optional("group");
    s.colour_by = t.optional("colour_by");
    s.where = t.filters("where");
    s.spread = r.boolean_or("spread", false);
    s.fixed_x = t.number("fixed_x");
    s.fixed_group = t.number("fixed_group");
  } else {
    s.from = t.number("from");
    s.to = t.number("to");
    s.at = t.number("at");
    s.x = t.optional("along", "x");
  }
  s.x_scale = r.number_or("x_scale", 1);
  s.y_scale = r.number_or("y_scale", 1);
  const bool of_fit = s.table.empty();
  s.style = r.choice_or("style", of_fit ? "lines" : "points", {"points", "lines", "linespoints"});
  s.colour = t.integer("colour", 1, Range::between(1, 8));
  s.point = t.integer("point", 0, Range::between(0, 15));
  s.width = r.number_or("width", 0, Range::non_negative());
  s.size = r.number_or("size", 1.5, Range::positive());
  s.dash = t.optional("dash", "solid");
  if (s.dash != "solid" && s.dash != "dashed" && s.dash != "dotted" && s.dash != "long")
    r.fail("dash", fmt::format("found '{}', allowed: 'solid', 'dashed', 'dotted', 'long'", s.dash));
  s.title = t.optional("title");
  return s;
}

QuantitySpec read_quantity(TableReader reader, const std::string& name, const Words& words) {
  Texts t(reader, words);
  QuantitySpec q;
  q.name = name;
  q.place = Place(reader, "");
  if (reader.has("fit")) {
    q.fit = t.required("fit");
    if (reader.has("coefficient")) {
      q.coefficient = t.required("coefficient");
    } else {
      q.measure = reader.choice("measure", {"r_squared", "r_squared_of_y", "scatter", "points"});
    }
  } else if (reader.has("of")) {
    q.of = t.required("of");
    q.divided_by = t.optional("over");
    q.minus = t.optional("minus");
  } else {
    q.table = t.required("table");
    q.column = t.required("column");
    q.over = t.optional("over");
    q.take = reader.choice_or(
        "take", "only",
        {"only", "first", "last", "smallest", "largest", "mean", "sum", "count", "spread", "list", "before_last"});
    q.otherwise = reader.optional_number("otherwise");
    q.item = t.optional("item", "{value:.3g}");
    q.where = t.filters("where");
    q.relative_to = t.filters("relative_to");
    if (!q.relative_to.empty()) q.by = t.required("by");
  }
  reader.finish();
  return q;
}

std::vector<Operand> operands_of(TableReader& reader, const std::string& key, const Words& words) {
  std::vector<Operand> operands;
  for (const Value& value : values_of(reader, key))
    operands.push_back({value.number, value.number ? "" : filled(value.text, words, Unknown::kept)});
  return operands;
}

const std::vector<std::string>& predicates() {
  static const std::vector<std::string> list = {"near",
                                                "at_least",
                                                "at_most",
                                                "above",
                                                "below",
                                                "between",
                                                "rises",
                                                "falls",
                                                "ordered",
                                                "interval_includes",
                                                "interval_excludes",
                                                "interval_width_at_most",
                                                "either"};
  return list;
}

ConditionSpec read_condition(TableReader reader, const Words& words) {
  Texts t(reader, words);
  ConditionSpec c;
  c.place = Place(reader, "");
  for (const std::string& predicate : predicates()) {
    if (!reader.has(predicate)) continue;
    if (!c.predicate.empty())
      reader.fail(predicate, fmt::format("cannot be used with '{}', allowed: one predicate", c.predicate));
    c.predicate = predicate;
  }
  if (c.predicate.empty())
    reader.fail("quantity", fmt::format("no predicate, allowed: one of {}", fmt::join(predicates(), ", ")));
  if (c.predicate == "either") {
    for (TableReader& one : reader.tables("either")) c.either.push_back(read_condition(one, words));
    reader.finish();
    return c;
  }
  if (c.predicate != "ordered") c.quantity = t.required("quantity");
  if (c.predicate == "rises" || c.predicate == "falls") {
    if (!reader.boolean_or(c.predicate, true)) reader.fail(c.predicate, "found false, allowed: true");
    c.absolute = reader.has("tolerance_absolute");
    c.tolerance = c.absolute ? reader.number("tolerance_absolute", Range::positive())
                             : reader.number_or("tolerance", 0, Range::between(0, 1));
    c.along = t.optional("along");
    c.each = t.optional("each");
  } else {
    c.operands = operands_of(reader, c.predicate, words);
    const std::size_t least = c.predicate == "between" || c.predicate == "ordered" ? 2 : 1;
    if (c.operands.size() < least || (c.predicate != "ordered" && c.operands.size() > least))
      reader.fail(c.predicate, fmt::format("found {} values, allowed: {}", c.operands.size(), least));
  }
  if (c.predicate == "near") {
    c.absolute = reader.has("within_absolute");
    c.within =
        c.absolute ? reader.number("within_absolute", Range::positive()) : reader.number("within", Range::positive());
  }
  reader.finish();
  return c;
}

/// Lists of columns from [columns], by name.
using ColumnLists = std::map<std::string, std::vector<std::string>>;

/// Replaces names of lists by the lists' entries.
std::vector<std::string> with_lists(const std::vector<std::string>& columns, const ColumnLists& lists) {
  std::vector<std::string> texts;
  for (const std::string& text : columns)
    if (const auto list = lists.find(text); list != lists.end())
      texts.insert(texts.end(), list->second.begin(), list->second.end());
    else
      texts.push_back(text);
  return texts;
}

TableSpec read_table(Texts& t, const ColumnLists& lists) {
  TableSpec spec;
  spec.place = Place(t.reader(), "columns");
  spec.name = t.name("name");
  spec.row = t.optional("row");
  spec.series = t.list("series");
  spec.where = t.filters("where");
  spec.curves = t.list("curves");
  spec.list = t.optional("list");
  spec.keep = t.filters("keep");
  if (t.reader().has("stage")) spec.stage = static_cast<int>(t.reader().integer("stage"));
  spec.digits = static_cast<int>(t.reader().integer_or("digits", 6, Range::between(1, 17)));
  spec.distinct = t.reader().boolean_or("distinct", false);
  spec.spread = t.list("spread");
  const bool rows_of_files = !spec.curves.empty() || !spec.list.empty();
  for (const std::string& text : with_lists(t.list("columns"), lists))
    spec.columns.push_back(read_column(text, rows_of_files, spec.place));
  if (spec.columns.empty()) spec.place.fail("allowed: a column or more");
  return spec;
}

/// A table from a CSV file: next to the figure's file if it exists there, otherwise among the figure's results, where a
/// script makes it.
TableSpec read_table_of_file(Texts& t, const filesystem::path& folder) {
  TableSpec spec;
  spec.place = Place(t.reader(), "columns");
  spec.name = t.name("name");
  spec.file = t.required("file");
  spec.beside = filesystem::exists(folder / spec.file);
  if (spec.beside) spec.file = (folder / spec.file).lexically_normal().string();
  for (const std::string& text : t.list("columns")) {
    const Heading heading = heading_of(text);
    ColumnSpec column;
    column.title = text;
    column.name = heading.name;
    column.unit = heading.unit;
    spec.columns.push_back(column);
  }
  return spec;
}

FitSpec read_fit(Texts& t) {
  FitSpec spec;
  spec.place = Place(t.reader(), "name");
  spec.name = t.name("name");
  spec.table = t.required("table");
  spec.x = t.required("x");
  spec.y = t.required("y");
  spec.z = t.optional("z");
  spec.model = t.required("model");
  if (std::find(fit_models().begin(), fit_models().end(), spec.model) == fit_models().end())
    t.reader().fail("model", fmt::format("found '{}', allowed: {}", spec.model, fmt::join(fit_models(), ", ")));
  spec.relative_density = t.reader().boolean_or("relative_density", false);
  spec.where = t.filters("where");
  return spec;
}

InsetSpec read_inset(TableReader inset, const Words& words) {
  InsetSpec spec;
  spec.x = read_axis(inset.table("x"), words);
  spec.y = read_axis(inset.table("y"), words);
  const auto place = inset.numbers("place", Range::between(0, 1));
  if (place.size() != 4) inset.fail("place", "allowed: four numbers, left, bottom, width, height");
  std::copy(place.begin(), place.end(), spec.place.begin());
  Texts inside(inset, words);
  spec.where = inside.filters("where");
  inset.finish();
  return spec;
}

/// The words of the plot's `for_each` and of the series' own are both filled in.
std::vector<SeriesSpec> read_all_series(Texts& plot) {
  std::vector<SeriesSpec> list;
  for (TableReader& series : plot.reader().tables("series"))
    for_each(series, [&](Texts& s) {
      Words words = plot.words();
      words.insert(s.words().begin(), s.words().end());
      Texts both(s.reader(), words);
      list.push_back(read_series(both));
    });
  return list;
}

PlotSpec read_plot(Texts& t) {
  TableReader& r = t.reader();
  PlotSpec plot;
  plot.place = Place(r, "name");
  plot.name = t.name("name");
  plot.title = t.optional("title");
  plot.key = t.optional("key", "left top");
  plot.key_title = t.optional("key_title");
  plot.caption = t.optional("caption");
  plot.x = read_axis(r.table("x"), t.words());
  plot.y = read_axis(r.table("y"), t.words());
  if (auto z = r.optional_table("z")) {
    plot.z = read_axis(*z, t.words());
    plot.surface = true;
  }
  plot.series = read_all_series(t);
  for (TableReader& line : r.tables("lines")) {
    Texts words(line, t.words());
    plot.lines.push_back({words.number("y"), words.number("x"), words.number("slope"), words.optional("title")});
    line.finish();
  }
  if (auto inset = r.optional_table("inset")) plot.inset = read_inset(*inset, t.words());
  return plot;
}

/// A picture needs a run, a script may have one: `read_run` reads it accordingly.
CommandSpec read_command(Texts& t, std::string (*read_run)(Texts&)) {
  CommandSpec spec;
  spec.place = Place(t.reader(), "command");
  spec.name = t.required("name");
  spec.run = read_run(t);
  spec.command = t.required("command");
  spec.caption = t.optional("caption");
  spec.series = t.list("series");
  spec.where = t.filters("where");
  return spec;
}

PictureSpec read_picture(Texts& t) {
  return {read_command(t, [](Texts& texts) { return texts.required("run"); })};
}

/// Without a run where none is named.
ScriptSpec read_script(Texts& t) {
  ScriptSpec spec{read_command(t, [](Texts& texts) { return texts.optional("run"); }), {}};
  spec.needs = t.list("needs");
  return spec;
}

StatementSpec read_statement(Texts& t) {
  TableReader& r = t.reader();
  StatementSpec s;
  s.place = Place(r, "ours");
  s.text = t.required("text");
  s.paper = t.required("paper");
  s.source = t.optional("source");
  s.ours = t.required("ours");
  s.note = t.optional("note");
  if (auto unjudged = r.optional_table("unjudged")) {
    Texts texts(*unjudged, t.words());
    s.ours_unjudged = texts.required("ours");
    s.note_unjudged = texts.optional("note", s.note);
    unjudged->finish();
  }
  s.why = t.optional("why");
  const std::vector<Filter> judged_where = t.filters("verdict_where");
  for (const Filter& filter : judged_where) {
    const auto word = t.words().find(filter.name);
    if (word == t.words().end()) s.place.fail(fmt::format("verdict_where: for_each has no '{}'", filter.name));
    s.judged = s.judged && filter.accepts(word->second);
  }
  s.only_refutes = r.boolean_or("only_refutes", false);
  s.only_if_judged = r.boolean_or("only_if_judged", false);
  s.meshes = t.list("meshes");
  TableReader quantities = r.table("quantities");
  for (const std::string& key : quantities.keys())
    s.quantities.push_back(read_quantity(quantities.table(key), key, t.words()));
  for (TableReader& condition : r.tables("require")) s.require.push_back(read_condition(condition, t.words()));
  for (TableReader& condition : r.tables("judged_if")) s.judged_if.push_back(read_condition(condition, t.words()));
  return s;
}

/// Reads every table of this name, once for each entry of its `for_each`.
template <class Spec>
void append_each(TableReader& root, const std::string& key, Spec (*read)(Texts&), std::vector<Spec>& specs) {
  for (TableReader& table : root.tables(key)) for_each(table, [&](Texts& t) { specs.push_back(read(t)); });
}

/// Adds the entries of another table. Where both have a key, tables are merged and other values are replaced.
void merge(toml::table& into, const toml::table& other) {
  for (const auto& [key, node] : other) {
    toml::table* ours = into[key].as_table();
    const toml::table* theirs = node.as_table();
    if (ours != nullptr && theirs != nullptr) {
      merge(*ours, *theirs);
    } else {
      into.insert_or_assign(key, node);
    }
  }
}

/// Reads a file into the figure, after the files that it includes.
class FigureReader {
public:
  FigureReader(Figure& figure, std::string programmes) : figure_(figure), programmes_(std::move(programmes)) {}

  void read(const std::string& path) {
    including_ = {filesystem::path(path).lexically_normal().string()};
    read(path, true);
    finish_powder();
    // Statements of included files follow the figure's own.
    figure_.statements.insert(figure_.statements.end(), included_statements_.begin(), included_statements_.end());
  }

private:
  void read(const std::string& path, bool main) {
    figure_.files.push_back(path);
    const auto document = std::make_shared<const TomlDocument>(TomlDocument::from_file(path));
    figure_.documents.push_back(document);
    TableReader root(*document);
    for (const std::string& file : included_files(root, path)) include(file);
    if (main)
      read_heading(root);
    else
      for (const char* heading : {"title", "question", "source"}) root.value(heading); // not taken over
    if (root.has("powder")) read_powder(root);
    const filesystem::path folder = filesystem::path(path).parent_path();
    read_runs(root, folder);
    read_tables(root, folder);
    read_plots(root);
    append_each(root, "statements", read_statement, main ? figure_.statements : included_statements_);
    root.finish();
  }

  /// The files that a file includes: beside it, or in the folder of programmes.
  std::vector<std::string> included_files(TableReader& root, const std::string& path) const {
    std::vector<std::string> files;
    for (const std::string& other : root.strings_or("include", {})) {
      const filesystem::path beside = filesystem::path(path).parent_path() / other;
      const bool plain = filesystem::path(other).parent_path().empty() && !filesystem::exists(beside);
      const filesystem::path file = (plain ? filesystem::path(programmes_) / other : beside).lexically_normal();
      if (!filesystem::is_regular_file(file))
        root.fail("include",
                  fmt::format("found '{}', but there is no such file; allowed: a file beside this one, or in "
                              "the folder '{}'",
                              other, programmes_));
      files.push_back(file.string());
      if (std::find(including_.begin(), including_.end(), files.back()) != including_.end())
        root.fail("include", fmt::format("found '{}', which includes this file, allowed: files that do not", other));
    }
    return files;
  }

  /// Reads a file, or only its [powder] if it was read before: a later file's powder counts.
  void include(const std::string& path) {
    const auto found = std::find(figure_.files.begin(), figure_.files.end(), path);
    including_.push_back(path);
    if (found == figure_.files.end())
      read(path, false);
    else
      repeat_powder(path, *figure_.documents[static_cast<std::size_t>(found - figure_.files.begin())]);
    including_.pop_back();
  }

  void repeat_powder(const std::string& path, const TomlDocument& document) {
    TableReader root(document);
    for (const std::string& file : included_files(root, path)) include(file);
    if (root.has("powder")) read_powder(root);
  }

  void read_heading(TableReader& root) {
    figure_.title = root.string("title");
    figure_.question = root.string_or("question", "");
    figure_.source = root.string_or("source", "");
  }

  /// Adds a file's [powder] to that of the files which were read before: those that it includes.
  void read_powder(TableReader& root) {
    last_powder_ = root.table("powder");
    merge(powder_, *root.value("powder")->as_table());
    figure_.element_size = last_powder_->number_or("element_size", figure_.element_size, Range::positive());
  }

  void finish_powder() {
    if (!last_powder_) return;
    if (!powder_.contains("element_size")) last_powder_->number("element_size", Range::positive()); // refuses
    powder_.erase("element_size");
    std::ostringstream text;
    text << powder_ << '\n';
    figure_.powder = text.str();
  }

  void read_runs(TableReader& root, const filesystem::path& folder) {
    if (auto defaults = root.optional_table("defaults"))
      for (const std::string& key : defaults->keys()) figure_.defaults[key] = values_of(*defaults, key).front();
    if (auto follows = root.optional_table("follows"))
      for (const std::string& name : follows->keys()) {
        TableReader of_name = follows->table(name);
        for (const std::string& text : of_name.keys()) {
          TableReader values = of_name.table(text);
          for (const std::string& key : values.keys())
            figure_.follows[name][text][key] = values_of(values, key).front();
        }
      }
    for (TableReader& r : root.tables("packings")) read_packing(r);
    for (TableReader& r : root.tables("runs")) read_run(r, folder);
    for (TableReader& r : root.tables("cases"))
      for_each(r, [&](Texts& t) {
        CaseBlock block;
        block.place = Place(t.reader(), "series");
        block.series = t.optional("series");
        block.meshes = t.list("meshes");
        block.only = t.filters("only");
        for (const std::string& key : t.reader().keys()) {
          if (key == "series" || key == "meshes" || key == "only" || key == "for_each") continue;
          block.values.emplace_back(key, t.values(key));
        }
        figure_.cases.push_back(std::move(block));
      });
    if (auto metrics = root.optional_table("metrics"))
      for (const std::string& key : metrics->keys())
        figure_.metrics.emplace_back(checked_name(*metrics, key, key), metrics->string(key));
    if (auto columns = root.optional_table("columns"))
      for (const std::string& key : columns->keys()) columns_[key] = columns->strings_or(key, {});
  }

  void read_packing(TableReader& r) {
    RunTemplate packing;
    packing.place = Place(r, "name");
    packing.is_packing = true;
    packing.name = checked_name(r, "name", r.string("name"));
    packing.size = r.string_or("size", "");
    packing.command = r.string_or("command", "");
    packing.series = r.strings_or("series", {});
    if (!packing.size.empty() && !packing.command.empty())
      r.fail("command", "cannot be used with 'size', allowed: one of both");
    r.finish();
    figure_.runs.push_back(std::move(packing));
  }

  void read_run(TableReader& r, const filesystem::path& folder) {
    RunTemplate run;
    run.place = Place(r, "name");
    run.name = checked_name(r, "name", r.string("name"));
    run.folder = r.string_or("folder", "");
    run.from = r.string_or("from", "");
    run.chain = r.string_or("chain", "");
    run.packing = r.string_or("packing", "");
    run.mesh = r.string_or("mesh", "");
    run.series = r.strings_or("series", {});
    run.programme = programme_path(r, r.string("programme"), folder);
    run.common_settings = r.boolean_or("common_settings", true);
    if (auto settings = r.optional_table("settings")) run.settings = read_settings(*settings);
    if (auto groups = r.optional_table("settings_unless_zero"))
      for (const std::string& key : groups->keys())
        run.settings_unless_zero.emplace_back(key, read_settings(groups->table(key)));
    if (!run.mesh.empty() && run.folder.empty()) r.fail("mesh", "found without 'folder', the folder of that run");
    r.finish();
    figure_.runs.push_back(std::move(run));
  }

  std::string programme_path(TableReader& r, const std::string& name, const filesystem::path& folder) const {
    filesystem::path path = name.ends_with(".toml") ? folder / name : filesystem::path(programmes_) / (name + ".toml");
    path = path.lexically_normal();
    if (!filesystem::exists(path)) {
      std::vector<std::string> known;
      std::error_code ignored;
      for (const auto& entry : filesystem::directory_iterator(programmes_, ignored))
        if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
      std::sort(known.begin(), known.end());
      const auto near = nearest_word(name, known);
      r.fail("programme", fmt::format("found '{}', but there is no {}{}", name, path.string(),
                                      near ? fmt::format("; did you mean '{}'?", *near) : ""));
    }
    return path.string();
  }

  void read_tables(TableReader& root, const filesystem::path& folder) {
    for (TableReader& table : root.tables("tables"))
      for_each(table, [&](Texts& t) {
        figure_.tables.push_back(t.reader().has("file") ? read_table_of_file(t, folder) : read_table(t, columns_));
      });
    append_each(root, "fits", read_fit, figure_.fits);
  }

  void read_plots(TableReader& root) {
    append_each(root, "plots", read_plot, figure_.plots);
    append_each(root, "pictures", read_picture, figure_.pictures);
    append_each(root, "scripts", read_script, figure_.scripts);
  }

  Figure& figure_;
  std::string programmes_;
  std::vector<std::string> including_; ///< the files that are being read, each included by the one before
  std::vector<StatementSpec> included_statements_;
  ColumnLists columns_;
  toml::table powder_;                     ///< of all files
  std::optional<TableReader> last_powder_; ///< of the file read last, for messages
};

template <class Item>
const Item& by_name(const std::vector<Item>& items, const std::string& name, const char* kind, const Place& place) {
  std::vector<std::string> names;
  for (const Item& item : items) {
    if (item.name == name) return item;
    names.push_back(item.name);
  }
  const auto near = nearest_word(name, names);
  place.fail(fmt::format("there is no {} '{}'{}", kind, name,
                         near            ? fmt::format("; did you mean '{}'?", *near)
                         : names.empty() ? ""
                                         : fmt::format("; allowed: {}", fmt::join(names, ", "))));
}

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
  const auto near = nearest_word(column, names);
  place.fail(fmt::format("table '{}' has no column '{}'{}", table, column,
                         near ? fmt::format("; did you mean '{}'?", *near)
                              : fmt::format("; allowed: {}", fmt::join(names, ", "))));
}

/// Finds references to unknown names before anything is run.
void check_names(const Figure& figure) {
  check_once(figure.runs, "run");
  check_once(figure.tables, "table");
  check_once(figure.fits, "fit");
  check_once(figure.plots, "plot");
  for (const RunTemplate& run : figure.runs) {
    if (!run.from.empty()) figure.run(run.from.substr(0, run.from.find_first_of("@:")), run.place);
    if (!run.packing.empty() && !figure.run(run.packing, run.place).is_packing)
      run.place.fail(fmt::format("packing: '{}' is a run, allowed: one of [[packings]]", run.packing));
  }
  for (const TableSpec& table : figure.tables) {
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

} // namespace

void Place::fail(const std::string& message) const {
  if (!reader_) throw InputError(one_line(message));
  if (key_.empty()) {
    const auto keys = reader_->keys();
    reader_->fail(keys.empty() ? "" : keys.front(), message);
  }
  reader_->fail(key_, message);
}

std::string filled_at(const Place& place, std::string_view pattern, const Words& words, Unknown unknown) {
  try {
    return filled(pattern, words, unknown);
  } catch (const InputError& error) {
    place.fail(error.what());
  }
}

bool Filter::accepts(const Value& value) const {
  if ((at_least || at_most) && !value.number) return false;
  if (at_least && !(*value.number >= *at_least)) return false;
  if (at_most && !(*value.number <= *at_most)) return false;
  return equal.empty() || std::find(equal.begin(), equal.end(), value) != equal.end();
}

const RunTemplate& Figure::run(const std::string& wanted, const Place& place) const {
  return by_name(runs, wanted, "run", place);
}

const TableSpec& Figure::table(const std::string& wanted, const Place& place) const {
  return by_name(tables, wanted, "table", place);
}

const FitSpec& Figure::fit(const std::string& wanted, const Place& place) const {
  return by_name(fits, wanted, "fit", place);
}

Figure read_figure(const std::string& path, const std::string& programmes) {
  Figure figure;
  figure.path = path;
  const filesystem::path file(path);
  figure.name = (file.filename() == "figure.toml" && file.has_parent_path()) ? file.parent_path().filename().string()
                                                                             : file.stem().string();
  FigureReader(figure, programmes).read(path);
  check_names(figure);
  return figure;
}

} // namespace mpfem
