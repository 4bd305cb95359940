// Figures declared in TOML: reading, runs, tables, statements, plots, and what make is told.

#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/figure/depends.hpp"
#include "postproc/figure/figure_plot.hpp"
#include "postproc/figure/filter_notes.hpp"
#include "postproc/files/gnuplot.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using Catch::Matchers::Contains;
using test::RunContents;
using test::small_run;
using test::within;
using test::write_run;
using test::write_text;

namespace {

/// A folder with the programmes "press" and "crush", and files of figures.
class Toolkit {
public:
  Toolkit() {
    write_text(folder_ / "programmes/press.toml", "[[stages]]\nname = \"pressing\"\n");
    write_text(folder_ / "programmes/crush.toml", "[[stages]]\nname = \"rest\"\n[[stages]]\nname = \"crushing\"\n");
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  Figure figure(const std::string& text, const std::string& name = "study.toml") const {
    write_text(path(name), text);
    return read_figure(path(name), path("programmes"));
  }
  ResultsFolder results() const { return {path("out"), "smoke"}; }

private:
  test::Folder folder_;
};

/// Two samples, pressed to two densities each and crushed.
const std::string tablets = R"(title = "tablets"
[[cases]]
sample = ["a", "b"]
density = [0.7, 0.85]
[[runs]]
name = "pressed"
folder = "{sample}"
programme = "press"
settings = { "bond.fracture_energy" = 0.5, "stages.0.wall_speed" = 1000 }
[[runs]]
name = "crushed"
programme = "crush"
from = "pressed@{density:.3f}"
settings = { "stages.1.wall_speed" = 500 }
[[tables]]
name = "strength"
row = "{sample}-{density:.2f}"
columns = ["density [1] = {density}", "strength [MPa] = crushed/strength.value"]
)";

std::string replace(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// A figure whose table `t` is what is given, and one statement.
nlohmann::ordered_json judged(const std::string& rows, const std::string& statement, const std::string& fits = "[]") {
  const Toolkit toolkit;
  const Figure figure =
      toolkit.figure("title = \"x\"\n[[cases]]\nx = 1\n[[tables]]\nname = \"t\"\nrow = \"r\"\n"
                     "columns = [\"x [1] = {x}\", \"y [1] = {x}\", \"g [1] = {x}\"]\n"
                     "[[fits]]\nname = \"line\"\ntable = \"t\"\nx = \"x\"\ny = \"y\"\nmodel = \"linear\"\n"
                     "[[statements]]\ntext = \"s\"\npaper = \"p\"\n" +
                     statement);
  write_text(toolkit.path("out/t.csv"), "name,x [1],y [1],g [1]\n" + rows);
  write_text(toolkit.path("out/fits.json"), fits);
  FigureData data(figure, toolkit.path("out"));
  return judge(figure.statements.front(), data);
}

/// What all cases of a figure need of one of its runs, as the mesh "smoke" has them.
RunGraph graph_of(const Figure& figure, const RunTemplate& run) {
  RunGraph graph;
  for (const Case& row : cases_of(figure, {}, {}, "smoke", {})) add_run(graph, figure, run, row);
  return graph;
}

const std::string rising = "a,1,2,0\nb,2,3,0\nc,3,5,1\n";
const std::string y_of_last = "ours = \"{y:.1f}\"\nquantities.y = { table = \"t\", column = \"y\", take = \"last\" }\n";

} // namespace

TEST_CASE("names in braces become values, numbers in the format given") {
  const Words words = {{"density", Value::of(0.7)},
                       {"law", {"energy", {}}},
                       {"share", Value::of(0.0123)},
                       {"cycles", Value::of(5380)},
                       {"many", Value::of(1.234e6)}};
  CHECK(filled("{law}-D{density:.2f}", words) == "energy-D0.70");
  CHECK(filled("{share:.2g%} of {{all}}", words) == "1.2 % of {all}");
  CHECK(filled("{cycles:.2g}, {cycles:+.2g}, {cycles:.1e}", words) == "5400, +5400, 5.4e+03");
  CHECK(filled("{cycles:.2g%}, {many:.3g}", words) == "540000 %, 1.23e+06");
  CHECK(filled("D^{max} {law}", words, Unknown::kept) == "D^{max} energy");
  CHECK_THROWS_WITH(filled("{densty}", words), Contains("did you mean 'density'?"));
  CHECK_THROWS_WITH(filled("{law} {density:.2f", words),
                    Contains("found '{density:.2f' without the brace that closes"));
  CHECK(filled("{law} {density", words, Unknown::kept) == "energy {density");
  CHECK_THROWS_WITH(filled("{law:.2f}", words), Contains("which has no format"));
  CHECK_THROWS_WITH(filled("{density:.2q}", words), Contains("found the format '.2q'"));
  CHECK(filled("{density:12.10f}", words) == "0.7000000000");
  for (const std::string format : {".999999999f", "999999999", ".100f", "100.2f"}) // these would take all memory
    CHECK_THROWS_WITH(filled("{density:" + format + "}", words), Contains("'" + format + "', allowed: width"));
}

TEST_CASE("a mistake in a figure's file is reported with file, line and the nearest word") {
  const Toolkit toolkit;
  CHECK_THROWS_WITH(toolkit.figure("tilte = \"x\"\n"),
                    Contains("key 'title': missing") && Contains("'tilte' in line 1"));
  CHECK_THROWS_WITH(toolkit.figure("title = \"x\"\n[[tables]]\nname = \"t\"\ncolumms = []\ncolumns = [\"a = {a}\"]\n"),
                    Contains("study.toml:4:1: unknown key 'tables.0.columms' (did you mean 'columns'?)"));
  CHECK_THROWS_WITH(toolkit.figure(tablets + "[[fits]]\nname = \"f\"\ntable = \"strength\"\nx = \"densty\"\n"
                                             "y = \"strength\"\nmodel = \"linear\"\n"),
                    Contains("table 'strength' has no column 'densty'; did you mean 'density'?"));
  CHECK_THROWS_WITH(toolkit.figure("title = \"x\"\n[[runs]]\nname = \"r\"\nprogramme = \"pres\"\n"),
                    Contains("study.toml:4") && Contains("did you mean 'press'?"));
  CHECK_THROWS_WITH(judged(rising, y_of_last + "require = [{ quantity = \"y\", nearly = 3 }]\n"),
                    Contains("no predicate, allowed: one of near"));
  CHECK_THROWS_WITH(toolkit.figure("title = \"x\"\n[[tables]]\nname = \"../t\"\ncolumns = [\"a = {a}\"]\n"),
                    Contains("found '../t', allowed: letters"));
  const std::string plot = tablets + "[[plots]]\nname = \"p\"\nx = { low = 2, high = 2 }\n";
  CHECK_THROWS_WITH(toolkit.figure(plot), Contains("key 'plots.0.x.high': found 2, as 'low'"));
  CHECK_THROWS_WITH(toolkit.figure(replace(plot, "low = 2, high = 2", "low = 0, logarithmic = true")),
                    Contains("found 0 on a logarithmic axis"));
  CHECK_THROWS_WITH(toolkit.figure(replace(tablets, "strength [MPa] =", "density [1] =")),
                    Contains("table 'strength' has the column 'density' twice"));
  CHECK_THROWS_WITH(judged(rising, y_of_last + "require = [{ quantity = \"y\", between = [3, 1] }]\n"),
                    Contains("found 3 before 1, allowed: the smaller one first"));
}

TEST_CASE("a run begins at a stage that its parent has, and no two runs begin at each other") {
  const Toolkit toolkit;
  const auto begin_at = [&](const std::string& from) {
    const Figure figure = toolkit.figure(replace(tablets, "pressed@{density:.3f}", from));
    return graph_of(figure, figure.runs[1]);
  };
  CHECK_NOTHROW(begin_at("pressed:pressing"));
  CHECK_THROWS_WITH(begin_at("pressed:presing"),
                    Contains("study.toml:") && Contains("press.toml has no stage 'presing'; did you mean 'pressing'?"));
  CHECK_THROWS_WITH(
      toolkit.figure(replace(tablets, "programme = \"press\"", "programme = \"press\"\nfrom = \"crushed\"")),
      Contains("from: found 'crushed', but that run begins in turn at 'pressed'"));
}

TEST_CASE("every combination of a case's values is a row, and runs that do not depend on a value are shared") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets);
  REQUIRE(cases_of(figure, {}, {}, "smoke", {}).size() == 4);
  const RunGraph graph = graph_of(figure, figure.runs[1]);
  REQUIRE(graph.size() == 6); // two pressed, four crushed
  CHECK(graph.at("a").densities == std::set<double>{0.7, 0.85});
  const RunInstance& crushed = graph.at("study/runs/crushed-b-0.85");
  CHECK(crushed.parent == "b");
  CHECK(crushed.checkpoint == "D0.850");
  // The sample's own settings first, but for its stages, then those of the test.
  CHECK(crushed.settings == Settings{{"bond.fracture_energy", "0.5"}, {"stages.1.wall_speed", "500"}});
}

