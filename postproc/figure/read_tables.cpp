// Tables of a figure's file, their columns, and fits through them.

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/csv_reader.hpp"
#include "postproc/figure/read_specs.hpp"
#include "postproc/fits/fit.hpp"

namespace mpfem {

namespace {

/// A column with the name and unit of a heading "NAME [UNIT]"; without a unit it is 1.
ColumnSpec column_of(const std::string& title) {
  const CsvHeading heading = csv_heading(title);
  ColumnSpec column;
  column.title = title;
  column.name = heading.name;
  column.unit = heading.unit.empty() ? "1" : heading.unit;
  return column;
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
  ColumnSpec column = column_of(text.substr(0, equals));
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

/// The stages whose rows a table of curves has: `stage = N` or `stages = [N, …]`; empty: all.
std::vector<int> read_stages(TableReader& reader) {
  if (reader.has("stage") && reader.has("stages"))
    reader.fail("stages", "found together with 'stage', allowed: one of the two");
  constexpr Range whole_numbers = Range::between(-1e6, 1e6);
  if (reader.has("stage")) return {static_cast<int>(reader.integer("stage", whole_numbers))};
  if (!reader.has("stages")) return {};
  const std::vector<std::int64_t> stages = reader.integers("stages", whole_numbers);
  if (stages.empty()) reader.fail("stages", "found an empty list, allowed: a number or more");
  return {stages.begin(), stages.end()};
}

/// Refuses keys that would have no effect beside the others.
void check_kind(const TableReader& reader) {
  const bool curves = reader.has("curves"), list = reader.has("list");
  for (const char* key : {"stage", "stages", "points", "digits"})
    if (reader.has(key) && !curves) reader.fail(key, "found without 'curves', allowed: with it");
  if (curves && list) reader.fail("list", "found with 'curves', allowed: one of the two");
  if (reader.has("row") && (curves || list))
    reader.fail("row", fmt::format("found with '{}', allowed: a column instead", curves ? "curves" : "list"));
  if (reader.has("distinct") && curves)
    reader.fail("distinct", "found with 'curves', allowed: without it; the curve of a run is there only once");
}

} // namespace

TableSpec read_table(Texts& t, const ColumnLists& lists) {
  TableSpec spec;
  spec.place = Place(t.reader(), "columns");
  check_kind(t.reader());
  spec.name = t.name("name");
  spec.row = t.optional("row");
  spec.series = t.list("series");
  spec.where = t.filters("where");
  spec.curves = t.list("curves");
  spec.list = t.optional("list");
  spec.keep = t.filters("keep");
  spec.stages = read_stages(t.reader());
  if (t.reader().has("points"))
    spec.points = static_cast<std::size_t>(t.reader().integer("points", Range::between(2, 1e6)));
  spec.digits = static_cast<int>(t.reader().integer_or("digits", 6, Range::between(1, 17)));
  spec.distinct = t.reader().boolean_or("distinct", false);
  spec.spread = t.list("spread");
  const bool rows_of_files = !spec.curves.empty() || !spec.list.empty();
  for (const std::string& text : with_lists(t.list("columns"), lists))
    spec.columns.push_back(read_column(text, rows_of_files, spec.place));
  if (spec.columns.empty()) spec.place.fail("allowed: a column or more");
  return spec;
}

TableSpec read_table_of_file(Texts& t, const std::filesystem::path& folder) {
  TableSpec spec;
  spec.place = Place(t.reader(), "file");
  spec.name = t.name("name");
  spec.file = t.required("file");
  spec.beside = std::filesystem::exists(folder / spec.file);
  if (spec.beside) spec.file = (folder / spec.file).lexically_normal().string();
  for (const std::string& text : t.list("columns")) spec.columns.push_back(column_of(text));
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

} // namespace mpfem
