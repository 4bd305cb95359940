#pragma once
// A figure as its TOML file declares it (docs/figure-file.md): runs, tables, fits, plots, pictures and statements.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/table_reader.hpp"
#include "postproc/figure/words.hpp"

namespace mpfem {

/// Where something was declared, for messages.
class Place {
public:
  Place() = default;
  Place(const TableReader& reader, std::string key)
      : reader_(std::make_shared<TableReader>(reader)), key_(std::move(key)) {}
  /// Throws InputError "FILE:LINE:COLUMN: key …: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;

private:
  std::shared_ptr<const TableReader> reader_;
  std::string key_;
};

/// `filled`, with the place in the message.
std::string filled_at(const Place& place, std::string_view pattern, const Words& words,
                      Unknown unknown = Unknown::refused);

using Settings = std::vector<std::pair<std::string, std::string>>; ///< scenario key, value (a pattern)

/// A run of every case, or a packing: `from` empty where a run begins at a packing.
struct RunTemplate {
  std::string name, folder, programme, from, chain;
  Settings settings;
  std::vector<std::pair<std::string, Settings>> settings_unless_zero; ///< with the value that must not be 0
  bool common_settings = true;
  std::string packing;             ///< name of the packing that it begins at; empty: that of the mesh
  std::string mesh;                ///< of another MESH: its run is taken where it lies, and not made
  std::vector<std::string> series; ///< of these alone, the cells of other cases are empty; empty: all
  bool is_packing = false;
  std::string size;    ///< of a packing: nominal element size, mm
  std::string command; ///< of a packing: options of pack-gen, in place of a size; both empty: that of the mesh
  Place place;
};

/// Which rows: those whose value of `name` is one of `equal`, where that is not empty, and within the limits.
struct Filter {
  std::string name;
  std::vector<Value> equal;
  std::optional<double> at_least, at_most;
  /// An empty value passes no limit.
  bool accepts(const Value& value) const;
};

/// Some of the rows of a series: every combination of the values given, the last list varying fastest.
struct CaseBlock {
  std::string series;
  std::vector<std::string> meshes; ///< empty: all
  std::vector<std::pair<std::string, std::vector<Value>>> values;
  std::vector<Filter> only; ///< rows that are shown; chains keep their whole lists
  Place place;
};

struct ColumnSpec {
  std::string title, name, unit; ///< title: "name [unit]"
  /// "RUN/METRIC.KEY:FORMAT" of a table of numbers; a column of the history, or of the list, of a table of those, that
  /// may be taken over a metric's number; else a pattern of the case's values.
  std::string run, metric, key, format, history, pattern;
};

struct TableSpec {
  std::string name, row;
  std::vector<std::string> series; ///< empty: all
  std::vector<Filter> where;
  std::vector<ColumnSpec> columns;
  std::vector<std::string> curves; ///< runs whose histories follow one another; empty: a row a case
  std::string list;                ///< "RUN/METRIC": all rows of the CSV file that the metric writes next to its JSON
  std::vector<Filter> keep;        ///< by columns: the other rows are left out
  std::optional<int> stage;        ///< of the curves; none: all rows
  int digits = 6;                  ///< of the curves' numbers
  bool distinct = false;           ///< equal rows, or curves of the same runs, once
  std::string file;                ///< a CSV file with these columns in place of all this
  bool beside = false;             ///< it lies next to the figure's file, else in the folder of its results
  std::vector<std::string> spread; ///< columns whose mean and deviation over packings are drawn
  Place place;
};

struct FitSpec {
  std::string name, table, x, y, z, model;
  bool relative_density = false;
  std::vector<Filter> where;
  Place place;
};

struct AxisSpec {
  std::string label, format, ticks; ///< ticks: as gnuplot takes them, "0.1" or "(1, 2, 5)"
  std::optional<double> low, high;
  bool logarithmic = false;
};

struct SeriesSpec {
  std::string table, x, y, error, group, colour_by;  ///< columns
  std::string fit;                                   ///< or a fit
  std::vector<std::pair<std::string, double>> model; ///< or a model with given coefficients, of `fit_model`
  std::string fit_model;
  std::optional<double> from, to, at; ///< range of x of a fit; value of z
  double x_scale = 1, y_scale = 1;
  std::vector<Filter> where;
  std::string style;                          ///< points, lines, linespoints
  std::optional<double> fixed_x, fixed_group; ///< of a surface: points projected to this value
  int colour = 1, point = 0;
  double width = 0, size = 0;
  std::string dash, title;
  bool spread = false;
  Place place;
};

struct LineSpec {
  std::optional<double> y, x, slope; ///< horizontal, vertical, or through the origin
  std::string title;
};

/// A part of the same plot, enlarged.
struct InsetSpec {
  AxisSpec x, y;
  std::array<double, 4> place{}; ///< left, bottom, width, height as parts of the picture
  std::vector<Filter> where;     ///< rows of the first series' table over which x reaches
};

struct PlotSpec {
  std::string name, title, key, key_title, caption; ///< caption: on the report, a sentence
  AxisSpec x, y, z;
  std::vector<SeriesSpec> series;
  std::vector<LineSpec> lines;
  std::optional<InsetSpec> inset;
  bool surface = false; ///< z over x and y
  Place place;
};

/// A file that a command makes.
struct CommandSpec {
  std::string name, run, command; ///< "{run}" in the command is the run's file
  std::string caption;            ///< of a picture on the report
  std::vector<std::string> series;
  std::vector<Filter> where;
  Place place;
};

/// A picture or a table that another command of postproc makes from each run.
struct PictureSpec : CommandSpec {};

/// A file that a command makes which is no verb of postproc, once for each text that `name` becomes.
struct ScriptSpec : CommandSpec {
  std::vector<std::string> needs; ///< files of the figure that others make
};

struct QuantitySpec {
  std::string name;
  std::string table, column, over, take, item; ///< of a table's column, divided by column `over` where that is given
  std::vector<Filter> where;
  std::vector<Filter> relative_to; ///< each value over that of the row of these with the same `by`
  std::string by;
  std::string fit, coefficient, measure; ///< of a fit: a coefficient with its interval, or r_squared, points …
  std::string of, divided_by, minus;     ///< of other quantities
  std::optional<double> otherwise;       ///< where there is no row
  Place place;
};

/// A number or the name of a quantity.
struct Operand {
  std::optional<double> number;
  std::string name;
};

struct ConditionSpec {
  /// near, at_least, at_most, above, below, between, rises, falls, ordered, interval_includes, interval_excludes,
  /// interval_width_at_most, or either: one of several conditions.
  std::string quantity, predicate;
  std::vector<ConditionSpec> either;
  std::vector<Operand> operands;
  double within = 0;
  bool absolute = false;
  double tolerance = 0;    ///< of rises and falls: smaller changes count as none, relative unless `absolute`
  std::string along, each; ///< of rises and falls: sorted by this column, within rows of equal `each`
  Place place;
};

struct StatementSpec {
  std::string text, paper, source, ours, note;
  std::string ours_unjudged, note_unjudged; ///< in place of both where it cannot be judged
  std::string why;                          ///< the reason where it differs
  std::vector<QuantitySpec> quantities;
  std::vector<ConditionSpec> require, judged_if;
  bool only_refutes = false;   ///< agreement cannot be shown, only disagreement
  bool only_if_judged = false; ///< left out where it cannot be judged
  bool judged = true;          ///< false: reported without a verdict
  std::vector<std::string> meshes;
  Place place;
};

struct Figure {
  std::string path, name, title, question, source;
  std::vector<std::string> files; ///< all that were read
  Words defaults;
  std::map<std::string, std::map<std::string, Words>> follows; ///< values that follow from another: name, text, values
  std::vector<CaseBlock> cases;
  std::vector<RunTemplate> runs;
  std::vector<std::pair<std::string, std::string>> metrics; ///< name, command of postproc
  std::vector<TableSpec> tables;
  std::vector<FitSpec> fits;
  std::vector<PlotSpec> plots;
  std::vector<PictureSpec> pictures;
  std::vector<ScriptSpec> scripts;
  std::vector<StatementSpec> statements;
  std::string powder; ///< TOML of a packing's description, where the study has its own
  double element_size = 0;
  std::vector<std::shared_ptr<const TomlDocument>> documents; ///< what the places refer to

  /// A run or a packing.
  const RunTemplate& run(const std::string& name, const Place& place) const;
  const TableSpec& table(const std::string& name, const Place& place) const;
  const FitSpec& fit(const std::string& name, const Place& place) const;
};

/// Reads a figure's file and what it includes. `programmes`: folder of the scenarios that are named without a path.
/// The name is the file's, or of "NAME/figure.toml" the folder's. Throws InputError with file and line: missing and
/// unknown keys, values outside their range, names that nothing in the file has.
Figure read_figure(const std::string& path, const std::string& programmes);

} // namespace mpfem