TEST_CASE("a chain's runs begin where the one before in the list ended, the first at its parent") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(R"(title = "x"
[[cases]]
pressure = [60, 16, 8]
only = { pressure = 8 }
[[runs]]
name = "pressed"
programme = "press"
[[runs]]
name = "held"
folder = "p{pressure}"
programme = "crush"
from = "pressed"
chain = "pressure"
)");
  const auto cases = cases_of(figure, {}, {}, "smoke", {});
  REQUIRE(cases.size() == 1); // the others are on the way only
  RunGraph graph;
  CHECK(add_run(graph, figure, figure.runs[1], cases[0]).parent == "p16");
  CHECK(graph.at("p8").checkpoint == "crushing");
  CHECK(graph.at("p60").checkpoint == "pressing");
}

TEST_CASE("values follow from others, and settings can depend on a value that is not 0") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(R"(title = "x"
[follows.sample]
"loose" = { energy = 0 }
"bonded" = { energy = 0.5 }
[[cases]]
sample = ["loose", "bonded"]
[[runs]]
name = "pressed"
folder = "{sample}"
programme = "press"
[runs.settings_unless_zero.energy]
"bond.fracture_energy" = "{energy}"
)");
  const RunGraph graph = graph_of(figure, figure.runs[0]);
  CHECK(graph.at("loose").settings.empty());
  CHECK(graph.at("bonded").settings == Settings{{"bond.fracture_energy", "0.5"}});
}

TEST_CASE("an automatic folder name distinguishes runs that depend on a value through another one") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(R"(title = "x"
[follows.powder]
"soft" = { yield = 10 }
"hard" = { yield = 40 }
[[cases]]
powder = ["soft", "hard"]
seen = [1, 2]
[[runs]]
name = "pressed"
programme = "press"
settings = { "material.hardening.yield_stress" = "{yield}" }
)");
  const RunGraph graph = graph_of(figure, figure.runs[0]);
  REQUIRE(graph.size() == 2); // `seen` makes no run of its own
  CHECK(graph.contains("study/runs/pressed-soft"));
  CHECK(graph.contains("study/runs/pressed-hard"));
}

TEST_CASE("a value may follow from one that follows from another, whatever their names") {
  const Toolkit toolkit;
  for (const auto& [first, second] : {std::pair("a", "b"), std::pair("b", "a")}) {
    const Figure figure = toolkit.figure(fmt::format(R"(title = "x"
[follows.{0}]
"fine" = {{ {1} = "soft" }}
"rough" = {{ {1} = "hard" }}
[follows.{1}]
"soft" = {{ yield = 10 }}
"hard" = {{ yield = 40 }}
[[cases]]
{0} = ["fine", "rough"]
[[runs]]
name = "pressed"
programme = "press"
settings = {{ "material.hardening.yield_stress" = "{{yield}}" }}
)",
                                                     first, second));
    const RunGraph graph = graph_of(figure, figure.runs[0]);
    REQUIRE(graph.size() == 2);
    CHECK(graph.at("study/runs/pressed-fine").settings == Settings{{"material.hardening.yield_stress", "10"}});
    CHECK(graph.at("study/runs/pressed-rough").settings == Settings{{"material.hardening.yield_stress", "40"}});
  }
}

TEST_CASE("one folder for two different runs is refused, in one figure and in two") {
  const Toolkit toolkit;
  std::string text = tablets;
  text.replace(text.find("0.5,"), 4, "\"{density}\",");
  const Figure figure = toolkit.figure(text);
  RunGraph graph;
  CHECK_THROWS_WITH(
      [&] {
        for (const Case& row : cases_of(figure, {}, {}, "smoke", {})) add_run(graph, figure, figure.runs[0], row);
      }(),
      Contains("is that of two runs with different settings"));
  std::string other = tablets;
  other.replace(other.find("0.5,"), 4, "0.6,");
  CHECK_THROWS_WITH(make_rules({toolkit.figure(tablets), toolkit.figure(other, "other.toml")},
                               {toolkit.results(), "packing.h5", {}, {}}),
                    Contains("the run 'a' has other settings in another figure"));
}

