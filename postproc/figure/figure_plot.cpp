#include "postproc/figure/figure_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "postproc/drawing/ticks.hpp"
#include "postproc/figure/key_place.hpp"
#include "postproc/files/gnuplot.hpp"

namespace mpfem {

namespace {

constexpr int curve_points = 201;

/// A colour and its point type.
struct Look {
  const char* colour;
  int point;
};
/// Colours that colour-blind readers can tell apart (Okabe and Ito).
constexpr Look looks[] = {{"#0072b2", 7},  {"#d55e00", 5}, {"#009e73", 9},  {"#cc79a7", 11},
                          {"#000000", 13}, {"#56b4e9", 2}, {"#e69f00", 15}, {"#999999", 3}};

constexpr const char *dashed = " dashtype (12, 10)", *dotted = " dashtype (4, 6)";

constexpr const char* style = R"(set encoding utf8
set border 3 linewidth 1.2
set tics nomirror out
set grid linecolor rgb '#dddddd' linetype 1
set datafile missing 'NaN'
)";

std::string line_types() {
  std::string text;
  int number = 0;
  for (const Look& look : looks)
    text +=
        fmt::format("set linetype {} linecolor rgb '{}' linewidth 2 pointtype {}\n", ++number, look.colour, look.point);
  return text;
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "*";
}

std::string axis_text(const char* axis, const AxisSpec& spec) {
  std::string text = fmt::format("set {}label {}\n", axis, gnuplot_string(spec.label));
  if (spec.low || spec.high) text += fmt::format("set {}range [{}:{}]\n", axis, number(spec.low), number(spec.high));
  if (spec.logarithmic) text += fmt::format("set logscale {}\n", axis);
  if (!spec.format.empty()) text += fmt::format("set format {} {}\n", axis, gnuplot_string(spec.format));
  if (!spec.ticks.empty()) text += fmt::format("set {}tics {}\n", axis, spec.ticks);
  return text;
}

std::string line_style(const SeriesSpec& s) {
  std::string text = fmt::format(" linetype {}", s.colour);
  // Given as lengths: gnuplot's own patterns differ from format to format.
  if (s.dash == "dashed") text += dashed;
  if (s.dash == "dotted") text += dotted;
  if (s.dash == "long") text += " dashtype (24, 10)";
  if (s.width > 0) text += fmt::format(" linewidth {}", s.width);
  if (s.point > 0) text += fmt::format(" pointtype {}", s.point);
  if (s.style != "lines") text += fmt::format(" pointsize {}", s.size);
  return text;
}

/// A table's value as gnuplot shows it letter by letter, where "on_contact" would set the c below the line.
Value without_markup(Value value) {
  constexpr std::string_view marks = "_^{}@&~";
  std::string text;
  for (const char c : value.text) text += (marks.find(c) == std::string_view::npos ? "" : "\\") + std::string(1, c);
  value.text = text;
  return value;
}

std::string title_text(const std::string& title) {
  return title.empty() ? " notitle" : " title " + gnuplot_string(title);
}

/// The same series from other results: dashed, with hollow points, without a title; without errors, which would cover
/// its own.
SeriesSpec as_beside(SeriesSpec s) {
  s.dash = "dashed";
  s.title.clear();
  s.error.clear();
  s.spread = false;
  if (s.point == 0) s.point = looks[s.colour - 1].point;
  if (s.point >= 5 && s.point % 2 == 1) --s.point; // gnuplot's hollow form of a filled point
  return s;
}

/// Whether a table of other results has what is drawn of a series: it may be older than the figure's file.
bool has_columns_of(const SeriesSpec& s, const TextTable& table) {
  std::vector<std::string> needed = {s.x, s.y};
  if (!s.group.empty()) needed.push_back(s.group);
  for (const Filter& filter : s.where) needed.push_back(filter.name);
  return std::all_of(needed.begin(), needed.end(), [&](const std::string& name) { return table.has(name); });
}

/// Data blocks and the lines of the plot command that draw them.
class Script {
public:
  Script(const PlotSpec& plot, FigureData& data, std::string folder, int packings)
      : plot_(plot), data_(&data), folder_(std::move(folder)), packings_(packings) {}

