// Where a figure's tables come from beside its own runs: packings, scripts, other files, other meshes; and which
// parents are made again.

#include <filesystem>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/figure/depends.hpp"
#include "postproc/figure/figure_plot.hpp"
#include "postproc/figure/other_studies.hpp"
#include "postproc/figure/powder_text.hpp"
#include "postproc/figure/report.hpp"
#include "postproc/figure/verdict_pages.hpp"
#include "postproc/files/gnuplot.hpp"
#include "run_postproc.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using Catch::Matchers::Contains;
using test::write_text;

namespace {

/// A folder of figures "study.toml", with the programme "press" beside.
class Studies {
public:
  Studies() { write_text(folder_ / "programmes/press.toml", "[[stages]]\nname = \"pressing\"\n"); }
  std::string path(const std::string& name) const { return folder_ / name; }
  Figure figure(const std::string& text) const {
    write_text(path("study.toml"), "title = \"x\"\n" + text);
    return read_figure(path("study.toml"), path("programmes"));
  }
  ResultsFolder results() const { return {path("out"), "coarse"}; }
  std::string rules(const Figure& figure, const std::vector<std::string>& commands = {}) const {
    return make_rules({figure}, {results(), path("packings/mesh-0.03.h5"), "powder.toml", {}, commands});
  }

private:
  test::Folder folder_;
};

const std::string chain = R"([[cases]]
x = 1
[[runs]]
name = "first"
folder = "first"
programme = "press"
[[runs]]
name = "second"
folder = "second"
programme = "press"
from = "first"
[[runs]]
name = "third"
folder = "third"
programme = "press"
from = "second"
[[tables]]
name = "t"
columns = ["y = third/strength.value"]
)";

/// The settings that make would write beside a run.
std::string settings_of(const std::string& rules, const std::string& run) {
  const std::string before = fmt::format("{}/run.settings: private settings := ", run);
  const std::size_t begin = rules.find(before) + before.size();
  return rules.substr(begin, rules.find('\n', begin) - begin + 1);
}

} // namespace

TEST_CASE("a run whose checkpoint is lost is made again, with those before it, only for a branch that is to be made") {
  const Studies studies;
  const Figure figure = studies.figure(chain);
  const std::string first = studies.path("out/first"), second = studies.path("out/second"),
                    third = studies.path("out/third");
  const auto checkpoint = [](const std::string& run) {
    return (std::filesystem::path(run) / "work" / "run.pressing.checkpoint.h5").string();
  };
  const std::string rules = studies.rules(figure);
  CHECK_THAT(rules, !Contains("run.h5: FORCE")); // nothing is there: all is made anyway
  for (const std::string& run : {first, second, third}) {
    write_text(run + "/run.h5", "");
    write_text(run + "/run.settings", settings_of(rules, run));
  }
  CHECK_THAT(studies.rules(figure), !Contains("FORCE\n" + third)); // all is made: lost checkpoints do not matter
  CHECK_THAT(studies.rules(figure), !Contains("run.h5: FORCE"));
  std::filesystem::remove(third + "/run.h5");
  CHECK_THAT(studies.rules(figure), Contains(second + "/run.h5: FORCE") && Contains(first + "/run.h5: FORCE"));
  write_text(checkpoint(first), "");
  CHECK_THAT(studies.rules(figure), Contains(second + "/run.h5: FORCE") && !Contains(first + "/run.h5: FORCE"));
  write_text(checkpoint(second), "");
  CHECK_THAT(studies.rules(figure), !Contains("run.h5: FORCE"));
  // A branch whose settings changed is to be made, too.
  write_text(third + "/run.h5", "");
  write_text(third + "/run.settings", "others\n");
  std::filesystem::remove(checkpoint(second));
  CHECK_THAT(studies.rules(figure), Contains(second + "/run.h5: FORCE"));
}

TEST_CASE("a result that is missing is made again, whatever is made from it") {
  const Studies studies;
  const std::string plot = "[[plots]]\nname = \"p\"\nx = { label = \"x\" }\ny = { label = \"y\" }\n"
                           "series = [{ table = \"t\", x = \"y\", y = \"y\" }]\n";
  const Figure figure = studies.figure(chain + plot);
  const std::string out = studies.path("out/study/");
  for (const char* file : {"t.csv", "p.png", "p.svg", "verdict.json"}) {
    CAPTURE(file);
    CHECK_THAT(studies.rules(figure), Contains(out + file + ": FORCE\n"));
    write_text(out + file, "");
    CHECK_THAT(studies.rules(figure), !Contains(out + file + ": FORCE\n"));
  }
}

TEST_CASE("a packing of a case's own is made by its command or size, a run begins at it, and metrics measure it") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
size = [0.001, 0.002]
[[packings]]
name = "pair"
command = "hemispheres --size {size} --from {here}/s.csv"
[[packings]]
name = "mesh"
size = "{size}"
[[runs]]
name = "pressed"
programme = "press"
packing = "pair"
[[runs]]
name = "fine"
programme = "press"
packing = "mesh"
[metrics]
contact = "contact --packing {packing}"
quality = "pack-gen quality --description {description} --sizes {folder}/sizes.csv"
[[tables]]
name = "t"
columns = ["tets = mesh/quality.tets", "p = pressed/strength.value:.2f", "z = fine/contact.value"]
)");
  const std::string rules = studies.rules(figure), out = studies.path("out");
  const std::string pair = out + "/study/packings/pair-0.001/packing";
  CHECK_THAT(rules, Contains(fmt::format("{}.h5: private command := hemispheres --size 0.001 --from {}/s.csv", pair,
                                         folder_of_file(figure.path))));
  CHECK_THAT(rules, Contains(fmt::format("{0}/study/runs/pressed-0.001/run.h5: {1}.h5", out, pair)));
  CHECK_THAT(rules, Contains(fmt::format("--set 'packing={}.h5'", pair)));
  const std::string mesh = studies.path("packings/mesh-0.002.h5");
  CHECK_THAT(rules, Contains(fmt::format("{}/packing-0.002/quality.json: {}", out, mesh)));
  CHECK_THAT(rules,
             Contains(fmt::format("pack-gen quality {} --description powder.toml --sizes {}/packing-0.002/sizes.csv",
                                  mesh, out)));
  CHECK_THAT(rules, Contains(fmt::format("{}/study/runs/fine-0.002/run.h5: {}", out, mesh)));
  CHECK_THAT(rules, Contains(fmt::format("contact {}/study/runs/fine-0.002/run.h5 --packing {}", out, mesh)));
  for (const char* size : {"0.001", "0.002"}) {
    write_text(fmt::format("{}/packing-{}/quality.json", out, size), R"({"tets": 7})");
    write_text(fmt::format("{}/study/runs/pressed-{}/strength.json", out, size), R"({"value": 1.239})");
    write_text(fmt::format("{}/study/runs/fine-{}/contact.json", out, size), R"({"value": 3})");
  }
  const TextTable table = make_table(figure, figure.tables[0], studies.results());
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0][0].text == "7");
  CHECK(table.rows[0][1].text == "1.24");
}