TEST_CASE("make is told what a table, a metric and a run are made from, and rewrites settings only when they differ") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets);
  const DependsRequest request{toolkit.results(), "packing.h5", {}, {{"element.type", "tet4"}}};
  const std::string out = toolkit.path("out"), rules = make_rules({figure}, request);
  const std::string run = out + "/study/runs/crushed-a-0.7/run";
  CHECK_THAT(rules, Contains(fmt::format("{0}/a/run.h5: packing.h5 {0}/a/run.settings", out)));
  CHECK_THAT(rules, Contains(fmt::format("{0}.h5: {1}/a/run.h5 {0}.settings | packing.h5\n", run, out)));
  CHECK_THAT(rules, Contains(fmt::format("--from {}/a/work/run.D0.700.checkpoint.h5 --set 'packing=packing.h5' "
                                         "--set 'element.type=tet4'",
                                         out)));
  CHECK_THAT(rules, Contains("output.checkpoint_relative_densities=[0.700,0.850]"));
  CHECK_THAT(rules, Contains(fmt::format("{}.settings: FORCE", run)));
  const std::size_t at = rules.find(run + ".settings: private settings := ");
  REQUIRE(at != std::string::npos);
  const std::size_t begin = rules.find(":= ", at) + 3;
  write_text(run + ".settings", rules.substr(begin, rules.find('\n', begin) - begin + 1));
  CHECK_THAT(make_rules({figure}, request), !Contains(fmt::format("{}.settings: FORCE", run)));
}

TEST_CASE("what replaces a value of a scenario of the study's own is noted, unless that value counts") {
  const Toolkit toolkit;
  const std::string stages = "[[stages]]\nname = \"pressing\"\n", smooth = "[contact]\nsurface = \"smooth\"\n";
  write_text(toolkit.path("programmes/press.toml"), smooth + stages);
  write_text(toolkit.path("own.toml"), smooth + stages);
  write_text(toolkit.path("plain.toml"), stages);
  const auto notes = [&](const std::string& programme, const std::string& further = "") {
    std::string text = tablets;
    text.replace(text.find("\"press\""), 7, fmt::format("\"{}\"\n{}", programme, further));
    std::vector<std::string> found;
    DependsRequest request{toolkit.results(), "packing.h5", {}, {{"contact.surface", "facets"}}};
    request.programmes = toolkit.path("programmes");
    request.note = [&](const std::string& note) { found.push_back(note); };
    make_rules({toolkit.figure(text)}, request);
    return found;
  };
  CHECK(notes("own.toml") ==
        std::vector{toolkit.path("own.toml") + ": contact.surface = facets of make replaces \"smooth\"; "
                                               "common_settings = false in [[runs]] keeps it"});
  CHECK(notes("own.toml", "common_settings = false").empty());
  CHECK(notes("plain.toml").empty());
  CHECK(notes("press").empty()); // make chooses the surface of the studies' own scenarios
}

namespace {

/// A table of curves of one run, that of the sample a; `keys` of the table follow.
const std::string curves_of_a = R"(title = "x"
[[cases]]
sample = ["a"]
[[runs]]
name = "pressed"
folder = "{sample}"
programme = "press"
[[tables]]
name = "t"
curves = ["pressed"]
)";

void write_run_of_a(const Toolkit& toolkit, const RunContents& run) {
  std::filesystem::create_directories(toolkit.path("out/a"));
  write_run(toolkit.path("out/a/run.h5"), run);
}

} // namespace

TEST_CASE("a curve has the columns of the history and what follows from them, row by row") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(
      curves_of_a + R"(columns = ["p [MPa] = mean_stress", "ke [1] = kinetic_ratio", "axial [MPa] = axial_stress"])");
  RunContents run = small_run();
  write_run_of_a(toolkit, run);
  const TextTable table = make_table(figure, figure.tables[0], toolkit.results());
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[1][0].number == 5);
  CHECK(table.rows[0][1].number == 0); // nothing is stored or dissipated yet
  CHECK(within(*table.rows[1][1].number, 0.04 / 2, 1e-6));
  CHECK(within(*table.rows[2][1].number, 0.02 / 4, 1e-6));
  CHECK(within(*table.rows[2][2].number, 11.5, 1e-6));
  // Damage is internal energy too.
  run.numbers["/history/damage_dissipation"] = {0, 2, 4};
  write_run_of_a(toolkit, run);
  CHECK(within(*make_table(figure, figure.tables[0], toolkit.results()).rows[2][1].number, 0.02 / 8, 1e-6));
}

TEST_CASE("a curve over a metric that could not be measured has empty cells") {
  const Toolkit toolkit;
  const Figure figure =
      toolkit.figure(curves_of_a + R"(columns = ["p [1] = mean_stress over pressed/strength.value"])");
  write_run_of_a(toolkit, small_run());
  write_text(toolkit.path("out/a/strength.json"), R"({"value": null})");
  for (const auto& row : make_table(figure, figure.tables[0], toolkit.results()).rows) CHECK(row[0].text.empty());
}

TEST_CASE("a curve has the rows of the stages that its table lists") {
  const Toolkit toolkit;
  const auto stages_of_rows = [&](const std::string& stages) {
    const Figure figure = toolkit.figure(curves_of_a + "columns = [\"stage [1] = stage\"]\n" + stages);
    std::vector<double> rows;
    for (const auto& row : make_table(figure, figure.tables[0], toolkit.results()).rows) rows.push_back(*row[0].number);
    return rows;
  };
  write_text(toolkit.path("programmes/press.toml"), "[[stages]]\n[[stages]]\n[[stages]]\n[[stages]]\n");
  RunContents run = small_run(); // it has ended before the last stage
  run.numbers["/history/stage"] = {0, 1, 2};
  write_run_of_a(toolkit, run);
  CHECK(stages_of_rows("") == std::vector<double>{0, 1, 2});
  CHECK(stages_of_rows("stage = 1") == std::vector<double>{1});
  CHECK(stages_of_rows("stages = [0, -1]") == std::vector<double>{0, 2});
  CHECK_THROWS_WITH(stages_of_rows("stages = [0, 3]"), Contains("found 3, allowed: 0, 1, 2"));
  CHECK_THROWS_WITH(stages_of_rows("stages = []"), Contains("empty list"));
  CHECK_THROWS_WITH(stages_of_rows("stage = 0\nstages = [1]"), Contains("together with 'stage'"));
}

TEST_CASE("a curve has at most the points that its table allows, evenly spaced from the first to the last row") {
  const Toolkit toolkit;
  const std::string column = "columns = [\"p [MPa] = mean_stress\"]\n";
  write_run_of_a(toolkit, small_run());
  const auto stresses = [&](const std::string& points) {
    const Figure figure = toolkit.figure(curves_of_a + column + points);
    std::vector<double> numbers;
    for (const auto& row : make_table(figure, figure.tables[0], toolkit.results()).rows)
      numbers.push_back(*row[0].number);
    return numbers;
  };
  const std::vector<double> all = stresses("");
  REQUIRE(all.size() == 3);
  CHECK(stresses("points = 2") == std::vector<double>{all[0], all[2]});
  CHECK(stresses("points = 3") == all);
  CHECK(stresses("points = 1000") == all);
  CHECK_THROWS_WITH(stresses("points = 1"), Contains("points") && Contains("found 1"));
  CHECK_THROWS_WITH(
      toolkit.figure("title = \"x\"\n[[tables]]\nname = \"t\"\npoints = 5\ncolumns = [\"a [1] = {b}\"]\n"),
      Contains("points") && Contains("found without 'curves'"));
}

