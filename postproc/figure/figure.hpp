#pragma once
// A figure as declared in its TOML file (docs/figure-file.md): runs, tables, fits, plots, pictures and statements.

#include <array>
#include <map>
#include <memory>
#include <set>
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
  /// The same message, for a note.
  std::string note(const std::string& message) const;

private:
  std::shared_ptr<const TableReader> reader_;
  std::string key_;
};

/// `filled` (words.hpp), with the place in the message of the error.
std::string filled_at(const Place& place, std::string_view pattern, const Words& words,
                      Unknown unknown = Unknown::refused);

using Settings = std::vector<std::pair<std::string, std::string>>; ///< scenario key, value (a pattern)

/// A run made for every case, or a packing. `from` is empty for a run that begins at a packing.
struct RunTemplate {
  std::string name, folder, programme, from, chain;
  Settings settings;
  std::vector<std::pair<std::string, Settings>> settings_unless_zero; ///< each with the value that must not be 0
  bool common_settings = true;
  std::string packing;             ///< name of the packing at which it begins; empty: that of the mesh
  std::string mesh;                ///< of another MESH: its run is read from there, and not made
  std::vector<std::string> series; ///< for these only, other cases have empty cells; empty: all
  bool is_packing = false;
  std::string size;    ///< of a packing: nominal element size, mm
  std::string command; ///< of a packing: options of pack-gen instead of a size; both empty: that of the mesh
  Place place;
};

/// Selects rows whose value of `name` is one of `equal` (unless that is empty) and within the limits.
struct Filter {
  std::string name;
  std::vector<Value> equal;
  std::optional<double> at_least, at_most;
  /// An empty value is outside any limit.
  bool accepts(const Value& value) const;
};

/// Some of the rows of a series: every combination of the given values; the last list varies fastest.
struct CaseBlock {
  std::string series;
  std::vector<std::string> meshes; ///< empty: all
  std::vector<std::pair<std::string, std::vector<Value>>> values;
  std::vector<Filter> only; ///< the rows that are shown; chains still use the whole lists
  Place place;
};

/// How a metric is measured.
struct MetricSpec {
  std::string name, command; ///< command: of postproc, or of pack-gen if it begins so
  Place place;
};

/// One column of a table.
struct ColumnSpec {
  std::string title, name, unit; ///< title: "name [unit]"
  /// Where the cell comes from: "RUN/METRIC.KEY:FORMAT" (run, metric, key, format) in a table of numbers; `history`, a
  /// column of the history or of the list, in a table of curves or lists, optionally over a metric's number; otherwise
  /// `pattern`, filled with the case's values.
  std::string run, metric, key, format, history, pattern;
};

/// A table made from the metrics, curves or lists of runs, or read from a file.
struct TableSpec {
  std::string name, row;
  std::vector<std::string> series; ///< empty: all
  std::vector<Filter> where;
  std::vector<ColumnSpec> columns;
  std::vector<std::string> curves; ///< runs whose histories are joined in this order; empty: one row per case
  std::string list;                ///< "RUN/METRIC": all rows of the CSV file that the metric writes next to its JSON
  std::vector<Filter> keep;        ///< by columns; other rows are left out
  std::vector<int> stages;         ///< of the curves; empty: all rows
  std::size_t points = 0;          ///< most rows of each curve, evenly spaced; 0: all
  int digits = 6;                  ///< significant digits of the curves' numbers
  bool distinct = false;           ///< equal rows, or curves of the same runs, appear once
  std::string file;                ///< a CSV file with these columns, instead of all the above
  bool beside = false;             ///< it lies next to the figure's file, otherwise in the folder of its results
  std::vector<std::string> spread; ///< columns whose mean and deviation over packings are drawn
  Place place;

  /// Of its columns, "name" included where it has a name for each row.
  std::vector<std::string> column_names() const;
};

/// A fit of a model through rows of a table; x, y and z are names of columns.
struct FitSpec {
  std::string name, table, x, y, z, model;
  bool relative_density = false;
  std::vector<Filter> where;
  Place place;
};

/// An axis of a plot.
struct AxisSpec {
  std::string label, format, ticks; ///< ticks: in gnuplot's syntax, "0.1" or "(1, 2, 5)"
  std::optional<double> low, high;
  bool logarithmic = false;
};

/// A series of a plot: rows of a table, a fit, or a model with given coefficients.
struct SeriesSpec {
  std::string table, x, y, error, group, colour_by;  ///< columns
  std::string fit;                                   ///< or the name of a fit
  std::vector<std::pair<std::string, double>> model; ///< or given coefficients of `fit_model`
  std::string fit_model;
  std::optional<double> from, to, at; ///< range of x of a fit; value of z
  double x_scale = 1, y_scale = 1;
  std::vector<Filter> where;
  std::string style;                          ///< points, lines, linespoints
  std::optional<double> fixed_x, fixed_group; ///< of a surface: points are projected to this value
  int colour = 1, point = 0;
  double width = 0, size = 0;
  std::string dash, title;
  bool spread = false;
  bool beside = true; ///< also drawn from other results
  Place place;
};