  void add(const SeriesSpec& s) {
    if (s.table.empty())
      add_model(s);
    else if (s.group.empty())
      add_rows(s, s.where, s.colour, s.title);
    else
      add_groups(s);
    if (s.spread && packings_ > 0) add_spread(s);
  }
  /// Adds measured points or a curve as they are in other results, if those have them.
  void add_beside(const SeriesSpec& s, FigureData& other) {
    if (!s.beside || s.table.empty() || !s.colour_by.empty() || !other.has_table(s.table)) return;
    if (other.figure().table(s.table, s.place).beside) return; // the same file
    if (!has_columns_of(s, other.table(s.table))) return;
    FigureData* const own = std::exchange(data_, &other);
    add(as_beside(s));
    data_ = own;
    if (beside_style_.empty()) beside_style_ = s.style;
    if (beside_style_ != s.style) beside_style_ = "linespoints";
  }
  bool has_beside() const { return !beside_style_.empty(); }
  /// How series of other results look in the key.
  std::string beside_sample() const {
    return fmt::format("{} linetype 8{}{}", beside_style_, beside_style_ == "points" ? "" : dashed,
                       beside_style_ == "lines" ? "" : " pointtype 6 pointsize 1.5");
  }
  const std::string& blocks() const { return blocks_; }
  std::string drawings() const { return fmt::format("{}", fmt::join(drawings_, ", \\\n  ")); }
  bool empty() const { return drawings_.empty(); }
  /// What the plot shows, and its titles in the key.
  const std::vector<DrawnLine>& lines() const { return lines_; }
  const std::vector<std::string>& titles() const { return titles_; }

private:
  /// Draws the points of `line`, with the columns `using` of `block`.
  void draw(const std::string& block, const std::string& with, const std::string& title, DrawnLine line = {}) {
    const std::string name = fmt::format("$data{}", ++count_);
    blocks_ += fmt::format("{} << EOD\n{}EOD\n", name, block);
    drawings_.push_back(fmt::format("{} {}{}", name, with, title_text(title)));
    lines_.push_back(std::move(line));
    titles_.push_back(title);
  }

  void add_groups(const SeriesSpec& s) {
    const TextTable& table = data_->table(s.table);
    const std::size_t group = table.column(s.group, s.place);
    std::vector<Value> seen;
    for (const std::size_t row : table.rows_of(s.where, s.place)) {
      const Value& value = table.rows[row][group];
      if (std::find(seen.begin(), seen.end(), value) != seen.end()) continue;
      seen.push_back(value);
      auto where = s.where;
      where.push_back({s.group, {value}, {}, {}});
      const int colour = (s.colour - 1 + static_cast<int>(seen.size()) - 1) % static_cast<int>(std::size(looks)) + 1;
      add_rows(s, where, colour, filled_at(s.place, s.title, {{"value", without_markup(value)}}, Unknown::kept));
    }
  }

  void add_rows(const SeriesSpec& s, const std::vector<Filter>& where, int colour, const std::string& title) {
    const TextTable& table = data_->table(s.table);
    std::vector<std::pair<std::size_t, double>> columns = {{table.column(s.x, s.place), s.x_scale},
                                                           {table.column(s.y, s.place), s.y_scale}};
    if (!s.error.empty()) columns.emplace_back(table.column(s.error, s.place), s.y_scale);
    if (!s.colour_by.empty()) columns.emplace_back(table.column(s.colour_by, s.place), 1);
    std::string block, with_error; // the latter: points whose error is known
    std::size_t errors = 0;
    DrawnLine line{{}, s.style != "points"};
    for (const std::size_t row : table.rows_of(where, s.place)) {
      std::string cells;
      for (const auto& [column, scale] : columns) {
        const auto value = table.number(row, column, s.place);
        cells += value ? fmt::format("{:.9g} ", *value * scale) : "NaN ";
      }
      block += cells + '\n';
      const auto x = table.number(row, columns[0].first, s.place), y = table.number(row, columns[1].first, s.place);
      if (x && y) line.points.push_back({*x * s.x_scale, *y * s.y_scale});
      if (x && y && !s.error.empty() && table.number(row, columns[2].first, s.place)) {
        with_error += cells + '\n';
        ++errors;
      }
    }
    if (line.points.empty()) return; // none of it could be measured
    SeriesSpec drawn = s;
    drawn.colour = colour;
    if (!s.colour_by.empty())
      draw(block, "using 1:2:3 with lines linewidth 1.5 palette", title, line);
    else if (!s.error.empty() && errors == line.points.size())
      draw(block,
           fmt::format("using 1:2:3 with {}{}", s.style == "points" ? "yerrorbars" : "yerrorlines", line_style(drawn)),
           title, line);
    else if (!s.error.empty())
      draw_some_errors(block, with_error, drawn, title, line);
    else
      draw(block, fmt::format("using 1:2 with {}{}", s.style, line_style(drawn)), title, line);
  }