TEST_CASE("a table has the numbers of its runs, and an empty cell for what could not be measured") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets);
  const auto metric = [&](const std::string& name, const std::string& text) {
    write_text(toolkit.path(fmt::format("out/study/runs/crushed-{}/strength.json", name)), text);
  };
  metric("a-0.7", R"({"value": 0.30000000000000004})");
  metric("a-0.85", R"({"value": null})");
  metric("b-0.7", R"({"value": 2})");
  CHECK_THROWS_WITH(make_table(figure, figure.tables[0], toolkit.results()), Contains("b-0.85/strength.json: no such"));
  metric("b-0.85", R"({"valu": 2})");
  CHECK_THROWS_WITH(make_table(figure, figure.tables[0], toolkit.results()),
                    Contains("study.toml:") && Contains("has no key 'value'; did you mean 'valu'?"));
  metric("b-0.85", R"({"value": 4})");
  const TextTable table = make_table(figure, figure.tables[0], toolkit.results());
  REQUIRE(table.rows.size() == 4);
  CHECK(table.titles == std::vector<std::string>{"name", "density [1]", "strength [MPa]"});
  CHECK(table.rows[0][0].text == "a-0.70");
  CHECK(table.rows[0][2].text == "0.30000000000000004");
  CHECK(table.rows[1][2].text.empty());
  CHECK_FALSE(table.rows[1][2].number);
}

TEST_CASE("the spread over packings is the sample's mean and deviation, and a single one has no deviation") {
  const Toolkit toolkit;
  TableSpec spec;
  spec.row = "{sample}";
  spec.spread = {"y"};
  write_text(toolkit.path("one.csv"), "name,y [MPa]\na,1\nb,5\n");
  write_text(toolkit.path("two.csv"), "name,y [MPa]\na,3\nb,\n");
  const TextTable spread = spread_of(spec, {toolkit.path("one.csv"), toolkit.path("two.csv")});
  CHECK(spread.titles == std::vector<std::string>{"name", "packings", "y [MPa]", "y_deviation [MPa]"});
  CHECK(*spread.rows[0][2].number == 2);
  CHECK(*spread.rows[0][3].number == Approx(std::sqrt(2.0)).epsilon(1e-9));
  CHECK(spread.rows[1][1].text == "1");
  CHECK(spread.rows[1][3].text.empty());
}

TEST_CASE("rows of several packings belong together by name and by the values of their cases, in any order") {
  const Toolkit toolkit;
  const std::string table = R"(title = "x"
[[cases]]
p = [5, 10]
E = [1, 2]
[[runs]]
name = "r"
programme = "press"
[[tables]]
name = "t"
columns = ["p [MPa] = {p}", "E [MPa] = {E}", "y [1] = r/strength.value"]
spread = ["E", "y"]
)";
  const Figure figure = toolkit.figure(table);
  const std::vector<std::string> files = {toolkit.path("one.csv"), toolkit.path("two.csv")};
  write_text(files[0], "p [MPa],E [MPa],y [1]\n5,1,10\n5,2,20\n10,1,30\n");
  write_text(files[1], "p [MPa],E [MPa],y [1]\n10,1,34\n5,2,22\n5,1,16\n");
  const TextTable spread = spread_of(figure.tables[0], files);
  REQUIRE(spread.rows.size() == 3);
  CHECK(spread.rows[0][0].text == "5 1");
  const std::size_t y = spread.column("y");
  CHECK(*spread.rows[0][y].number == 13);
  CHECK(*spread.rows[1][y].number == 21);
  CHECK(*spread.rows[2][y].number == 32);
  write_text(files[0], "p [MPa],E [MPa],y [1]\n5,1,10\n5,1,20\n");
  CHECK_THROWS_WITH(spread_of(figure.tables[0], files), Contains("spread: found two rows '5 1', allowed: rows that"));
  const Figure alike = toolkit.figure(replace(table, "\"E [MPa] = {E}\", ", "\"E [MPa] = r/E.value\", "));
  CHECK_THROWS_WITH(make_rules({alike}, {toolkit.results(), "packing.h5", {}, {}}),
                    Contains("study.toml:10") && Contains("spread: found two rows"));
  const std::string nameless = replace(table, "{p}", "r/p.value");
  CHECK_THROWS_WITH(toolkit.figure(replace(nameless, "{E}", "r/E.value")),
                    Contains("spread: found rows that have no name, allowed: a table with 'row', a column 'name'"));
  const std::string with_curves = replace(table, "spread", "curves = [\"r\"]\nspread");
  CHECK_THROWS_WITH(toolkit.figure(replace(with_curves, "r/strength.value", "mean_stress")),
                    Contains("spread: found with 'curves'"));
}

TEST_CASE("a figure's fits leave empty rows out, and one that the points do not allow says why") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + "[[fits]]\nname = \"line\"\ntable = \"strength\"\nx = \"density\"\n"
                                                 "y = \"strength\"\nmodel = \"linear\"\n");
  write_text(toolkit.path("out/strength.csv"), "name,density [1],strength [MPa]\na,1,3\nb,2,\nc,3,7\nd,4,9\n");
  const auto fits = make_fits(figure, toolkit.path("out"));
  CHECK(fits[0]["points"] == 3);
  CHECK(fits[0]["coefficients"]["b"]["value"].get<double>() == Approx(2).epsilon(1e-12));
  CHECK(fits[0]["y"]["unit"] == "MPa");
  write_text(toolkit.path("out/strength.csv"), "name,density [1],strength [MPa]\na,1,3\nb,2,\n");
  CHECK_THAT(make_fits(figure, toolkit.path("out"))[0]["refused"].get<std::string>(), Contains("found 1 points"));
}

TEST_CASE("predicates judge by number, by other quantities, by order and by interval") {
  const auto agrees = [](const std::string& condition) {
    return judged(rising, y_of_last +
                              "quantities.first = { table = \"t\", column = \"y\", take = \"first\" }\n"
                              "quantities.ratio = { of = \"y\", over = \"first\" }\nrequire = [{ " +
                              condition + " }]\n")["agrees"];
  };
  CHECK(agrees("quantity = \"y\", near = 5.4, within = 0.1") == true);
  CHECK(agrees("quantity = \"y\", near = 5.6, within = 0.1") == false);
  CHECK(agrees("quantity = \"y\", near = 5.4, within_absolute = 0.3") == false);
  CHECK(agrees("quantity = \"y\", at_least = 5") == true);
  CHECK(agrees("quantity = \"y\", above = 5") == false);
  CHECK(agrees("quantity = \"y\", above = \"first\"") == true);
  CHECK(agrees("quantity = \"ratio\", between = [2.4, 2.6]") == true);
  CHECK(agrees("quantity = \"y\", rises = true") == true);
  CHECK(agrees("quantity = \"y\", falls = true") == false);
  CHECK(agrees("ordered = [\"first\", 4, \"y\"]") == true);
  CHECK(agrees("ordered = [\"y\", \"first\"]") == false);
  CHECK(agrees("either = [{ quantity = \"y\", below = 1 }, { quantity = \"y\", at_most = 5 }]") == true);
  const std::string fits = R"([{"name": "line", "model": "linear", "points": 3, "r_squared": 0.9,
    "coefficients": {"b": {"value": 1.5, "low": 1.0, "high": 2.0}}}])";
  const auto of_fit = [&](const std::string& condition) {
    return judged(rising,
                  "ours = \"{b:.1f} [{b.low:.1f}, {b.high:.1f}]\"\nquantities.b = { fit = \"line\", "
                  "coefficient = \"b\" }\nrequire = [{ quantity = \"b\", " +
                      condition + " }]\n",
                  fits);
  };
  CHECK(of_fit("interval_includes = 1.9")["agrees"] == true);
  CHECK(of_fit("interval_excludes = 1.9")["agrees"] == false);
  CHECK(of_fit("interval_width_at_most = 0.5")["agrees"] == false);
  CHECK(of_fit("above = 0")["ours"] == "1.5 [1.0, 2.0]");
}