TEST_CASE("a figure named without its folder has the same name, and {here} is the current folder") {
  const Studies studies;
  write_text(studies.path("tablet/figure.toml"), "title = \"x\"\n");
  write_text(studies.path("tablet/mine.toml"), "title = \"x\"\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(studies.path("tablet"));
  const std::string here = read_figure("figure.toml", ".").name, dotted = read_figure("./figure.toml", ".").name,
                    mine = read_figure("mine.toml", ".").name;
  std::filesystem::current_path(before);
  CHECK(here == "tablet");
  CHECK(dotted == "tablet");
  CHECK(mine == "mine");
  CHECK(folder_of_file("mine.toml") == ".");
  CHECK(folder_of_file("./mine.toml") == ".");
  CHECK(folder_of_file("sub/mine.toml") == "sub");
}

TEST_CASE("packings, metrics and runs are made again when a file that they name is new") {
  const Studies studies;
  write_text(studies.path("pk.toml"), "surface_file = \"die.stl\"\n[size_distribution]\nfile = \"sizes.csv\"\n");
  write_text(studies.path("die.stl"), "");
  write_text(studies.path("sizes.csv"), "");
  write_text(studies.path("limits.csv"), "");
  write_text(studies.path("post.stl"), "");
  write_text(studies.path("other.stl"), "");
  write_text(studies.path("mine.toml"), "[[tools]]\nfile = \"post.stl\"\n[[tools]]\n[[stages]]\nname = \"s\"\n");
  const std::string data = studies.path("out/r/m.csv");
  write_text(data, "");
  const std::string rules = studies.rules(studies.figure(R"([[cases]]
x = 1
[[packings]]
name = "pair"
command = "spheres {here}/pk.toml"
[[runs]]
name = "r"
folder = "r"
programme = "mine.toml"
packing = "pair"
settings = { "tools.1.file" = "other.stl" }
[metrics]
m = "stress --limits {here}/limits.csv --data {folder}/m.csv"
[[tables]]
name = "t"
columns = ["y = r/m.value"]
)"));
  const std::string out = studies.path("out"), pair = out + "/study/packings/pair/packing";
  CHECK_THAT(rules, Contains(fmt::format("{0}.h5: {0}.settings {1} {2} {3}\n", pair, studies.path("pk.toml"),
                                         studies.path("die.stl"), studies.path("sizes.csv"))));
  CHECK_THAT(rules, Contains(fmt::format("{0}/r/m.json: {0}/r/run.h5 {1} {0}/r/m.command\n", out,
                                         studies.path("limits.csv"))));
  CHECK_THAT(rules, Contains(fmt::format("{0}/r/run.h5: {1}.h5 {0}/r/run.settings {2} {3}\n", out, pair,
                                         studies.path("post.stl"), studies.path("other.stl"))));
}

TEST_CASE("a file whose name means something to make is no prerequisite") {
  const Studies studies;
  for (const std::string name : {"my die.stl", "my:die.stl", "$die.stl"}) {
    write_text(studies.path(name), "");
    write_text(studies.path("pk.toml"), fmt::format("surface_file = \"{}\"\n", name));
    const std::string rules = studies.rules(
        studies.figure("[[cases]]\nx = 1\n[[packings]]\nname = \"p\"\ncommand = \"spheres "
                       "{here}/pk.toml\"\n[[tables]]\nname = \"t\"\ncolumns = [\"y = p/pores.value\"]\n"));
    CHECK_THAT(rules, Contains(studies.path("pk.toml")));
    CHECK_THAT(rules, !Contains("die.stl"));
  }
}

TEST_CASE("a run's folder that another study has for a different run is refused, and shared for the same run") {
  const Studies studies;
  const auto text = [](int modulus) {
    return fmt::format(R"([[cases]]
x = 1
[[runs]]
name = "r"
folder = "shared"
programme = "press"
settings = {{ "material.youngs_modulus" = {} }}
[[tables]]
name = "t"
columns = ["y = r/strength.value"]
)",
                       modulus);
  };
  const std::string other = studies.path("other.toml");
  write_text(studies.path("out/other/study.path"), other + "\n");
  DependsRequest request{studies.results(), studies.path("packings/mesh-0.03.h5"), "powder.toml", {}};
  request.programmes = studies.path("programmes");
  const auto check = [&](int modulus_of_other) {
    write_text(other, "title = \"y\"\n" + text(modulus_of_other));
    refuse_runs_of_other_studies(studies.figure(text(5000)), request);
  };
  CHECK_NOTHROW(check(5000));
  CHECK_THROWS_WITH(check(6000), studies.path("study.toml") + ": folder: found 'shared', where " + other +
                                     " has another run, allowed: a folder of its own, or make in another folder; the "
                                     "two would replace each other");
  write_text(other, "title = ");
  CHECK_NOTHROW(refuse_runs_of_other_studies(studies.figure(text(5000)), request));
}

TEST_CASE("a metric's key may hold dots, and its name a value with a dot") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
limit = 0.25
[[runs]]
name = "pressed"
programme = "press"
folder = "pressed"
[metrics]
"stress-0.25" = "section-stress --threshold 0.25"
[[tables]]
name = "t"
columns = ["p = pressed/stress-at-densities.at_0.80", "q = pressed/stress-{limit:.2f}.share.a:.1f"]
)");
  const std::string rules = studies.rules(figure), folder = studies.path("out/pressed");
  CHECK_THAT(rules, Contains("postproc stress-at-densities " + folder + "/run.h5\n"));
  CHECK_THAT(rules, Contains("postproc section-stress " + folder + "/run.h5 --threshold 0.25\n"));
  write_text(folder + "/stress-at-densities.json", R"({"value": 1, "at_0.80": 7})");
  write_text(folder + "/stress-0.25.json", R"({"value": 1, "share.a": 0.34})");
  const TextTable table = make_table(figure, figure.tables[0], studies.results());
  CHECK(table.rows.at(0)[0].text == "7");
  CHECK(table.rows.at(0)[1].text == "0.3");
}

TEST_CASE("a metric is measured again only where its command is another one, with the case's values in it") {
  const Studies studies;
  const auto rules_with = [&](const std::string& density) {
    return studies.rules(studies.figure(fmt::format(R"([[cases]]
x = [1, 2]
[defaults]
density = {}
[[runs]]
name = "r"
programme = "press"
folder = "r{{x}}"
[metrics]
m = "stress --at {{density}} --name 'case {{x}}'"
[[tables]]
name = "t"
columns = ["y = r/m.value"]
)",
                                                    density)));
  };
  const auto command_of = [&](const std::string& run) {
    const std::string file = studies.path("out/" + run + "/m");
    return std::pair{file + ".command", fmt::format("postproc stress {}/run.h5 --at 0.7 --name case {}\n",
                                                    studies.path("out/" + run), run.back())};
  };
  const std::string rules = rules_with("0.7");
  for (const char* run : {"r1", "r2"}) {
    const auto [file, command] = command_of(run);
    CHECK_THAT(rules,
               Contains(fmt::format("/{}/m.json: {}/run.h5 {}\n", run, studies.path("out/" + std::string(run)), file)));
    CHECK_THAT(rules, Contains(file + ": private settings := " + command) && Contains(file + ": FORCE\n"));
    write_text(file, command);
  }
  CHECK_THAT(rules_with("0.7"), !Contains("m.command: FORCE"));
  write_text(command_of("r2").first, "postproc stress of another case\n");
  CHECK_THAT(rules_with("0.7"), !Contains("r1/m.command: FORCE") && Contains("r2/m.command: FORCE"));
  CHECK_THAT(rules_with("0.8"), Contains("r1/m.command: FORCE") && Contains("r2/m.command: FORCE"));
}

TEST_CASE("a metric whose command does not exist is refused with its line before anything is made") {
  const Studies studies;
  const std::string begin = "[[cases]]\nx = 1\n[[runs]]\nname = \"r\"\nprogramme = \"press\"\n";
  const std::string table = "[[tables]]\nname = \"t\"\ncolumns = [\"y = r/";
  const std::vector<std::string> known = {"strength", "modulus"};
  CHECK_THROWS_WITH(studies.rules(studies.figure(begin + table + "strenth.value\"]\n"), known),
                    Contains("study.toml:9") && Contains("found 'strenth', did you mean 'strength'?"));
  CHECK_THROWS_WITH(
      studies.rules(studies.figure(begin + "[metrics]\nm = \"unknown --a 1\"\n" + table + "m.value\"]\n"), known),
      Contains("metric 'm': found 'unknown', allowed: a command of postproc"));
  CHECK_NOTHROW(
      studies.rules(studies.figure(begin + "[metrics]\nm = \"modulus --a 1\"\n" + table + "m.value\"]\n"), known));
  studies.figure(begin + table + "strenth.value\"]\n");
  const test::Outcome refused =
      test::postproc(fmt::format("depends '{}' --programmes '{}' --packing p.h5 -o '{}'", studies.path("study.toml"),
                                 studies.path("programmes"), studies.path("rules.mk")));
  CHECK(refused.exit_code == 2);
  CHECK(refused.one_error_line("postproc"));
  CHECK_THAT(refused.messages, Contains("study.toml:9") && Contains("did you mean 'strength'?"));
  CHECK_FALSE(std::filesystem::exists(studies.path("rules.mk")));
}

TEST_CASE("a misspelt option of a metric or a picture is refused with its line before anything is made") {
  const Studies studies;
  const auto refused = [&](const std::string& metric, const std::string& picture = "section {run}") {
    studies.figure(fmt::format(R"([[cases]]
drop = 0.05
[[runs]]
name = "r"
programme = "press"
[metrics]
m = "{}"
[[tables]]
name = "t"
columns = ["y = r/m.value"]
[[pictures]]
name = "p.png"
run = "r"
command = "{}"
)",
                               metric, picture));
    return test::postproc(fmt::format("depends '{}' --programmes '{}' --packing none.h5 -o '{}'",
                                      studies.path("study.toml"), studies.path("programmes"),
                                      studies.path("rules.mk")));
  };
  const auto check_refusal = [](const test::Outcome& outcome, const std::string& words) {
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Contains(words));
  };
  check_refusal(refused("strength --drp {drop}"),
                "study.toml:8:5: key 'metrics.m': metric 'm': found '--drp'; did you");
  check_refusal(refused("strength --drop 5"), "metric 'm': --drop: found '5', allowed: ");
  check_refusal(refused("strength --drop"), "metric 'm': ");
  check_refusal(refused("strength --stage 'a"), "metric 'm': found 'strength ");
  check_refusal(refused("strength", "section {run} --feld damage"), "found '--feld'; did you mean '--field'?");
  check_refusal(refused("strength", "secton {run}"), "found 'secton'; did you mean 'section'?");
  // Files of metrics may be made later; words that only make knows are not judged.
  for (const std::string metric : {"strength --drop {drop}", "energy --packing {packing}",
                                   "stress-at-densities --densities 0.4,0.5 --data '{folder}/my data.csv'",
                                   "strength --drop $(drop)", "pack-gen quality --whatever"})
    CHECK(refused(metric).exit_code == 0);
}