  /// gnuplot leaves out a point whose error is missing. So all points are drawn without a bar, and over them those of
  /// `with_error` with one.
  void draw_some_errors(const std::string& block, const std::string& with_error, const SeriesSpec& s,
                        const std::string& title, const DrawnLine& line) {
    const std::string look = line_style(s);
    draw(block, fmt::format("using 1:2 with {}{}", s.style == "points" ? "points" : "linespoints", look), title, line);
    if (!with_error.empty()) draw(with_error, "using 1:2:3 with yerrorbars" + look, "");
  }

  /// Of the rows that the series shows; the table of spreads has the same rows as the series' own.
  void add_spread(const SeriesSpec& s) {
    const TextTable table = read_text_table(fmt::format("{}/{}.spread.csv", folder_, s.table));
    const TextTable& own = data_->table(s.table);
    if (table.rows.size() != own.rows.size())
      s.place.fail(fmt::format("{} has {} rows, allowed: {}, as in the table '{}'", table.path, table.rows.size(),
                               own.rows.size(), s.table));
    const std::size_t x = table.column(s.x, s.place), y = table.column(s.y, s.place),
                      deviation = table.column(s.y + "_deviation", s.place);
    std::string block;
    DrawnLine line;
    for (const std::size_t shown : own.rows_of(s.where, s.place)) {
      const auto& row = table.rows[shown];
      if (!row[x].number || !row[y].number || !row[deviation].number) continue;
      const double at = *row[x].number * s.x_scale, mean = *row[y].number * s.y_scale,
                   spread = *row[deviation].number * s.y_scale;
      block += fmt::format("{:.9g} {:.9g} {:.9g}\n", at, mean, spread);
      line.points.insert(line.points.end(), {{at, mean - spread}, {at, mean + spread}});
    }
    if (block.empty()) return;
    const bool first = spreads_++ == 0; // named only once in the key
    draw(block, fmt::format("using 1:2:3 with yerrorbars linetype {} pointtype 6 pointsize 1.5", first ? 5 : 4),
         first ? fmt::format("mean and standard deviation of {} packings", packings_) : "", line);
  }

  /// A fit, over the range of its points or the given one, or a model with given coefficients.
  void add_model(const SeriesSpec& s) {
    std::map<std::string, double> coefficients(s.model.begin(), s.model.end());
    std::string model = s.fit_model;
    bool relative_density = false;
    double from = s.from.value_or(plot_.x.low.value_or(0)), to = s.to.value_or(plot_.x.high.value_or(1));
    if (!s.fit.empty()) {
      const auto& fit = data_->fit(s.fit);
      if (fit.contains("refused")) return;
      for (const auto& [name, value] : fit.at("coefficients").items())
        if (value.at("value").is_number()) coefficients[name] = value.at("value").template get<double>();
      model = fit.at("model").get<std::string>();
      relative_density = fit.at("relative_density").get<bool>();
      const auto& range = fit.at(s.x == "z" ? "z" : "x").at("range");
      from = s.from.value_or(range[0].get<double>());
      to = s.to.value_or(range[1].get<double>());
    }
    const auto y = model_with(model, coefficients, relative_density);
    if (plot_.surface) {
      add_surface(s, y);
      return;
    }
    std::string block;
    DrawnLine line{{}, true};
    for (int i = 0; i < curve_points; ++i) {
      const double at = from + (to - from) * i / (curve_points - 1), other = s.at.value_or(0);
      const double value = s.x == "z" ? y(other, at) : y(at, other);
      if (!std::isfinite(value)) continue;
      block += fmt::format("{:.9g} {:.9g}\n", at * s.x_scale, value * s.y_scale);
      line.points.push_back({at * s.x_scale, value * s.y_scale});
    }
    draw(block, fmt::format("using 1:2 with lines{}", line_style(s)), s.title, line);
  }

  void add_surface(const SeriesSpec& s, const std::function<double(double, double)>& y) {
    constexpr int cells = 24;
    std::string block;
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        const double p = plot_.x.low.value_or(0) + (plot_.x.high.value_or(1) - plot_.x.low.value_or(0)) * i / cells;
        const double g = plot_.y.low.value_or(0) + (plot_.y.high.value_or(1) - plot_.y.low.value_or(0)) * j / cells;
        block += fmt::format("{:.9g} {:.9g} {:.9g}\n", p, g, y(p, g) * s.y_scale);
      }
      block += '\n';
    }
    draw(block, fmt::format("using 1:2:3 with lines{}", line_style(s)), s.title);
  }

  const PlotSpec& plot_;
  FigureData* data_;
  std::string beside_style_; ///< of the series of other results; empty: none is drawn
  std::string folder_;
  int packings_ = 0, count_ = 0, spreads_ = 0;
  std::string blocks_;
  std::vector<std::string> drawings_, titles_;
  std::vector<DrawnLine> lines_;
};