TEST_CASE("names that a statement, fit, plot or table misspells are found before anything is run") {
  const Toolkit toolkit;
  const auto refused = [&](const std::string& more, const std::string& message) {
    CAPTURE(more);
    CHECK_THROWS_WITH(toolkit.figure(tablets + more), Contains("study.toml:") && Contains(message));
  };
  const std::string fit = "[[fits]]\nname = \"f\"\ntable = \"strength\"\nx = \"density\"\ny = \"strength\"\n"
                          "model = \"linear\"\n";
  refused(fit + "where = { densty = 1 }\n", "has no column 'densty'; did you mean 'density'?");
  const std::string plot = "[[plots]]\nname = \"p\"\nx = {}\ny = {}\n";
  refused(plot + "series = [{ model = { name = \"linear\", a = 1 } }]\n", "found no coefficient 'b', allowed: a, b");
  refused(plot + "series = [{ model = { name = \"linear\", a = 1, b = 2, c = 3 } }]\n", "found the coefficient 'c'");
  refused(plot + "series = [{ table = \"strength\", x = \"density\", y = \"strength\" }]\ninset = { x = {}, y = {}, "
                 "place = [0, 0, 1, 1], where = { densty = 1 } }\n",
          "has no column 'densty'");
  refused(plot + "series = [{ table = \"strength\", x = \"density\", y = \"strength\", spread = true }]\n",
          "spread: found true, but 'spread' of the table 'strength' has no column 'density'");
  refused("[[tables]]\nname = \"t\"\nlist = \"pressed\"\ncolumns = [\"x [1] = y\"]\n",
          "list: found 'pressed', allowed: RUN/METRIC");
  refused("[[tables]]\nname = \"t\"\ncolumns = [\"x [1] = pressed/strength.value:.2q\"]\n", "found the format '.2q'");
  const auto statement = [&](const std::string& rest) {
    return fit +
           "[[statements]]\ntext = \"s\"\npaper = \"p\"\n"
           "quantities.y = { table = \"strength\", column = \"strength\", take = \"last\" }\n"
           "quantities.b = { fit = \"f\", coefficient = \"b\" }\n" +
           rest;
  };
  CHECK_NOTHROW(toolkit.figure(tablets + statement("ours = \"{y:.2f} at {y.row}, {y.rises}, {b.low:.1f}\"\n")));
  for (const auto& [rest, message] : std::vector<std::pair<std::string, std::string>>{
           {"ours = \"{z:.2f}\"\n", "found '{z:.2f}', allowed: "},
           {"ours = \"{y:.2f\"\n", "found '{y:.2f' without"},
           {"ours = \"{y:.2q}\"\n", "found the format '.2q'"},
           {"ours = \"{y.row:.2f}\"\n", "which has no format"},
           {"ours = \"{y.low:.2f}\"\n", "found '{y.low:.2f}'"},
           {"ours = \"o\"\nnote = \"{z}\"\n", "found '{z}'"},
           {"ours = \"o\"\nwhy = \"{z}\"\n", "found '{z}'"},
           {"ours = \"o\"\nunjudged = { ours = \"{z}\" }\n", "found '{z}'"},
           {"ours = \"o\"\nrequire = [{ quantity = \"z\", above = 0 }]\n", "there is no quantity 'z'"},
           {"ours = \"o\"\nrequire = [{ quantity = \"y\", above = \"z\" }]\n", "there is no quantity 'z'"},
           {"ours = \"o\"\njudged_if = [{ ordered = [\"y\", \"z\"] }]\n", "there is no quantity 'z'"},
           {"ours = \"o\"\nrequire = [{ either = [{ quantity = \"z\", above = 0 }] }]\n", "there is no quantity 'z'"},
           {"ours = \"o\"\nquantities.r = { of = \"y\", over = \"z\" }\n", "there is no quantity 'z'"},
           {"ours = \"o\"\nquantities.r = { of = \"r\" }\n", "there is no quantity 'r' here or above"},
           {"ours = \"o\"\nrequire = [{ quantity = \"y\", interval_includes = 0 }]\n", "so it has no interval"},
           {"ours = \"o\"\nrequire = [{ quantity = \"b\", rises = true }]\n", "is not a column of a table"},
           {"ours = \"o\"\nrequire = [{ quantity = \"y\", rises = true, along = \"d\" }]\n", "has no column 'd'"},
           {"ours = \"o\"\nrequire = [{ quantity = \"y\", falls = true, each = \"d\" }]\n", "has no column 'd'"},
           {"ours = \"o\"\nquantities.c = { fit = \"f\", coefficient = \"c\" }\n",
            "has no coefficient 'c', allowed: a, b"},
           {"ours = \"o\"\nquantities.l = { table = \"strength\", column = \"strength\", take = \"list\", "
            "item = \"{densty}\" }\n",
            "found '{densty}'"},
           {"ours = \"o\"\nquantities.q = { table = \"strength\", column = \"strength\", by = \"density\", "
            "relative_to = { densty = 1 } }\n",
            "has no column 'densty'"}})
    refused(statement(rest), message);
}

TEST_CASE("a rise with noise holds within its tolerance, sorted along a column and within equal rows of another") {
  const auto agrees = [](const std::string& rows, const std::string& more) {
    return judged(rows, y_of_last + "require = [{ quantity = \"y\", rises = true" + more + " }]\n")["agrees"];
  };
  const std::string noisy = "a,1,100,0\nb,2,99.5,0\nc,3,120,0\n";
  CHECK(agrees(noisy, "") == false);
  CHECK(agrees(noisy, ", tolerance = 0.01") == true);
  CHECK(agrees(noisy, ", tolerance = 0.001") == false);
  CHECK(agrees("a,3,5,0\nb,1,2,0\nc,2,3,0\n", ", along = \"x\"") == true);
  CHECK(agrees("a,1,5,0\nb,1,2,1\nc,2,6,0\nd,2,3,1\n", ", along = \"x\", each = \"g\"") == true);
}