TEST_CASE("selectors that match nothing, and values that define no study, are refused with their line") {
  const Studies studies;
  const std::string run = "[[runs]]\nname = \"r\"\nprogramme = \"press\"\n";
  const std::string table = "[[tables]]\nname = \"t\"\ncolumns = [\"y = r/strength.value\"]\n";
  const auto refused = [&](const std::string& text, const std::string& message) {
    CAPTURE(text);
    CHECK_THROWS_WITH(
        make_rules({studies.figure(text)}, {studies.results(), "p.h5", "d.toml", {}, {}, {"coarse", "smoke"}}),
        Contains("study.toml:") && Contains(message));
  };
  const std::string cases = "[[cases]]\nseries = \"a\"\nx = [1, 2]\n";
  refused(cases + run + "series = [\"b\"]\n" + table, "series: there are no [[cases]] of the series 'b'");
  refused(cases + run + table + "series = [\"a\", \"b\"]\n", "there are no [[cases]] of the series 'b'");
  refused(cases + "only = { y = 1 }\n" + run + table, "only: these cases have no value 'y'");
  refused(cases + "only = { x = [1, 3] }\n" + run + table, "only: found x = 3, allowed: 1, 2");
  refused(cases + "meshes = [\"coars\"]\n" + run + table, "meshes: found 'coars'; did you mean 'coarse'?");
  refused(cases + run + table + "where = { x = { at_least = 3, at_most = 2 } }\n",
          "found 2, below 'at_least' = 3, allowed: no smaller number");
  refused(cases + run + table +
              "[[statements]]\ntext = \"s\"\npaper = \"p\"\nours = \"o\"\nquantities = {}\nmeshes = [\"medum\"]\n",
          "meshes: found 'medum', allowed: coarse, smoke");
  const std::string other_mesh = "folder = \"c\"\nmesh = ";
  refused(cases + run + other_mesh + "\"corse\"\n" + table, "mesh: found 'corse'; did you mean 'coarse'?");
  refused(cases + "of = \"smok\"\n" + run + other_mesh + "\"{of}\"\n" + table, "mesh: found 'smok'; did you mean");
  refused("[[cases]]\nx = [20, 30, 2e1]\n" + run + table, "found 20 twice, allowed: every value once");
  refused("[[cases]]\nx = 1\n[follows.x]\n\"1\" = { y = 1 }\n[follows.y]\n\"1\" = { x = 1 }\n" + run + table,
          "from which 'x' follows, allowed: only one way");
  for (const std::string folder : {"../other", "/tmp/other", "a/../b", "{x}/.."})
    refused(cases + run + "folder = \"" + folder + "\"\n" + table, "allowed: a folder below that of the results");
  CHECK_NOTHROW(studies.rules(studies.figure(cases + "only = { x = 2.0 }\nmeshes = [\"any\"]\n" + run + table)));
}

TEST_CASE("stages, values, pictures and files that cannot be there are refused before anything is made") {
  const Studies studies;
  const std::string begin = "[[cases]]\nx = 1\n[[runs]]\nname = \"r\"\nprogramme = \"press\"\n";
  const auto refused = [&](const std::string& text, const std::string& message) {
    CAPTURE(text);
    CHECK_THROWS_WITH(studies.rules(studies.figure(begin + text)), Contains("study.toml:") && Contains(message));
  };
  const std::string curves = "[[tables]]\nname = \"t\"\ncurves = [\"r\"]\n";
  refused(curves + "columns = [\"p [MPa] = mean_stress\"]\nstage = 1\n", "stage: found 1, but ");
  refused(curves + "columns = [\"p [MPa] = mean_stress\"]\nstages = [0, -2]\n",
          "allowed: one of them, or from the end");
  CHECK_NOTHROW(studies.rules(studies.figure(begin + curves + "columns = [\"r [1] = {run}\"]\nstage = -1\n")));
  refused(curves + "columns = [\"p [MPa] = {y}\"]\n", "found '{y}'");
  refused("[[tables]]\nname = \"t\"\ncolumns = [\"p [MPa] = {x:.2q}\"]\n", "found the format '.2q'");
  refused("[[tables]]\nname = \"t\"\nrow = \"{y}\"\ncolumns = [\"p [MPa] = {x}\"]\n", "found '{y}'");
  refused("[[tables]]\nname = \"t\"\nfile = \"none.csv\"\ncolumns = [\"p [MPa]\"]\n",
          "found 'none.csv', allowed: a file next to ");
  CHECK_NOTHROW(
      studies.rules(studies.figure(begin + "[[tables]]\nname = \"t\"\nfile = \"made-1.csv\"\ncolumns = [\"p [MPa]\"]\n"
                                           "[[scripts]]\nname = \"made-{x}.csv\"\ncommand = \"true > {file}\"\n")));
  const std::string taken = "which is made in another way, allowed: another name";
  const std::string script = "[[scripts]]\ncommand = \"true > {file}\"\nname = ";
  const std::string plot = "[[tables]]\nname = \"t\"\ncolumns = [\"x = {x}\"]\n[[plots]]\nname = \"p\"\nx = {}\n"
                           "y = {}\nseries = [{ table = \"t\", x = \"x\", y = \"x\" }]\n";
  refused(plot + script + "\"p.png\"\n", "found 'p.png', " + taken);
  refused(plot + script + "\"t.spread.csv\"\n", "found 't.spread.csv', " + taken);
  refused(plot + "[[pictures]]\nname = \"p.png\"\nrun = \"r\"\ncommand = \"section {run}\"\n",
          "found 'p.png', " + taken);
  refused("[[pictures]]\nname = \"index.html\"\nrun = \"r\"\ncommand = \"view {run}\"\n",
          "found 'index.html', " + taken);
  refused(script + "\"study.path\"\n", "found 'study.path', " + taken);
  refused(script + "\"two\"\n[[scripts]]\ncommand = \"false > {file}\"\nname = \"two\"\n", "two commands make ");
  refused("[[pictures]]\nname = \"p.svg\"\nrun = \"r\"\ncommand = \"section {run}\"\n",
          "name: found 'p.svg', but postproc section draws PNG, allowed: a name that ends in .png");
}

TEST_CASE("keys of a table, a plot or a statement that have no effect together are refused") {
  const Studies studies;
  const std::string begin = "[[cases]]\nx = [1, 2]\n[[runs]]\nname = \"r\"\nprogramme = \"press\"\n";
  const std::string table = "[[tables]]\nname = \"t\"\ncolumns = [\"x = {x}\"]\n";
  const auto refused = [&](const std::string& text, const std::string& message) {
    CAPTURE(text);
    CHECK_THROWS_WITH(studies.figure(begin + text), Contains("study.toml:") && Contains(message));
  };
  for (const std::string key : {"stage", "digits", "points"})
    for (const std::string list : {"", "list = \"r/m\"\n"})
      refused(table + list + key + " = 2\n", "." + key + "': found without 'curves', allowed: with it");
  refused(table + "stages = [0]\n", "stages': found without 'curves'");
  refused(table + "curves = [\"r\"]\nlist = \"r/m\"\n", "list': found with 'curves', allowed: one of the two");
  refused(table + "curves = [\"r\"]\nrow = \"a\"\n", "row': found with 'curves', allowed: a column instead");
  refused(table + "list = \"r/m\"\nrow = \"a\"\n", "row': found with 'list', allowed: a column instead");
  refused(table + "curves = [\"r\"]\ndistinct = true\n", "distinct': found with 'curves', allowed: without it");
  const auto plot = [&](const std::string& keys) {
    return table + "[[plots]]\nname = \"p\"\nx = { ticks = \"0, 0.1, 0.4\" }\ny = {}\n" + keys;
  };
  refused(plot("lines = [{ title = \"a\" }]\n"), "lines: found 0 of y, x and slope, allowed: one");
  refused(plot("lines = [{ y = 1, x = 2 }]\n"), "lines: found 2 of y, x and slope, allowed: one");
  refused(plot("key = \"right bottm\"\n"), "key': found 'bottm'; did you mean 'bottom'?");
  CHECK_NOTHROW(studies.figure(begin + plot("key = \"outside center above maxcols 1\"\n")));
  for (const std::string ticks : {"abc", "1, 2, 3, 4", "(1, 2", "1,", "()"})
    refused(plot("z = { ticks = \"" + ticks + "\" }\n"), "ticks': found '" + ticks + "', allowed: a distance such as");
  CHECK_NOTHROW(studies.figure(begin + plot("z = { ticks = \"(1, 2, 5, 1e3)\", format = \"10^{%L} or %+.2f %%\" }\n")));
  for (const std::string format : {"%q", "%.2", "%d mm"})
    refused(plot("z = { format = \"" + format + "\" }\n"), "format': found '" + format + "', allowed: a format such");
  refused("[[statements]]\ntext = \"s\"\npaper = \"p\"\nours = \"o\"\nquantities = {}\nrequire = []\n",
          "require': found no condition, allowed: one or more");
}