/// The points of a surface's series: x, y and z are the table's columns s.x, s.group and s.y.
std::string surface_points(const SeriesSpec& s, FigureData& data) {
  const TextTable& table = data.table(s.table);
  std::string block;
  for (const std::size_t row : table.rows_of(s.where, s.place)) {
    const auto& cells = table.rows[row];
    const auto x = cells[table.column(s.x, s.place)].number, y = cells[table.column(s.group, s.place)].number,
               z = cells[table.column(s.y, s.place)].number;
    if (x && y && z)
      block +=
          fmt::format("{:.9g} {:.9g} {:.9g}\n", s.fixed_x.value_or(*x), s.fixed_group.value_or(*y), *z * s.y_scale);
  }
  return block;
}

/// Both formats have the same layout. svg takes the size of letters in points of the picture, pngcairo in those of a
/// printer, of which 3 are as large as 4 of the picture; a dash of svg is twice as long, and its ticks are longer.
std::string terminal(const std::string& format) {
  if (format == "svg")
    return "set terminal svg size 1200,900 dynamic enhanced font 'DejaVu Sans,20' fontscale 1.3333 linewidth 1.5 "
           "dashlength 0.5 background 'white'\nset tics scale 0.8\n";
  if (format == "png") return "set terminal pngcairo size 1200,900 enhanced font 'DejaVu Sans,20' linewidth 1.5\n";
  throw InputError(fmt::format("found the format '{}', allowed: png, svg", format));
}

/// A reference line from end to end of the axes. Of one through the origin the part between the first and the last x.
DrawnLine drawn_line(const LineSpec& line, const std::vector<DrawnLine>& lines) {
  if (line.y) return {{{-INFINITY, *line.y}, {INFINITY, *line.y}}, true};
  if (line.x) return {{{*line.x, -INFINITY}, {*line.x, INFINITY}}, true};
  double first = INFINITY, last = -INFINITY;
  for (const DrawnLine& other : lines)
    for (const auto& point : other.points) {
      first = std::min(first, point[0]);
      last = std::max(last, point[0]);
    }
  return {{{first, line.slope.value_or(0) * first}, {last, line.slope.value_or(0) * last}}, true};
}

/// What is drawn where no run gave a value.
constexpr const char* nothing_to_draw = R"(unset logscale
set xrange [0:1]
set yrange [0:1]
set format x ''
set format y ''
set label 1 'none of these values could be measured' at graph 0.5,0.5 center
plot NaN notitle
)";

/// The key's place that the figure's file gives, or one where it covers no data.
std::string key_words(const PlotSpec& plot, const Script& script, const OtherResults* beside) {
  if (!plot.key.empty()) return plot.key;
  if (plot.inset) return "left top"; // an inset lies where the figure's file puts it, away from there
  std::vector<DrawnLine> lines = script.lines();
  std::vector<std::string> titles = script.titles();
  if (script.has_beside()) titles.push_back(beside->name);
  for (const LineSpec& line : plot.lines) {
    titles.push_back(line.title);
    lines.push_back(drawn_line(line, script.lines()));
  }
  return key_place(lines, {plot.x.low, plot.x.high, plot.x.logarithmic}, {plot.y.low, plot.y.high, plot.y.logarithmic},
                   key_size(titles, plot.key_title));
}

std::string key_text(const PlotSpec& plot, const std::string& place) {
  std::string text = "set key Left reverse samplen 2 spacing 1.2 noautotitle\n";
  text += fmt::format("set key {}\n", place);
  if (!plot.key_title.empty()) text += fmt::format("set key title {} left\n", gnuplot_string(plot.key_title));
  return text;
}

std::string reference_lines(const PlotSpec& plot) {
  std::string text;
  for (const LineSpec& line : plot.lines) {
    const std::string look =
        " with lines linewidth 1" + std::string(dotted) + " linecolor rgb '#777777'" + title_text(line.title);
    if (line.slope) text += fmt::format(", \\\n  {} * x{}", *line.slope, look);
    if (line.y) text += fmt::format(", \\\n  {}{}", *line.y, look);
  }
  return text;
}