TEST_CASE(
    "a trend is not judged where no two rows can be compared, and rows without a place in its order do not count") {
  const auto verdict = [](const std::string& rows, const std::string& more) {
    return judged(rows, "ours = \"{y.rises}, {y.falls}\"\nquantities.y = { table = \"t\", column = \"y\", take = "
                        "\"list\" }\nrequire = [{ quantity = \"y\", " +
                            more + " }]\n");
  };
  for (const std::string trend : {"rises = true", "falls = true"}) {
    CHECK(verdict("a,1,5,0\n", trend)["agrees"].is_null());
    CHECK(verdict("a,1,,0\nb,2,,0\n", trend)["agrees"].is_null());
    CHECK(verdict("a,1,5,0\nb,2,6,1\n", trend + ", each = \"g\"")["agrees"].is_null());
    CHECK(verdict("a,1,5,0\nb,,6,0\n", trend + ", along = \"x\"")["agrees"].is_null());
  }
  CHECK(verdict("a,1,5,0\n", "rises = true")["ours"] == "not known, not known");
  CHECK(verdict("a,1,5,0\nb,2,6,0\nc,,1,0\n", "rises = true, along = \"x\"")["agrees"] == true);
  CHECK(verdict("a,-1,5,0\nb,1,6,0\nc,,7,0\n", "rises = true, along = \"x\"")["agrees"] == true);
  CHECK_THROWS_WITH(verdict("a,1,5,0\nb,2,6,0\n", "rises = true, along = \"name\""),
                    Contains("study.toml:") &&
                        Contains("found 'a' in the column 'name', allowed: finite numbers and empty cells"));
}

TEST_CASE(
    "a statement is not judged where a quantity is unknown, a condition of judged_if fails, or only refuting counts") {
  CHECK(judged("a,1,,0\n", y_of_last + "require = [{ quantity = \"y\", above = 0 }]\n")["agrees"].is_null());
  CHECK(judged("a,1,,0\n", y_of_last + "require = [{ quantity = \"y\", above = 0 }]\n")["ours"] == "not known");
  const std::string met = "require = [{ quantity = \"y\", above = 0 }]\n",
                    failed = "require = [{ quantity = \"y\", below = 0 }]\n";
  CHECK(judged(rising, y_of_last + met + "judged_if = [{ quantity = \"y\", above = 9 }]\n")["agrees"].is_null());
  CHECK(judged(rising, y_of_last + met + "only_refutes = true\n")["agrees"].is_null());
  CHECK(judged(rising, y_of_last + failed + "only_refutes = true\n")["agrees"] == false);
  CHECK_THROWS_WITH(judged(rising, "ours = \"{y}\"\nquantities.y = { table = \"t\", column = \"y\" }\n" + met),
                    Contains("3 rows of table 't' match, allowed: one"));
}

TEST_CASE("values are compared row by row with those of another sample, and rows without partner are left out") {
  const auto verdict = judged("a,1,2,0\nb,2,3,0\nc,1,4,1\nd,3,9,1\n",
                              "ours = \"{r}\"\nquantities.r = { table = \"t\", column = \"y\", take = \"list\", item = "
                              "\"{value:.1f} at {x}\", where = { g = 1 }, relative_to = { g = 0 }, by = \"x\" }\n");
  CHECK(verdict["ours"] == "2.0 at 1");
}

TEST_CASE("a group's name is drawn letter by letter, a series' title with its markup") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + R"([[plots]]
name = "p"
x = { label = "D" }
y = { label = "s" }
series = [{ table = "strength", x = "density", y = "strength", group = "name", title = "G^c {value}" }]
)");
  const std::string folder = toolkit.path("out");
  write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\non_contact,1,3\n");
  FigureData data(figure, folder);
  CHECK_THAT(plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0), Contains("title 'G^c on\\_contact'"));
}