TEST_CASE("distinct rows of a list are there once where cases share their run") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
x = [1, 2]
[[runs]]
name = "r"
programme = "press"
[[tables]]
name = "all"
list = "r/m"
columns = ["y = y"]
[[tables]]
name = "once"
list = "r/m"
columns = ["y = y"]
distinct = true
)");
  write_text(studies.path("out/study/runs/r/m.csv"), "y [1]\n1\n2\n");
  CHECK(make_table(figure, figure.tables[0], studies.results()).rows.size() == 4);
  CHECK(make_table(figure, figure.tables[1], studies.results()).rows.size() == 2);
}

TEST_CASE("cases share a picture only if they draw the same one") {
  const Studies studies;
  const auto rules = [&](const std::string& name) {
    return studies.rules(studies.figure(fmt::format(R"([[cases]]
x = [1, 2]
y = [3, 4]
[[runs]]
name = "r"
programme = "press"
settings = {{ "a.b" = "{{x}}" }}
[[pictures]]
name = "{}"
run = "r"
command = "section {{run}} --data {{folder}}/s{{x}}.csv"
)",
                                                    name)));
  };
  CHECK_THROWS_WITH(rules("s.png"),
                    Contains("study.toml:12") && Contains("found the name 's.png' for different pictures"));
  const std::string shared = rules("s{x}.png"), out = studies.path("out/study");
  CHECK_THAT(shared,
             Contains(out + "/s2.png: private picture := section ") && Contains(fmt::format("--data {}/s2.csv", out)));
}

TEST_CASE("a packing is a size or a command, and a run begins at one") {
  const Studies studies;
  CHECK_THROWS_WITH(studies.figure("[[packings]]\nname = \"p\"\ncommand = \"spheres 'a\"\n"),
                    Contains("study.toml:4") && Contains("found 'spheres "));
  CHECK_THROWS_WITH(studies.figure("[[packings]]\nname = \"p\"\nsize = \"1\"\ncommand = \"spheres\"\n"),
                    Contains("study.toml:5") && Contains("cannot be used with 'size'"));
  CHECK_THROWS_WITH(studies.figure("[[runs]]\nname = \"r\"\nprogramme = \"press\"\npacking = \"r\"\n"),
                    Contains("'r' is a run, allowed: one of [[packings]]"));
}

TEST_CASE("a study's powder has the keys of the files that it includes, and its own instead where it has them") {
  const Studies studies;
  write_text(studies.path("grains.toml"), "[powder]\nseed = 1\ncount = 10\nelement_size = 0.03\n"
                                          "[powder.size_distribution]\nkind = \"table\"\nvalues = [1.0, 2.0]\n");
  write_text(studies.path("box.toml"), "include = [\"grains.toml\"]\n[powder]\ncount = 20\nbox = [1, 1, 1]\n");
  const Figure figure = studies.figure("include = [\"box.toml\"]\n[powder]\nelement_size = 0.04\nseed = 2\n"
                                       "[powder.size_distribution]\nvalues = [3.0, 4.0]\n");
  CHECK(figure.powder == studies
                             .figure("[powder]\nelement_size = 0.04\ncount = 20\nbox = [1, 1, 1]\nseed = 2\n"
                                     "[powder.size_distribution]\nkind = \"table\"\nvalues = [3.0, 4.0]\n")
                             .powder);
  CHECK(figure.element_size == 0.04);
  CHECK(studies.figure("include = [\"box.toml\"]\n").element_size == 0.03);
  CHECK(studies.figure("").powder.empty());
}

TEST_CASE("a powder of a file that is included twice counts where it is included last") {
  const Studies studies;
  write_text(studies.path("ten.toml"), "[powder]\nelement_size = 1\ncount = 10\n");
  write_text(studies.path("twenty.toml"), "include = [\"ten.toml\"]\n[powder]\ncount = 20\n");
  CHECK(studies.figure("include = [\"twenty.toml\", \"ten.toml\"]\n").powder ==
        studies.figure("include = [\"ten.toml\"]\n").powder);
  CHECK(studies.figure("include = [\"ten.toml\", \"twenty.toml\"]\n").powder ==
        studies.figure("include = [\"twenty.toml\"]\n").powder);
}

TEST_CASE("an included file may have a heading, must exist and must not include the file that includes it") {
  const Studies studies;
  write_text(studies.path("whole.toml"), "title = \"another\"\nquestion = \"?\"\n[powder]\nelement_size = 1\n");
  const Figure figure = studies.figure("include = [\"whole.toml\"]\n");
  CHECK(figure.title != "another");
  CHECK(figure.element_size == 1);
  CHECK_THROWS_WITH(studies.figure("include = [\"none.toml\"]\n"),
                    Contains("study.toml:") && Contains("key 'include': found 'none.toml', but there is no such file"));
  CHECK_THROWS_WITH(studies.figure("include = [\"study.toml\"]\n"), Contains("'study.toml', which includes this file"));
  write_text(studies.path("a.toml"), "include = [\"b.toml\"]\n");
  write_text(studies.path("b.toml"), "include = [\"a.toml\"]\n");
  CHECK_THROWS_WITH(studies.figure("include = [\"a.toml\"]\n"),
                    Contains("b.toml:1") && Contains("'a.toml', which includes this file"));
}

TEST_CASE("a study has the statements of another figure whose columns and fits it has, and only those") {
  const Studies studies;
  const std::string statements = R"(title = "figure"
[[tables]]
name = "strength"
series = ["slow"]
columns = ["x [1] = {x}", "y [1] = {x}"]
[[tables]]
name = "modulus"
columns = ["x [1] = {x}"]
[[statements]]
text = "rises"
paper = "p"
ours = "{x}"
quantities.x = { table = "strength", column = "x", take = "first" }
require = [{ quantity = "x", above = 0 }]
[[statements]]
text = "of another table"
paper = "p"
ours = "{x}"
quantities.x = { table = "modulus", column = "x", take = "first" }
require = [{ quantity = "x", above = 0 }]
[[statements]]
text = "without a verdict"
paper = "p"
ours = "{x}"
quantities.x = { table = "strength", column = "x", take = "first" }
[[statements]]
text = "of another column"
paper = "p"
ours = "{y}"
quantities.y = { table = "strength", column = "y", take = "first" }
require = [{ quantity = "y", above = 0 }]
[[statements]]
text = "of a fit"
paper = "p"
ours = "{b}"
quantities.x = { table = "strength", column = "x", take = "first" }
quantities.b = { fit = "line", coefficient = "b" }
require = [{ quantity = "x", above = 0 }]
)";
  write_text(studies.path("figure/figure.toml"), statements);
  const std::string of_figure = "statements_of = [\"figure/figure.toml\"]\n[[cases]]\nx = [1, 2]\n[[tables]]\n"
                                "columns = [\"x [1] = {x}\"]\nname = ";
  const Figure figure = studies.figure(of_figure + "\"strength\"\n");
  REQUIRE(figure.statements.size() == 1);
  CHECK(figure.statements[0].text == "rises");
  CHECK(figure.tables.size() == 1);
  // A change of the other file makes the verdict again.
  CHECK_THAT(studies.rules(figure), Contains(studies.path("figure/figure.toml")));

  CHECK_THROWS_WITH(studies.figure(of_figure + "\"other\"\n"),
                    Contains("study.toml:2") && Contains("figure/figure.toml', but each of its own statements needs a "
                                                         "column or fit that this file does not have"));
  CHECK_THROWS_WITH(studies.figure("statements_of = [\"figure/figure.toml\", \"figure/figure.toml\"]\n" +
                                   of_figure.substr(of_figure.find('\n') + 1) + "\"strength\"\n"),
                    Contains("figure/figure.toml', whose statements this file has already"));
  CHECK_THROWS_WITH(studies.figure("statements_of = [\"none.toml\"]\n"),
                    Contains("key 'statements_of': found 'none.toml', but there is no such file"));
}

