// Plots of a figure's file, and what other commands make: pictures and scripts.

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "common/trimmed.hpp"
#include "postproc/figure/read_specs.hpp"
#include "postproc/fits/fit.hpp"

namespace mpfem {

namespace {

/// A distance, or numbers in brackets, as gnuplot takes them.
bool are_ticks(std::string_view text) {
  const bool brackets = text.starts_with('(') && text.ends_with(')');
  if (brackets) text = text.substr(1, text.size() - 2);
  std::size_t numbers = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++numbers) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string number(trimmed(text.substr(begin, end - begin), " "));
    if (!Value::of_text(number).number) return false;
    begin = end + 1;
  }
  return brackets || numbers <= 3; // first, distance, last
}

/// Whether gnuplot takes a text as the format of an axis' numbers: after each "%" flags and a letter, or a second "%".
bool is_axis_format(const std::string& text) {
  for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 1)) {
    at = text.find_first_not_of("-+ #0123456789.'", at + 1);
    if (at == std::string::npos || std::string_view("fFeEgGxXoOtTlLsScbBPhH%").find(text[at]) == std::string_view::npos)
      return false;
  }
  return true;
}

/// Refuses what gnuplot does not take as the place of a key.
void check_key(TableReader& r, const std::string& key) {
  static const std::vector<std::string> known = {
      "left",    "right",   "center", "top",        "bottom",   "inside",  "outside",   "lmargin", "rmargin",
      "tmargin", "bmargin", "above",  "over",       "below",    "under",   "off",       "Left",    "Right",
      "reverse", "invert",  "width",  "horizontal", "vertical", "height",  "noreverse", "maxcols", "maxrows",
      "columns", "box",     "nobox",  "opaque",     "noopaque", "samplen", "spacing",   "noinvert"};
  std::istringstream words(key);
  for (std::string word; words >> word;)
    if (!Value::of_text(word).number && std::find(known.begin(), known.end(), word) == known.end())
      r.fail("key", fmt::format("found '{}'{}", one_line(word), suggestion(word, known)));
}

LineSpec read_line(TableReader line, const Words& words) {
  Texts t(line, words);
  LineSpec spec{t.number("y"), t.number("x"), t.number("slope"), t.shown("title")};
  const int given = int{spec.y.has_value()} + int{spec.x.has_value()} + int{spec.slope.has_value()};
  if (given != 1) Place(line, "").fail(fmt::format("lines: found {} of y, x and slope, allowed: one", given));
  line.finish();
  return spec;
}

AxisSpec read_axis(TableReader reader, const Words& words) {
  Texts t(reader, words);
  AxisSpec axis;
  axis.label = t.shown("label");
  axis.format = t.optional("format");
  if (!is_axis_format(axis.format))
    reader.fail("format", fmt::format("found '{}', allowed: a format such as '%.2f'", one_line(axis.format)));
  axis.ticks = t.optional("ticks");
  if (!axis.ticks.empty() && !are_ticks(axis.ticks))
    reader.fail("ticks", fmt::format("found '{}', allowed: a distance such as '0.1', or numbers in brackets such as "
                                     "'(1, 2, 5)'",
                                     one_line(axis.ticks)));
  axis.low = t.number("low");
  axis.high = t.number("high");
  axis.logarithmic = reader.boolean_or("logarithmic", false);
  if (axis.low && axis.high && *axis.low == *axis.high)
    reader.fail("high", fmt::format("found {:g}, as 'low', allowed: another value", *axis.high));
  for (const auto& [key, limit] : {std::pair{"low", axis.low}, std::pair{"high", axis.high}})
    if (axis.logarithmic && limit && *limit <= 0)
      reader.fail(key, fmt::format("found {:g} on a logarithmic axis, allowed: > 0", *limit));
  reader.finish();
  return axis;
}

/// `points_before`: number of series of points before this one in the plot.
SeriesSpec read_series(Texts& t, int points_before) {
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
    s.beside = r.boolean_or("beside", true);
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
  constexpr int colours = 8;
  s.colour =
      t.integer("colour", of_fit || !s.group.empty() ? 1 : points_before % colours + 1, Range::between(1, colours));
  s.point = t.integer("point", 0, Range::between(0, 15));
  s.width = r.number_or("width", 0, Range::non_negative());
  s.size = r.number_or("size", 1.5, Range::positive());
  s.dash = t.optional("dash", "solid");
  if (s.dash != "solid" && s.dash != "dashed" && s.dash != "dotted" && s.dash != "long")
    r.fail("dash", fmt::format("found '{}', allowed: 'solid', 'dashed', 'dotted', 'long'", s.dash));
  s.title = t.shown("title", s.group.empty() ? "" : "value");
  return s;
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
      const auto points_before =
          std::ranges::count_if(list, [](const SeriesSpec& before) { return !before.table.empty(); });
      list.push_back(read_series(both, static_cast<int>(points_before)));
    });
  return list;
}

/// A picture needs a run, a script may have one: `read_run` reads it accordingly.
CommandSpec read_command(Texts& t, std::string (*read_run)(Texts&)) {
  CommandSpec spec;
  spec.place = Place(t.reader(), "command");
  spec.name = t.required("name");
  spec.run = read_run(t);
  spec.command = t.required("command");
  spec.caption = t.optional("caption");
  spec.place_of_caption = Place(t.reader(), "caption");
  spec.series = t.list("series");
  spec.where = t.filters("where");
  return spec;
}

} // namespace

PlotSpec read_plot(Texts& t) {
  TableReader& r = t.reader();
  PlotSpec plot;
  plot.place = Place(r, "name");
  plot.name = t.name("name");
  plot.title = t.shown("title");
  plot.key = t.optional("key");
  check_key(r, plot.key);
  plot.key_title = t.shown("key_title");
  plot.caption = t.shown("caption");
  plot.x = read_axis(r.table("x"), t.words());
  plot.y = read_axis(r.table("y"), t.words());
  if (auto z = r.optional_table("z")) {
    plot.z = read_axis(*z, t.words());
    plot.surface = true;
  }
  plot.series = read_all_series(t);
  for (TableReader& line : r.tables("lines")) plot.lines.push_back(read_line(line, t.words()));
  if (auto inset = r.optional_table("inset")) plot.inset = read_inset(*inset, t.words());
  return plot;
}

PictureSpec read_picture(Texts& t) {
  return {read_command(t, [](Texts& texts) { return texts.required("run"); })};
}

ScriptSpec read_script(Texts& t) {
  ScriptSpec spec{read_command(t, [](Texts& texts) { return texts.optional("run"); }), {}};
  spec.needs = t.list("needs");
  return spec;
}

} // namespace mpfem