/// A reference line of a plot.
struct LineSpec {
  std::optional<double> y, x, slope; ///< horizontal, vertical, or through the origin
  std::string title;
};

/// A part of the same plot, enlarged.
struct InsetSpec {
  AxisSpec x, y;
  std::array<double, 4> place{}; ///< left, bottom, width, height as fractions of the picture
  std::vector<Filter> where;     ///< rows of the first series' table that set the range of x
};

/// A plot, drawn by gnuplot.
struct PlotSpec {
  std::string name, title;
  std::string key, key_title; ///< key: its place in gnuplot's words; empty for one that covers no data
  std::string caption;        ///< a sentence for the report
  AxisSpec x, y, z;
  std::vector<SeriesSpec> series;
  std::vector<LineSpec> lines;
  std::optional<InsetSpec> inset;
  bool surface = false; ///< z over x and y
  Place place;
};

/// A file made by a command.
struct CommandSpec {
  std::string name, run, command; ///< "{run}" in the command is the run's file
  std::string caption;            ///< of a picture in the report
  std::vector<std::string> series;
  std::vector<Filter> where;
  Place place, place_of_caption;
};

/// A picture or a table made from each run by another subcommand of postproc.
struct PictureSpec : CommandSpec {};

/// A file made by a command other than postproc's subcommands, one for each text that `name` becomes.
struct ScriptSpec : CommandSpec {
  std::vector<std::string> needs; ///< files of the figure that other commands make
};

/// A number or a column of numbers that a statement uses.
struct QuantitySpec {
  std::string name;
  std::string table, column, over, take, item; ///< of a table's column, divided by column `over` if that is given
  std::vector<Filter> where;
  std::vector<Filter> relative_to; ///< each value is divided by that of the row among these with the same `by`
  std::string by;
  std::string fit, coefficient, measure; ///< of a fit: a coefficient with its interval, or r_squared, points …
  std::string of, divided_by, minus;     ///< of other quantities
  std::optional<double> otherwise;       ///< value where there is no row
  Place place;
};

/// A number, or the name of a quantity.
struct Operand {
  std::optional<double> number;
  std::string name;
};

/// A condition on a quantity of a statement.
struct ConditionSpec {
  /// near, at_least, at_most, above, below, between, rises, falls, ordered, interval_includes, interval_excludes,
  /// interval_width_at_most, or either: one of several conditions.
  std::string quantity, predicate;
  std::vector<ConditionSpec> either;
  std::vector<Operand> operands;
  double within = 0;
  bool absolute = false;
  double tolerance = 0;    ///< of rises and falls: smaller changes do not count; relative unless `absolute`
  std::string along, each; ///< of rises and falls: sorted by column `along`, within rows of equal `each`
  Place place;
};

/// A statement, of the paper or expected, and the conditions by which it is judged.
struct StatementSpec {
  std::string text, paper, source, ours, note;
  std::string ours_unjudged, note_unjudged; ///< replace `ours` and `note` where it cannot be judged
  std::string why;                          ///< the reason for a difference from the paper
  std::vector<QuantitySpec> quantities;
  std::vector<ConditionSpec> require, judged_if;
  bool only_refutes = false;   ///< agreement cannot be shown, only disagreement
  bool only_if_judged = false; ///< omitted where it cannot be judged
  bool judged = true;          ///< false: reported without a verdict
  std::vector<std::string> meshes;
  Place place;
};

/// Results of the same figure with other settings that its plots show as well.
struct BesideSpec {
  std::string folder, title;       ///< that of all figures' results; for the plots' keys. Empty: none
  std::vector<std::string> meshes; ///< only beside results of these; empty: of all
  Place place;
};

/// Everything that a figure's file declares.
struct Figure {
  std::string path, name, title, question, source;
  std::vector<std::string> files; ///< all that were read
  Words defaults;
  std::map<std::string, std::map<std::string, Words>> follows; ///< values implied by another one: name, text, values
  Place follows_place;
  std::vector<CaseBlock> cases;
  std::vector<RunTemplate> runs;
  std::vector<MetricSpec> metrics;
  std::vector<TableSpec> tables;
  std::vector<FitSpec> fits;
  std::vector<PlotSpec> plots;
  BesideSpec beside;
  std::vector<PictureSpec> pictures;
  std::vector<ScriptSpec> scripts;
  std::vector<StatementSpec> statements;
  std::string powder; ///< TOML of a packing's description, if the study has its own
  double element_size = 0;
  std::set<std::string> powder_files;                         ///< named in the description, with their whole path
  std::vector<std::shared_ptr<const TomlDocument>> documents; ///< to which the places refer

  /// A run or a packing.
  const RunTemplate& run(const std::string& name, const Place& place) const;
  const TableSpec& table(const std::string& name, const Place& place) const;
  const FitSpec& fit(const std::string& name, const Place& place) const;
};

/// Reads a figure's file and those that it includes. `programmes`: folder of the scenarios that are named without a
/// path. The name is that of the file, or of the folder for "NAME/figure.toml". Throws InputError with file and line:
/// missing and unknown keys, values outside their range, names that nothing in the file has.
Figure read_figure(const std::string& path, const std::string& programmes);

} // namespace mpfem