TEST_CASE("files that a study's powder names are found from its results, and their content is part of its text") {
  const Studies studies;
  write_text(studies.path("parts/cube.stl"), "solid a");
  write_text(studies.path("sizes.csv"), "size [mm]\n1\n");
  write_text(studies.path("parts/powder.toml"), "[powder]\nsurface_file = \"cube.stl\"\n");
  const std::string text = "include = [\"parts/powder.toml\"]\n[powder]\nelement_size = 0.1\n"
                           "[powder.size_distribution]\nfile = \"sizes.csv\"\n";
  const Figure figure = studies.figure(text);
  CHECK(figure.powder_files == std::set{studies.path("parts/cube.stl"), studies.path("sizes.csv")});
  const std::string powder = powder_text(figure, studies.path("out/own/study"));
  CHECK_THAT(powder, Contains("surface_file = '../../../parts/cube.stl'") && Contains("file = '../../../sizes.csv'"));
  CHECK(powder.starts_with("# element_size = 0.1\n"));
  write_text(studies.path("parts/cube.stl"), "solid b");
  CHECK(powder_text(figure, studies.path("out/own/study")) != powder);
  std::filesystem::remove(studies.path("sizes.csv"));
  CHECK_THROWS_WITH(studies.figure(text),
                    Contains("study.toml:6") && Contains("powder.size_distribution.file': found "
                                                         "'sizes.csv', but there is no such file"));
}

TEST_CASE("a powder without the size of its elements is refused where it stands") {
  const Studies studies;
  write_text(studies.path("grains.toml"), "[powder]\nseed = 1\n");
  CHECK_THROWS_WITH(studies.figure("include = [\"grains.toml\"]\n"),
                    Contains("grains.toml:1") && Contains("key 'powder.element_size': missing"));
  write_text(studies.path("grains.toml"), "[powder]\nelement_size = -1\n");
  CHECK_THROWS_WITH(studies.figure("include = [\"grains.toml\"]\n[powder]\nelement_size = 1\n"),
                    Contains("grains.toml:2") && Contains("found -1"));
}

TEST_CASE("a script makes one file for all cases that name the same, from what each of them needs") {
  const Studies studies;
  const std::string text = R"([[cases]]
case = ["a", "b"]
[[scripts]]
name = "{case}.csv"
command = "sh {here}/run.sh {case} > {file}"
[[scripts]]
name = "all.csv"
needs = ["{folder}/{case}.csv"]
command = "cat $^ > {file}"
[[tables]]
name = "t"
file = "all.csv"
columns = ["x [mm]", "y"]
)";
  const std::string rules = studies.rules(studies.figure(text)), out = studies.path("out/study");
  CHECK_THAT(rules, Contains(fmt::format("{0}/all.csv: {1}/study.toml {0}/a.csv\n", out, studies.path("."))) ||
                        Contains(out + "/a.csv\n"));
  CHECK_THAT(rules, Contains(fmt::format("{0}/all.csv:  {0}/b.csv", out)));
  CHECK_THAT(rules, Contains(out + "/a.csv: private script = sh ") && Contains("run.sh a > $@.partial"));
  std::string conflicting = text;
  conflicting.replace(conflicting.find("cat $^"), 6, "cat {case}");
  CHECK_THROWS_WITH(studies.rules(studies.figure(conflicting)), Contains("two commands make"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return studies.rules(studies.figure(changed));
  };
  CHECK_THROWS_WITH(with("name = \"all.csv\"", "name = \"../all.csv\""),
                    Contains("found '../all.csv', allowed: a file in the figure's folder"));
  CHECK_THROWS_WITH(with("name = \"all.csv\"", "name = \"verdict.json\""), Contains("is made in another way"));
  CHECK_THROWS_WITH(with("cat $^ > {file}", "cat $^"), Contains("command: found no {file}"));
  CHECK_THROWS_WITH(
      studies.figure(text + "[[fits]]\nname = \"f\"\ntable = \"t\"\nx = \"z\"\ny = \"y\"\nmodel = \"linear\"\n"),
      Contains("table 't' has no column 'z'"));
}

TEST_CASE("a table of a file lies beside the figure where there is such a file, else among its results") {
  const Studies studies;
  write_text(studies.path("paper.csv"), "x,y\n1,2\n");
  const Figure figure = studies.figure("[[tables]]\nname = \"p\"\nfile = \"paper.csv\"\ncolumns = [\"x\", \"y\"]\n"
                                       "[[tables]]\nname = \"s\"\nfile = \"made.csv\"\ncolumns = [\"x\"]\n"
                                       "[[cases]]\nx = 1\n[[scripts]]\nname = \"made.csv\"\n"
                                       "command = \"true > {file}\"\n");
  CHECK(path_of_table(figure.tables[0], "out/study") == studies.path("paper.csv"));
  CHECK(path_of_table(figure.tables[1], "out/study") == "out/study/made.csv");
  CHECK_THAT(studies.rules(figure), !Contains("paper.csv:"));
}

TEST_CASE("the run of another mesh is taken where it lies and never made; rows without one are left out") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
of_mesh = ["coarse", "medium", "paper"]
[[runs]]
name = "pressed"
folder = "pressed"
mesh = "{of_mesh}"
programme = "press"
[[tables]]
name = "t"
columns = ["mesh = {of_mesh}", "p = pressed/strength.value"]
)");
  write_text(studies.path("medium/pressed/run.h5"), "");
  const std::string rules = studies.rules(figure);
  CHECK_THAT(rules, Contains(studies.path("out/pressed/run.h5") + ": "));
  CHECK_THAT(rules,
             Contains(studies.path("medium/pressed/strength.json") + ": " + studies.path("medium/pressed/run.h5")));
  CHECK_THAT(rules, !Contains(studies.path("medium/pressed/run.h5") + ": "));
  CHECK_THAT(rules, !Contains("paper/pressed"));
  write_text(studies.path("out/pressed/strength.json"), R"({"value": 1})");
  write_text(studies.path("medium/pressed/strength.json"), R"({"value": 2})");
  const TextTable table = make_table(figure, figure.tables[0], studies.results());
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[1][0].text == "medium");
  CHECK(table.rows[1][1].text == "2");
  CHECK_THROWS_WITH(studies.figure("[[runs]]\nname = \"r\"\nprogramme = \"press\"\nmesh = \"medium\"\n"),
                    Contains("found without 'folder'"));
}

TEST_CASE("cells of cases that a run is not meant for are empty, and it is not made for them") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
for_each = [{ series = "made", sizes = [1, 2] }, { series = "known", sizes = [3] }]
series = "{series}"
size = "{sizes}"
[[runs]]
name = "pressed"
programme = "press"
series = ["made"]
settings = { a = "{size}" }
[[tables]]
name = "t"
columns = ["size = {size}", "p = pressed/strength.value"]
)");
  CHECK_THAT(studies.rules(figure), Contains("pressed-2/run.h5") && !Contains("pressed-3"));
  for (const int size : {1, 2})
    write_text(studies.path(fmt::format("out/study/runs/pressed-{}/strength.json", size)), R"({"value": 1})");
  const TextTable table = make_table(figure, figure.tables[0], studies.results());
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[1][1].text == "1");
  CHECK(table.rows[2][0].text == "3");
  CHECK(table.rows[2][1].text.empty());
}

TEST_CASE("a statement that cannot be judged says so in its own words, or is left out") {
  const Studies studies;
  const auto verdict = [&](const std::string& more) {
    const Figure figure = studies.figure(
        "[[tables]]\nname = \"t\"\nfile = \"t.csv\"\ncolumns = [\"x\", \"y\"]\n[[statements]]\ntext = \"s\"\n"
        "paper = \"p\"\nours = \"{y:.1f}\"\nnote = \"n\"\n" +
        more +
        "quantities.y = { table = \"t\", column = \"y\", where = { x = 2 } }\n"
        "require = [{ quantity = \"y\", above = 0 }]\n");
    write_text(studies.path("out/study/t.csv"), "x,y\n1,5\n2,\n");
    FigureData data(figure, studies.path("out/study"));
    return nlohmann::json::parse(verdict_text(data, "coarse"));
  };
  const auto plain = verdict("")[0];
  CHECK(plain["agrees"].is_null());
  CHECK(plain["ours"] == "not known");
  const auto worded = verdict("unjudged = { ours = \"not run\", note = \"needs MESH=paper\" }\n")[0];
  CHECK(worded["ours"] == "not run");
  CHECK(worded["note"] == "needs MESH=paper");
  CHECK(verdict("unjudged = { ours = \"not run\" }\n")[0]["note"] == "n");
  CHECK(verdict("only_if_judged = true\n").empty());
}