TEST_CASE("a value of where that no row has is named with the values that there are") {
  const Toolkit toolkit;
  const auto notes = [&](const std::string& where, const std::string& rows, const std::string& cases = tablets) {
    const Figure figure = toolkit.figure(cases + R"([[plots]]
name = "p"
x = {}
y = {}
series = [{ table = "strength", x = "density", y = "strength", where = { )" +
                                         where + R"( } }]
[[fits]]
name = "line"
table = "strength"
x = "density"
y = "strength"
model = "linear"
where = { )" + where + R"( }
[[statements]]
text = "s"
paper = "p"
ours = "{y}"
quantities.y = { table = "strength", column = "strength", where = { )" +
                                         where + R"( } }
)");
    write_text(toolkit.path("out/strength.csv"), "name,density [1],strength [MPa]\n" + rows);
    FigureData data(figure, toolkit.path("out"));
    const std::vector<std::string> of_plot = notes_on_plot(figure.plots[0], data), of_fits = notes_on_fits(data),
                                   of_statements = notes_on_statements(data, "smoke");
    CHECK(of_plot.size() == of_fits.size());
    CHECK(of_plot.size() == of_statements.size());
    return of_plot;
  };
  const std::string rows = "a-0.70,0.7,3\na-0.85,0.85,4\n";
  const auto wrong = notes("density = 0.8", rows);
  REQUIRE(wrong.size() == 1);
  CHECK_THAT(wrong[0], Contains("study.toml:23:") && Contains("plot 'p', strength over density: where: no row of the "
                                                              "table 'strength' has density = 0.8, found: 0.7, 0.85"));
  CHECK_THAT(notes("name = \"a\"", rows).at(0), Contains("has name = a, found: a-0.70, a-0.85"));
  CHECK(notes("density = [0.7, 0.9, 0.85]", rows).size() == 1);
  CHECK(notes("density = 0.7", rows).empty());
  CHECK(notes("density = { at_least = 0.9 }", rows).empty());
  CHECK(notes("strength = 8", rows).empty());               // a metric's number
  CHECK(notes("density = 0.85", "a-0.70,0.7,3\n").empty()); // another mesh has it, or it has not been made
  CHECK(notes("density = 0.8", "").empty());
  CHECK(notes("density = 0.8", "a,0.7,3\nb,,4\n").empty());
  const std::string fine = replace(tablets, "density = [0.7, 0.85]",
                                   "density = 0.7\n[[cases]]\nsample = \"a\"\n"
                                   "meshes = [\"fine\"]\ndensity = 0.8");
  CHECK(notes("density = 0.8", "a-0.70,0.7,3\n", fine).empty());
  // A table that a script makes has values of the cases under names of its own.
  const std::string made =
      replace(tablets,
              "row = \"{sample}-{density:.2f}\"\ncolumns = [\"density [1] = {density}\", "
              "\"strength [MPa] = crushed/strength.value\"]",
              "file = \"strength.csv\"\ncolumns = [\"name\", \"density [1]\", \"strength [MPa]\"]");
  CHECK(notes("name = \"b\"", "a,0.7,3\n", made).empty());
  CHECK(notes("name = \"c\"", "a,0.7,3\n", made).size() == 1);
}

TEST_CASE("a value of where or keep that no case or row has is named when the table is made") {
  const Toolkit toolkit;
  const auto table_notes = [&](const std::string& selection) {
    const Figure figure = toolkit.figure(tablets +
                                         "[[tables]]\nname = \"d\"\nrow = \"{sample}\"\ncolumns = "
                                         "[\"density [1] = {density}\"]\n" +
                                         selection + "\n");
    return make_table(figure, figure.tables[1], toolkit.results()).notes;
  };
  CHECK_THAT(table_notes("where = { density = 0.8 }").at(0),
             Contains("study.toml:") && Contains("table 'd': where: no case has density = 0.8, found: 0.7, 0.85"));
  CHECK_THAT(table_notes("keep = { density = 0.8 }").at(0), Contains("table 'd': keep: no row of the table 'd' has"));
  CHECK(table_notes("where = { density = 0.85 }\nkeep = { density = 0.85 }").empty());
}

TEST_CASE("a name in braces that nothing fills in is refused where a title, a label or a caption has it") {
  const Toolkit toolkit;
  const auto plot = [&](const std::string& keys, const std::string& series = "", const std::string& label = "y") {
    return toolkit.figure(tablets + "[[plots]]\nname = \"p\"\nx = {}\ny = { label = \"" + label + "\" }\n" + keys +
                          "series = [{ table = \"strength\", x = \"density\", y = \"strength\"" + series + " }]\n");
  };
  for (const char* key : {"title", "key_title", "caption"})
    CHECK_THROWS_WITH(plot(fmt::format("{} = \"of {{sampel}}\"\n", key)),
                      Contains("study.toml:23:") && Contains(fmt::format("key 'plots.0.{}'", key)) &&
                          Contains("found '{sampel}', allowed: no names here"));
  CHECK_THROWS_WITH(plot("", "", "D of {density:.2f}"), Contains("found '{density:.2f}', allowed: no names"));
  CHECK_THROWS_WITH(plot("lines = [{ y = 1, title = \"{limit}\" }]\n"), Contains("found '{limit}'"));
  CHECK_THROWS_WITH(plot("for_each = [{ law = \"a\" }]\ncaption = \"{law} {lwa}\"\n"),
                    Contains("found '{lwa}', allowed: {law}"));
  // A series' value is known where its rows are grouped.
  CHECK_THROWS_WITH(plot("", ", title = \"D = {value}\""), Contains("found '{value}', allowed: no names here"));
  CHECK_NOTHROW(plot("", ", group = \"density\", title = \"D = {value:.2f}\""));
  CHECK_THROWS_WITH(plot("", ", group = \"density\", title = \"{vale}\""), Contains("'{vale}', allowed: {value}"));
  // Braces of gnuplot are no names.
  for (const char* label : {"v / mm s^{-1}", "D_r^{max}", "σ_{zz}", "{/Symbol s} / MPa", "a {{b}}", "x {0.5} {", "{}"})
    CHECK(plot("", "", label).plots[0].y.label == label);
}

TEST_CASE("a name that no case has is refused in a picture's caption, and in a statement, before anything is made") {
  const Toolkit toolkit;
  const std::string picture = "[[pictures]]\nname = \"{sample}.png\"\nrun = \"pressed\"\ncommand = \"section {run}\"\n";
  CHECK_NOTHROW(toolkit.figure(tablets + picture + "caption = \"{sample} at {density:.2f}, {MESH}\"\n"));
  CHECK_THROWS_WITH(toolkit.figure(tablets + picture + "caption = \"{sampel}\"\n"),
                    Contains("study.toml:23:") && Contains("found '{sampel}', did you mean 'sample'?"));
  CHECK_THROWS_WITH(toolkit.figure(tablets + "[[statements]]\ntext = \"of {law}\"\npaper = \"\"\nours = \"\"\n"),
                    Contains("key 'statements.0.text'") && Contains("found '{law}', allowed: no names here"));
}

TEST_CASE("a plot draws the points with their errors, a curve of the fit, and says where nothing could be measured") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + R"([[fits]]
name = "line"
table = "strength"
x = "density"
y = "strength"
model = "linear"
[[plots]]
name = "p"
x = { label = "it's D", low = 0.5 }
y = { label = "s", logarithmic = true }
series = [
  { table = "strength", x = "density", y = "strength", error = "density", y_scale = 10, title = "computed" },
  { table = "strength", x = "density", y = "strength", error = "density", style = "linespoints", title = "joined" },
  { fit = "line", to = 2, dash = "dashed" },
]
)");
  const std::string folder = toolkit.path("out");
  write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\na,1,3\nb,2,\n");
  write_text(folder + "/fits.json",
             R"([{"name": "line", "model": "linear", "relative_density": false, "x": {"range": [1, 1.5]},
    "coefficients": {"a": {"value": 1}, "b": {"value": 2}}}])");
  FigureData data(figure, folder);
  const std::string script = plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0);
  CHECK_THAT(script, Contains("set xlabel 'it''s D'") && Contains("set logscale y") && Contains("set xrange [0.5:*]"));
  CHECK_THAT(script, Contains("1 30 10 \n2 NaN 20 \n"));
  CHECK_THAT(script, Contains("using 1:2:3 with yerrorbars linetype 1") && Contains("title 'computed'"));
  CHECK_THAT(script, Contains("with yerrorlines linetype") && Contains("title 'joined'"));
  CHECK_THAT(script, Contains("\n2 5\nEOD") && Contains("dashtype (12, 10)"));
  // Of other results, the points.
  write_text(toolkit.path("other") + "/strength.csv", "name,density [1],strength [MPa]\na,1,4\n");
  OtherResults other{"finer", FigureData(figure, toolkit.path("other"))};
  const std::string both = plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0, &other);
  CHECK_THAT(both, Contains("1 30 10 \n2 NaN 20 \n") && Contains("EOD\n1 40 \nEOD"));
  CHECK_THAT(both, Contains("linetype 1 dashtype (12, 10) pointtype 6") && Contains("title 'finer'"));
  CHECK(script.find("finer") == std::string::npos);
  // The key shows a line only where there is one.
  CHECK_THAT(both, Contains("NaN with linespoints"));
  PlotSpec loose = figure.plots[0];
  std::erase_if(loose.series, [](const SeriesSpec& s) { return s.style.find("lines") != std::string::npos; });
  REQUIRE_FALSE(loose.series.empty());
  CHECK_THAT(plot_script(loose, data, folder, "svg", "p.svg", 0, &other), Contains("NaN with points linetype 8"));
  OtherResults nothing{"nothing", FigureData(figure, toolkit.path("nothing"))};
  CHECK(plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0, &nothing) == script);
  write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\na,,\n");
  write_text(folder + "/fits.json", R"([{"name": "line", "refused": "too few points"}])");
  FigureData empty(figure, folder);
  const std::string nothing_drawn = plot_script(figure.plots[0], empty, folder, "svg", folder + "/p.svg", 0);
  CHECK_THAT(nothing_drawn, Contains("none of these values could be measured") && Contains("plot NaN notitle"));
  CHECK_NOTHROW(run_gnuplot(nothing_drawn));
}