/// The x axis of an inset. Limits that are not given come from the rows that the inset shows, with a margin.
AxisSpec inset_x(const PlotSpec& plot, FigureData& data) {
  AxisSpec axis = plot.inset->x;
  const SeriesSpec& s = plot.series.front();
  if (plot.inset->where.empty() || s.table.empty()) return axis;
  const TextTable& table = data.table(s.table);
  const std::size_t x = table.column(s.x, s.place);
  std::optional<double> low, high;
  for (const std::size_t row : table.rows_of(plot.inset->where, plot.place))
    if (const auto value = table.rows[row][x].number) {
      low = std::min(low.value_or(*value), *value);
      high = std::max(high.value_or(*value), *value);
    }
  if (!low) plot.place.fail(fmt::format("inset of plot '{}': no row lies inside it", plot.name));
  const double margin = 0.08 * (*high - *low);
  axis.low = axis.low.value_or((*low - margin) * s.x_scale);
  axis.high = axis.high.value_or((*high + margin) * s.x_scale);
  if (axis.ticks.empty() && *axis.high > *axis.low)
    axis.ticks = fmt::format("{:g}", tick_distance({*axis.low, *axis.high}, 3));
  return axis;
}

std::string surface_script(const PlotSpec& plot, FigureData& data, Script& script) {
  std::string text = R"(set xlabel rotate parallel offset 0,-0.5
set ylabel rotate parallel offset 0,-0.5
set zlabel rotate by 90 offset -1
set ticslevel 0
set border 4095 linewidth 0.6
set view 62,320
set key at screen 0.02,0.98 left top Left reverse samplen 2
)";
  std::string points;
  for (const SeriesSpec& s : plot.series) {
    if (s.table.empty()) {
      script.add(s);
      continue;
    }
    const std::string name = fmt::format("$points{}", points.size());
    text += fmt::format("{} << EOD\n{}EOD\n", name, surface_points(s, data));
    points += fmt::format(", \\\n  {} using 1:2:3 with points{}{}", name, line_style(s), title_text(s.title));
  }
  return script.blocks() + text + "splot " + script.drawings() + points + "\n";
}

} // namespace

std::string plot_script(const PlotSpec& plot, FigureData& data, const std::string& folder, const std::string& format,
                        const std::string& image, int packings, OtherResults* beside) {
  std::string text = terminal(format) + style + line_types() + fmt::format("set output {}\n", gnuplot_string(image));
  if (!plot.title.empty()) text += fmt::format("set title {}\n", gnuplot_string(plot.title));
  text += axis_text("x", plot.x) + axis_text("y", plot.y);
  if (plot.surface) text += axis_text("z", plot.z) + key_text(plot, "left top");
  Script script(plot, data, folder, packings);
  if (plot.surface) return text + surface_script(plot, data, script);
  for (const SeriesSpec& s : plot.series) script.add(s);
  if (beside != nullptr)
    for (const SeriesSpec& s : plot.series) script.add_beside(s, beside->data);
  if (script.empty()) return text + nothing_to_draw;
  text += key_text(plot, key_words(plot, script, beside));
  for (const LineSpec& line : plot.lines)
    if (line.x)
      text +=
          fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead{1} linecolor rgb '#777777'\n", *line.x, dotted);
  const bool palette =
      std::any_of(plot.series.begin(), plot.series.end(), [](const SeriesSpec& s) { return !s.colour_by.empty(); });
  if (palette)
    text += "set palette defined (0 '#c6dbef', 0.5 '#4292c6', 1 '#08306b')\nset cblabel " +
            gnuplot_string(plot.key_title) + "\nset colorbox user origin 0.90,0.2 size 0.02,0.6\n" +
            "set rmargin at screen 0.86\nunset key\n";
  text += script.blocks();
  if (plot.inset) text += "set multiplot\n";
  text += "plot " + script.drawings() + reference_lines(plot);
  if (script.has_beside()) text += ", \\\n  NaN with " + script.beside_sample() + title_text(beside->name);
  text += "\n";
  if (!plot.inset) return text;
  const InsetSpec& inset = *plot.inset;
  text += fmt::format("set origin {},{}\nset size {},{}\nset rmargin -1\nunset colorbox\nunset key\nunset title\n",
                      inset.place[0], inset.place[1], inset.place[2], inset.place[3]);
  text += "set tics font ',14'\nset object 1 rectangle from graph -0.16,-0.16 to graph 1.02,1.04 behind fillcolor rgb "
          "'white' fillstyle solid noborder\n";
  text += "set autoscale\nset xtics auto\nset ytics auto\n";
  return text + axis_text("x", inset_x(plot, data)) + axis_text("y", inset.y) + "replot\nunset multiplot\n";
}

} // namespace mpfem