TEST_CASE("a statement may exempt some of its cases from the verdict, and says why it differs where it does") {
  const Studies studies;
  const auto verdict = [&](const std::string& filter) {
    const Figure figure =
        studies.figure("[[tables]]\nname = \"t\"\nfile = \"t.csv\"\ncolumns = [\"x\", \"y\"]\n[[statements]]\n"
                       "for_each = [{ law = \"a\" }, { law = \"b\" }]\ntext = \"{law}\"\npaper = \"p\"\nours = \"o\"\n"
                       "note = \"n\"\nwhy = \"the mesh, by {y:.1f}\"\n" +
                       filter +
                       "quantities.y = { table = \"t\", column = \"y\", take = \"last\" }\n"
                       "require = [{ quantity = \"y\", above = 7 }]\n");
    write_text(studies.path("out/study/t.csv"), "x,y\n1,5\n");
    FigureData data(figure, studies.path("out/study"));
    return nlohmann::json::parse(verdict_text(data, "coarse"));
  };
  const auto judged = verdict("verdict_where = { law = \"a\" }\n");
  CHECK(judged[0]["agrees"] == false);
  CHECK(judged[0]["why"] == "the mesh, by 5.0");
  CHECK(judged[0]["note"] == "n");
  CHECK(judged[1]["agrees"].is_null());
  CHECK(judged[1]["note"] == "n; no verdict is given");
  CHECK_FALSE(judged[1].contains("why"));
  CHECK_THROWS_WITH(verdict("verdict_where = { lwa = \"a\" }\n"), Contains("for_each has no 'lwa'"));
}

TEST_CASE("numbers of axes, limits and lines may be words of for_each, and a word that is not a number is refused") {
  const Studies studies;
  const std::string text = R"([[tables]]
name = "t"
file = "t.csv"
columns = ["x", "y"]
[[plots]]
for_each = [{ name = "a", low = -1.5 }]
name = "{name}"
x = { low = "{low}" }
y = {}
lines = [{ y = "{low}" }]
series = [{ table = "t", x = "x", y = "y", where = { x = { at_least = "{low}" } } }]
)";
  const Figure figure = studies.figure(text);
  CHECK(figure.plots[0].x.low == -1.5);
  CHECK(figure.plots[0].lines[0].y == -1.5);
  CHECK(figure.plots[0].series[0].where[0].at_least == -1.5);
  std::string wrong = text;
  wrong.replace(wrong.find("-1.5"), 4, "\"b\"");
  CHECK_THROWS_WITH(studies.figure(wrong), Contains("low") && Contains("allowed: a number"));
}

TEST_CASE("an inset reaches over the rows that it shows, and a surface's points can be projected") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[tables]]
name = "t"
file = "t.csv"
columns = ["part", "x", "g", "y"]
[[plots]]
name = "p"
x = {}
y = {}
inset = { x = {}, y = { low = 1, high = 2 }, place = [0.5, 0.1, 0.4, 0.4], where = { part = "probe" } }
series = [{ table = "t", x = "x", y = "y", x_scale = 10 }]
[[plots]]
name = "surface"
x = { low = 0, high = 4 }
y = { low = 0, high = 1 }
z = {}
series = [
  { model = { name = "pc-gc-surface", A = 1, B = 1, C = 1, D = 1 } },
  { table = "t", x = "x", group = "g", y = "y", fixed_x = 4 },
  { table = "t", x = "x", group = "g", y = "y", fixed_group = 1 },
]
)");
  write_text(studies.path("out/study/t.csv"), "part,x,g,y\nloading,0,0.5,1\nprobe,2,0.5,2\nprobe,3,0.25,3\n");
  const std::string folder = studies.path("out/study");
  FigureData data(figure, folder);
  const std::string script = plot_script(figure.plots[0], data, folder, "svg", "p.svg", 0);
  CHECK_THAT(script, Contains("set multiplot") && Contains("set xrange [19.2:30.8]") && Contains("set xtics 5") &&
                         Contains("set yrange [1:2]"));
  const std::string surface = plot_script(figure.plots[1], data, folder, "svg", "p.svg", 0);
  CHECK_THAT(surface, Contains("4 0.5 2 \n") || Contains("4 0.5 2\n"));
  CHECK_THAT(surface, Contains("3 1 3"));
}

TEST_CASE("a plot shows the results that the figure's file puts beside it, where they exist and are others") {
  const Studies studies;
  const std::string plot = R"([[cases]]
meshes = ["coarse"]
x = 1
[[tables]]
name = "t"
row = "r"
columns = ["x = {x}", "y = {x}"]
[[plots]]
name = "p"
x = {}
y = {}
series = [{ table = "t", x = "x", y = "y", error = "y" }]
)";
  write_text(studies.path("programmes/facets.toml"), "[beside]\nresults = \"facets\"\ntitle = \"facets\"\n");
  const Figure figure = studies.figure("include = [\"facets.toml\"]\n" + plot +
                                       "[beside]\nresults = \"kept/finer\"\ntitle = \"finer mesh\"\n"
                                       "meshes = [\"coarse\", \"medium\"]\n");
  const std::string kept = studies.path("kept/finer/study"), table = kept + "/t.csv";
  CHECK(folder_beside(figure, studies.results()).empty());
  CHECK_THAT(studies.rules(figure), !Contains("finer"));
  write_text(table, "name,x,y\nr,1,4\n");
  CHECK(folder_beside(figure, studies.results()) == kept);
  CHECK_THAT(studies.rules(figure), Contains(" " + table + " "));
  write_text(studies.path("out/study/t.csv"), "name,x,y\nr,1,2\n");
  const std::string svg = studies.path("p.svg"), results = studies.path("out");
  const auto outcome =
      test::postproc(fmt::format("plot {} p --results {} --programmes {} -o {}", studies.path("study.toml"), results,
                                 studies.path("programmes"), svg));
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(test::read_text(svg), Contains("finer mesh"));
  CHECK(folder_beside(figure, {studies.path("out"), "smoke"}).empty());
  CHECK(folder_beside(figure, {studies.path("out/finer/"), "coarse"}).empty()); // its own
  const Figure included = studies.figure("include = [\"facets.toml\"]\n" + plot);
  write_text(studies.path("programmes/facets/study/t.csv"), "name,x\nr,1\n");
  CHECK(folder_beside(included, studies.results()) == studies.path("programmes/facets/study"));
}

TEST_CASE(
    "of results beside a plot only the points are drawn, as far as they have the columns and a series wants them") {
  const Studies studies;
  write_text(studies.path("paper.csv"), "x,y\n7,8\n");
  const Figure figure = studies.figure(R"([[tables]]
name = "paper"
file = "paper.csv"
columns = ["x", "y"]
[[tables]]
name = "t"
file = "made.csv"
columns = ["x", "y", "u", "v"]
[[plots]]
name = "p"
x = {}
y = {}
series = [{ table = "paper", x = "x", y = "y" }, { table = "t", x = "x", y = "y", error = "u" },
  { table = "t", x = "x", y = "v", style = "lines", beside = false }]
)");
  write_text(studies.path("out/study/made.csv"), "x,y,u,v\n1,2,0.5,6\n");
  const auto script_beside = [&](const std::string& other_table) {
    write_text(studies.path("other/study/made.csv"), other_table);
    FigureData data(figure, studies.path("out/study"));
    OtherResults other{"other", FigureData(figure, studies.path("other/study"))};
    return plot_script(figure.plots[0], data, studies.path("out/study"), "svg", "p.svg", 0, &other);
  };
  const std::string script = script_beside("x,y,v\n1,3,9\n");
  CHECK_THAT(script, Contains("EOD\n1 2 0.5 \nEOD") && Contains("EOD\n1 3 \nEOD"));
  CHECK(script.find("7 8") == script.rfind("7 8"));
  CHECK_THAT(script,
             !Contains("1 9") && Contains("NaN with points linetype 8 pointtype 6 pointsize 1.5 title 'other'"));
  CHECK_THAT(script_beside("x,z\n1,3\n"), !Contains("title 'other'"));
}

TEST_CASE("verdicts of meshes stand side by side, counted, and what a mesh did not state stays empty") {
  const Studies studies;
  write_text(studies.path("c/fig03/verdict.json"),
             R"([{"statement": "a|b", "paper": "1", "ours": "2", "agrees": true, "note": ""},
                {"statement": "s", "paper": "p", "ours": "o", "agrees": null, "note": ""}])");
  write_text(studies.path("f/fig03/verdict.json"),
             R"([{"statement": "a|b", "paper": "1", "ours": "3", "agrees": false, "note": "", "why": "r"}])");
  write_text(studies.path("c/other/verdict.json"), "[]");
  const std::string page = verdicts_of_meshes({{"coarse", studies.path("c")}, {"fine", studies.path("f")}});
  CHECK_THAT(page, Contains("| study | coarse | fine |") && Contains("| [fig03](#fig03) | 1 / 0 / 1 | 0 / 1 / 0 |"));
  CHECK_THAT(page, Contains("| a\\|b | 1 | agrees: 2 | **differs**: 3 | r |\n| s | p | not judged: o |  |  |"));
  CHECK_THAT(page, !Contains("other"));
  const std::string mesh = verdicts_of_mesh({"coarse", studies.path("c")});
  CHECK_THAT(mesh, Contains("## fig03\n\n| statement | paper | here | verdict |") && Contains("## other") &&
                       Contains("| expected | here |") && Contains("| s | p | o | not judged |"));
  write_text(studies.path("c/fig03/verdict.json"), "{}");
  CHECK_THROWS_WITH(verdicts_of_mesh({"coarse", studies.path("c")}), Contains("is not a list of statements"));
  CHECK_THROWS_WITH(report_page({{"none", "n", "q"}}, {studies.path("c"), "Studies"}),
                    Contains("none/verdict.json: no such file"));
  CHECK_THROWS_WITH(verdicts_of_mesh({"coarse", studies.path("nothing")}),
                    Contains("nothing: cannot be read as a folder") && Contains("allowed: a folder of results"));
}