TEST_CASE("the spread over packings is drawn for the rows that a series shows") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(replace(tablets, "columns", "spread = [\"density\", \"strength\"]\ncolumns") +
                                       R"([[plots]]
name = "p"
x = { label = "D" }
y = { label = "s" }
[[plots.series]]
table = "strength"
x = "density"
y = "strength"
spread = true
where = { strength = { at_least = 4 } }
)");
  const std::string folder = toolkit.path("out");
  write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\na,1,3\nb,2,5\n");
  write_text(folder + "/strength.spread.csv", "name,packings,density [1],density_deviation [1],strength [MPa],"
                                              "strength_deviation [MPa]\na,2,1,0,3.5,0.1\nb,2,2,0,5.5,0.2\n");
  FigureData data(figure, folder);
  const std::string script = plot_script(figure.plots[0], data, folder, "svg", "p.svg", 2);
  CHECK_THAT(script, Contains("<< EOD\n2 5.5 0.2\nEOD"));
  write_text(folder + "/strength.spread.csv", "name,packings,density [1],density_deviation [1],strength [MPa],"
                                              "strength_deviation [MPa]\na,2,1,0,3.5,0.1\n");
  CHECK_THROWS_WITH(plot_script(figure.plots[0], data, folder, "svg", "p.svg", 2),
                    Contains("strength.spread.csv has 1 rows, allowed: 2, as in the table 'strength'"));
}

TEST_CASE("a point whose error is not known is drawn without a bar, the others with theirs") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + R"([[plots]]
name = "p"
x = { label = "D" }
y = { label = "s" }
series = [
  { table = "strength", x = "density", y = "density", error = "strength", title = "loose" },
  { table = "strength", x = "density", y = "density", error = "strength", style = "linespoints", title = "joined" },
]
)");
  const std::string folder = toolkit.path("out");
  const auto script_of = [&](const std::string& rows) {
    write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\n" + rows);
    FigureData data(figure, folder);
    return plot_script(figure.plots[0], data, folder, "svg", folder + "/p.svg", 0);
  };
  const std::string some = script_of("a,1,3\nb,2,\nc,,\n");
  CHECK_THAT(some, Contains("$data1 << EOD\n1 1 3 \n2 2 NaN \nNaN NaN NaN \nEOD") &&
                       Contains("$data1 using 1:2 with points linetype 1 pointsize") && Contains("title 'loose'"));
  CHECK_THAT(some, Contains("$data2 << EOD\n1 1 3 \nEOD") &&
                       Contains("$data2 using 1:2:3 with yerrorbars linetype 1 pointsize"));
  CHECK_THAT(some, Contains("$data3 using 1:2 with linespoints linetype") && Contains("title 'joined'"));
  CHECK_NOTHROW(run_gnuplot(some));
  CHECK_THAT(script_of("a,1,\nb,2,\n"), !Contains("yerror"));
  CHECK_THAT(script_of("a,1,\nc,,\n"), !Contains("yerror"));
  CHECK_THAT(script_of("a,1,3\nb,2,0\nc,,\n"),
             !Contains("using 1:2 with") && Contains("with yerrorlines") && Contains("2 2 0 \n"));
}

TEST_CASE("a cell that is no number is refused where a fit, a plot or a statement needs one") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + R"([[fits]]
name = "line"
table = "strength"
x = "density"
y = "strength"
model = "linear"
[[plots]]
name = "p"
x = {}
y = {}
series = [{ table = "strength", x = "density", y = "strength" }]
[[statements]]
text = "s"
paper = "p"
ours = "{y:.1f}"
quantities.y = { table = "strength", column = "strength", take = "largest" }
)");
  const std::string folder = toolkit.path("out");
  for (const std::string cell : {"abc", "nan", "inf", "1 2"}) {
    CAPTURE(cell);
    write_text(folder + "/strength.csv", "name,density [1],strength [MPa]\na,1,3\nb,2,4\nc,3,5\nd,4," + cell + "\n");
    const auto refusal =
        Contains("strength.csv: found '" + cell + "' in the column 'strength', allowed: finite numbers");
    FigureData data(figure, folder);
    CHECK_THROWS_WITH(make_fits(figure, folder), Contains("study.toml:") && refusal);
    CHECK_THROWS_WITH(plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0), refusal);
    CHECK_THROWS_WITH(judge(figure.statements[0], data), refusal);
  }
}

TEST_CASE("series of points differ in colour, also where none is given") {
  const Toolkit toolkit;
  const Figure figure = toolkit.figure(tablets + R"([[plots]]
name = "p"
x = {}
y = {}
series = [
  { table = "strength", x = "density", y = "strength" },
  { model = { name = "linear", a = 0, b = 1 } },
  { table = "strength", x = "density", y = "strength" },
  { table = "strength", x = "density", y = "strength", colour = 7 },
  { table = "strength", x = "density", y = "strength" },
]
)");
  std::vector<int> colours;
  for (const SeriesSpec& series : figure.plots[0].series) colours.push_back(series.colour);
  CHECK(colours == std::vector<int>{1, 1, 2, 7, 4});
}

TEST_CASE("every model is drawn with the coefficients that its fit gives, which have the names that are known") {
  const std::vector<double> x = {0.1, 0.15, 0.2, 0.3, 0.35, 0.4, 0.45}, z = {0, 0.1, 0.3, 0, 0.1, 0.3, 0.5};
  for (const std::string& model : fit_models()) {
    FitPoints points;
    points.x = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      points.y.push_back(0.5 - 0.3 * std::exp(-x[i] / 0.2) * std::exp(-z[i] / 0.2));
    if (model == "pc-gc-surface") points.z = z;
    CAPTURE(model);
    const Fit fitted = fit(model, points);
    std::map<std::string, double> coefficients;
    for (const Coefficient& c : fitted.coefficients) coefficients[c.name] = c.value;
    std::set<std::string> names, derived;
    for (const auto& [name, value] : coefficients) names.insert(name);
    for (const Coefficient& c : fitted.derived) derived.insert(c.name);
    const auto known = coefficients_of(model), known_derived = derived_of(model);
    CHECK(names == std::set<std::string>(known.begin(), known.end()));
    CHECK(derived == std::set<std::string>(known_derived.begin(), known_derived.end()));
    CHECK(model_with(model, coefficients, false)(0.27, 0.2) == Approx(fitted.at(0.27, 0.2)).epsilon(1e-12));
  }
}