TEST_CASE("a report without its verdicts is refused before the view of a run is made") {
  const Studies studies;
  studies.figure("[[cases]]\nx = 1\n[[tables]]\nname = \"t\"\ncolumns = [\"x [1] = {x}\"]\n");
  write_text(studies.path("no-run.h5"), "not a run");
  const test::Outcome report =
      test::postproc(fmt::format("report '{}' --results '{}' --title S --view '{}' -o '{}'", studies.path("study.toml"),
                                 studies.path("out"), studies.path("no-run.h5"), studies.path("page.html")));
  CHECK(report.exit_code == 2);
  CHECK_THAT(report.messages, Contains("study/verdict.json: no such file"));
}

namespace {

/// Writes a figure "study.toml" of a run "r", its table "t" and its fit, and all files that it needs.
void write_complete_study(const Studies& studies) {
  write_text(studies.path("study.toml"), R"(title = "x"
include = ["more.toml"]
[[cases]]
x = [1, 2]
[[runs]]
name = "r"
folder = "r{x}"
programme = "press"
[[tables]]
name = "t"
columns = ["x [mm] = {x}", "y [MPa] = r/strength.value"]
[[fits]]
name = "f"
table = "t"
x = "x"
y = "y"
model = "linear"
[[plots]]
name = "p"
x = { label = "x" }
y = { label = "y" }
series = [{ table = "t", x = "x", y = "y" }]
)");
  write_text(studies.path("more.toml"), "");
  write_text(studies.path("out/r1/strength.json"), R"({"value": 3})");
  write_text(studies.path("out/r2/strength.json"), R"({"value": 4})");
  write_text(studies.path("out/study/t.csv"), "x [mm],y [MPa]\n1,3\n2,4\n3,6\n");
  write_text(studies.path("out/study/fits.json"), "[]");
  write_text(studies.path("out/study/verdict.json"), "[]");
}

} // namespace

TEST_CASE("a table without -o goes to standard output") {
  const Studies studies;
  write_complete_study(studies);
  const auto outcome = test::postproc(fmt::format("table {} t --results {} --programmes {}", studies.path("study.toml"),
                                                  studies.path("out"), studies.path("programmes")));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.output == "x [mm],y [MPa]\n1,3\n2,4\n");
}

TEST_CASE("nothing of a figure is written under the ending of another format, or as a spread that no column has") {
  const Studies studies;
  write_complete_study(studies);
  const std::string figure = studies.path("study.toml") + " ",
                    options = " --results " + studies.path("out") + " --programmes " + studies.path("programmes");
  for (const auto& [command, ending] : {std::pair<std::string, std::string>{"table " + figure + "t", ".csv"},
                                        {"fits " + figure, ".json"},
                                        {"verdict " + figure, ".json"},
                                        {"report --title x " + figure, ".html"}}) {
    const auto outcome = test::postproc(command + options + " -o " + studies.path("x.png"));
    INFO(command << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Contains("x.png: found the ending '.png', allowed: " + ending));
    CHECK_FALSE(std::filesystem::exists(studies.path("x.png")));
  }
  const auto spread =
      test::postproc("table " + figure + "t" + options + " --spread " + studies.path("out/study/t.csv"));
  CHECK(spread.exit_code == 2);
  CHECK_THAT(spread.messages, Contains("--spread: found the table 't', whose 'spread' names no columns"));
}

TEST_CASE("an output with a wrong ending, or that cannot be written, is refused before anything of a figure is read") {
  const Studies studies;
  const std::string figure = studies.path("broken.toml") + " ";
  write_text(studies.path("broken.toml"), "title =");
  write_text(studies.path("none/verdict.json"), "no JSON");
  for (const auto& [command, good] : {std::pair<std::string, std::string>{"table " + figure + "t", "t.csv"},
                                      {"fits " + figure, "f.json"},
                                      {"verdict " + figure, "v.json"},
                                      {"verdicts mesh=" + studies.path("none"), "v.md"},
                                      {"report --title x " + figure, "r.html"},
                                      {"plot " + figure + "p", "p.svg"}}) {
    const auto refused = test::postproc(command + " -o " + studies.path("x.pdf"));
    INFO(command << ": " << refused.messages);
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.messages, Contains("x.pdf: found the ending '.pdf', allowed: "));
    std::filesystem::create_directory(studies.path(good + ".partial"));
    const auto failed = test::postproc(command + " -o " + studies.path(good));
    INFO(failed.messages);
    CHECK(failed.exit_code == 4);
    CHECK_THAT(failed.messages, Contains(good + ".partial: cannot be replaced: Is a directory"));
  }
}

TEST_CASE("a result that cannot be written is refused before the run is read") {
  const test::Folder folder;
  write_text(folder / "run.h5", "no HDF5");
  std::filesystem::create_directory(folder / "s.json.partial");
  const auto failed = test::postproc("summary " + (folder / "run.h5") + " -o " + (folder / "s.json"));
  CHECK(failed.exit_code == 4);
  CHECK(failed.one_error_line("postproc"));
  CHECK_THAT(failed.messages, Contains("s.json.partial: cannot be replaced"));
}

TEST_CASE("a plot ends in .png or .svg, and goes where a link leads") {
  const Studies studies;
  write_complete_study(studies);
  const auto plotted = [&](const std::string& name) {
    return test::postproc(fmt::format("plot {} p --results {} --programmes {} -o {}", studies.path("study.toml"),
                                      studies.path("out"), studies.path("programmes"), studies.path(name)));
  };
  std::filesystem::create_symlink("p.svg", studies.path("link.svg"));
  const auto drawn = plotted("link.svg");
  INFO(drawn.messages);
  CHECK(drawn.exit_code == 0);
  CHECK(std::filesystem::is_symlink(studies.path("link.svg")));
  CHECK_THAT(test::read_text(studies.path("p.svg")), Contains("<svg"));
  const auto refused = plotted("p.jpg");
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.messages, Contains("p.jpg: found the ending '.jpg', allowed: .png or .svg"));
}

TEST_CASE("points of an svg are as large as those of a png, also in the studies' own scripts") {
  const test::Folder folder;
  run_gnuplot(fmt::format("set terminal svg\nset output '{}'\nplot x with points pointtype 5", folder / "gnuplot.svg"));
  const std::string before = test::read_text(folder / "gnuplot.svg"), after = with_points_as_in_png(before);
  CHECK_THAT(before, Contains("<circle id='gpPt5' stroke-width='"));
  CHECK_THAT(after, Contains("<circle id='gpPt5' transform='scale(0.4)' vector-effect='non-scaling-stroke' stroke="));
  CHECK_THAT(after, Contains("'rotate(45) scale(0.7)'/>") && !Contains("id='gpPt7' stroke-width"));
  CHECK(after.substr(after.find("</defs>")) == before.substr(before.find("</defs>")));
  const auto script = test::run_command(fmt::format("sed -E -f {} {}", MPFEM_SVG_POINTS, folder / "gnuplot.svg"));
  CHECK(script.output == after);
}

TEST_CASE("no file from which something of a figure is made is replaced by it") {
  const Studies studies;
  write_complete_study(studies);
  const std::string figure = studies.path("study.toml"), programmes = " --programmes " + studies.path("programmes"),
                    results = " --results " + studies.path("out") + programmes;
  for (const char* picture : {"out/study/p.png", "out/study/p.svg"}) write_text(studies.path(picture), "a picture");
  for (const auto& [command, name] : {std::pair<std::string, std::string>{"powder " + figure + programmes, "more.toml"},
                                      {"powder " + figure + programmes, "programmes/press.toml"},
                                      {"depends " + figure + programmes + " --packing p.h5", "more.toml"},
                                      {"table " + figure + " t" + results, "out/r2/strength.json"},
                                      {"fits " + figure + results, "out/study/t.csv"},
                                      {"verdict " + figure + results, "out/study/t.csv"},
                                      {"verdict " + figure + results, "out/study/fits.json"},
                                      {"verdicts mesh=" + studies.path("out"), "out/study/verdict.json"},
                                      {"report " + figure + " --title x" + results, "out/study/verdict.json"},
                                      {"report " + figure + " --title x" + results, "out/study/t.csv"},
                                      {"report " + figure + " --title x" + results, "out/study/p.png"},
                                      {"report " + figure + " --title x" + results, "out/study/p.svg"}}) {
    const std::string before = test::read_text(studies.path(name));
    const auto outcome = test::postproc(fmt::format("{} -o {}", command, studies.path(name)));
    INFO(command << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    // Most names are refused for their ending already, before anything is read.
    CHECK_THAT(outcome.messages, Contains("would overwrite the input") || Contains("would replace a TOML file") ||
                                     Contains("found the ending"));
    // A link without an ending leads to the same file.
    const std::string link = studies.path("link");
    std::filesystem::create_symlink(studies.path(name), link);
    const auto by_link = test::postproc(fmt::format("{} -o {}", command, link));
    INFO(by_link.messages);
    CHECK(by_link.exit_code == 2);
    CHECK_THAT(by_link.messages, Contains("would overwrite the input") || Contains("would replace a TOML file"));
    std::filesystem::remove(link);
    CHECK(test::read_text(studies.path(name)) == before);
    // Under another name it is written.
    CHECK(test::postproc(fmt::format("{} -o {}", command, studies.path("new"))).exit_code == 0);
  }
}

TEST_CASE("a plot with an empty name of its file is refused") {
  const Studies studies;
  write_complete_study(studies);
  const auto outcome =
      test::postproc(fmt::format("plot {} p --results {} -o ''", studies.path("study.toml"), studies.path("out")));
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Contains("--output: found"));
}

TEST_CASE("a report opens with how many statements of each study agree, and says why one differs") {
  const Studies studies;
  write_text(studies.path("out/fig03/verdict.json"),
             R"([{"statement": "a", "paper": "1", "ours": "2", "agrees": true, "note": ""},
                {"statement": "b", "paper": "1", "ours": "2", "agrees": false, "note": "n", "why": "the <mesh>"}])");
  write_text(studies.path("out/fig04/verdict.json"),
             R"([{"statement": "c", "paper": "1", "ours": "2", "agrees": null, "note": ""}])");
  const std::string page =
      report_page({{"fig03", "bonds", "q"}, {"fig04", "grains", "q"}}, {studies.path("out"), "Studies"});
  CHECK_THAT(page, Contains("<a href=\"#fig03\">bonds</a></td><td>1</td><td>1</td><td>0</td>"));
  CHECK_THAT(page, Contains("<th>all</th><th>1</th><th>1</th><th>1</th>"));
  CHECK_THAT(page, Contains("<td>n; why: the &lt;mesh&gt;</td>"));
  CHECK(page.find("class=\"summary\"") < page.find("id=\"fig03\""));
}

TEST_CASE("a report of a study without statements has no tables of verdicts, and no link to them") {
  const Studies studies;
  write_text(studies.path("out/locking/verdict.json"), "[]");
  const std::string page = report_page({{"locking", "energy", "q"}}, {studies.path("out"), "Locking"});
  for (const std::string text : {"<table", "erdicts", "compare"}) {
    CAPTURE(text);
    CHECK(page.substr(page.find("<body>")).find(text) == std::string::npos);
  }
  CHECK_THAT(page, Contains("<p>q</p>"));
}

TEST_CASE("a report has settings and quality of each run, and links that are relative to its folder") {
  const Studies studies;
  write_text(studies.path("out/study/verdict.json"), "[]");
  write_text(studies.path("out/study/t.csv"), "x\n");
  write_text(studies.path("out/first/work/log.txt"), "");
  test::write_run(studies.path("out/first/run.h5"), test::small_run());
  const Figure figure = studies.figure(chain);
  const auto runs = runs_of_figure(figure, studies.results());
  REQUIRE(runs.size() == 3);
  CHECK(runs[0].name == "first");
  // A run that nothing uses may need values that the cases do not have.
  const std::string unused = "[[runs]]\nname = \"unused\"\nfolder = \"p{pressure}\"\nprogramme = \"press\"\n";
  CHECK(runs_of_figure(studies.figure(chain + unused), studies.results()).size() == 3);
  const std::string page = report_page({{"study", "s", "q", studies.path("study.toml"), runs}},
                                       {studies.path("out"), "Studies", {}, "", studies.path("out/report")});
  CHECK_THAT(page, Contains("Settings and provenance of 3 runs"));
  // of small_run: 48 tets, kinetic over internal energy 2 % under load, residual 0.06 of 4 mJ, 0.96 s on 2 threads
  CHECK_THAT(page, Contains("<td>48</td>") && Contains("<td>2 %</td><td>1.5 %</td><td>0.96 s × 2</td>"));
  CHECK_THAT(page, Contains("<td>second</td><td colspan=\"10\">the run file is not here</td>"));
  CHECK_THAT(page, Contains("<a href=\"../first/work/log.txt\">log</a>"));
  CHECK_THAT(page, Contains("<a href=\"../study/t.csv\">t.csv</a>") && Contains("\"../study/verdict.json\""));
  CHECK_THAT(page, Contains("<a href=\"../../programmes/press.toml\">scenario</a>"));
}

TEST_CASE("pictures of a report have the captions of the figure's file, in its order, and else their file's name") {
  const Studies studies;
  const Figure figure = studies.figure(R"([[cases]]
load = [5, 7]
[[runs]]
name = "press"
programme = "press"
settings = { "stages.0.mean_stress" = "{load}" }
[[tables]]
name = "t"
columns = ["load = {load}"]
[[plots]]
for_each = [{ law = "energy" }]
name = "strength-{law}"
caption = "Strength <MPa> of law {law}."
x = {}
y = {}
series = [{ table = "t", x = "load", y = "load" }]
[[pictures]]
name = "section-{load}.png"
caption = "Section at {load} MPa."
run = "press"
command = "section {run}"
)");
  const auto captions = captions_of_figure(figure, studies.results());
  REQUIRE(captions.size() == 3);
  CHECK(captions[2].file == "section-7.png");
  for (const char* name : {"a-b", "section-5", "section-7", "strength-energy"})
    write_text(studies.path(fmt::format("out/study/{}.png", name)), "");
  write_text(studies.path("out/study/verdict.json"), "[]");
  const std::string page = report_page({{"study", "s", "q", "", {}, captions}}, {studies.path("out"), "S"});
  std::size_t at = 0;
  for (const char* caption : {"Strength &lt;MPa&gt; of law energy.", "Section at 5 MPa.", "Section at 7 MPa.", "a b"}) {
    const std::size_t found = page.find(fmt::format("<figcaption>{} <span", caption));
    INFO(caption);
    REQUIRE(found != std::string::npos);
    CHECK(found > at);
    at = found;
  }
}

TEST_CASE("a report raises exponents and lowers the indices of symbols, and leaves names as they are") {
  const Studies studies;
  write_text(studies.path("out/fig03/verdict.json"), "[]");
  const auto question = [&](const std::string& text) {
    const std::string page = report_page({{"fig03", "bonds", text}}, {studies.path("out"), "S"});
    const std::size_t at = page.find("<p>", page.find("id=\"fig03\""));
    return page.substr(at + 3, page.find("</p>", at) - at - 3);
  };
  CHECK(question("G^c, R^2.") == "G<sup>c</sup>, R<sup>2</sup>.");
  CHECK(question("160 MPa ε^0.4, E^−0.80 and D_r^{max}") ==
        "160 MPa ε<sup>0.4</sup>, E<sup>−0.80</sup> and D<sub>r</sub><sup>max</sup>");
  CHECK(question("(σ_0 < p_c)") == "(σ<sub>0</sub> &lt; p<sub>c</sub>)");
  CHECK(question("`a_b^c` of p_c") == "<code>a_b^c</code> of p<sub>c</sub>");
  CHECK(question("run_1, kinetic_energy, a ^ b, x^ y_") == "run_1, kinetic_energy, a ^ b, x^ y_");
}

TEST_CASE("a report shows the first table of a page beside the verdicts") {
  const Studies studies;
  write_text(studies.path("out/fig03/verdict.json"), "[]");
  write_text(studies.path("page.md"), "# Speed <1>\n\n| a | `b` |\n|---|---|\n| 1 < 2 |  |\n\n| other |\n");
  const std::vector<ReportEntry> entries = {{"fig03", "bonds", "q"}};
  const std::string page = report_page(entries, {studies.path("out"), "S", {}, studies.path("page.md"), ""});
  CHECK_THAT(page, Contains("<h3>Speed &lt;1&gt;</h3>") && Contains("<tr><th>a</th><th><code>b</code></th></tr>") &&
                       Contains(R"(<tr><td data-heading="a">1 &lt; 2</td><td data-heading="b"></td></tr>)") &&
                       !Contains(">other"));
  CHECK_THROWS_WITH(report_page(entries, {studies.path("out"), "S", {}, studies.path("none.md"), ""}),
                    Contains("found no table"));
}
