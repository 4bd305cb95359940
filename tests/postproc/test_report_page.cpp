// The page of postproc report in a browser without a window. Built where chromium is.

#include <filesystem>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bonded_run.hpp"
#include "browser.hpp"
#include "postproc/figure/report.hpp"
#include "postproc/view/view_page.hpp"

using namespace mpfem;
using namespace mpfem::test;
using nlohmann::json;

namespace {

constexpr int snapshots = 3;

/// The grains of bonded_run() at several snapshots, each lower and denser than the one before; every tet has its own
/// stress and strain.
RunContents pressed_run() {
  RunContents run = bonded_run();
  const std::size_t tets = run.extents.at("tets");
  for (std::size_t i = 0; i < tets; ++i) {
    run.numbers["/snapshots/*/von_mises"].push_back(static_cast<double>(i));
    run.numbers["/snapshots/*/plastic_strain"].push_back(static_cast<double>(i * 37 % tets) / 100);
  }
  run.numbers["/history/kinetic_energy"] = {0.5, 2, 2}; // its status says at length that this is too much
  const std::vector<double> node = run.numbers.at("/snapshots/*/node");
  run.snapshots.clear();
  for (int s = 0; s < snapshots; ++s) {
    run.snapshots.push_back(fmt::format("{:04}", s));
    const std::string folder = fmt::format("/snapshots/{}/", run.snapshots.back());
    run.numbers[folder + "relative_density"] = {0.7 + 0.1 * s};
    run.numbers[folder + "mean_stress"] = {50.0 * s};
    auto& pressed = run.numbers[folder + "node"] = node;
    for (std::size_t i = 2; i < node.size(); i += 3) pressed[i] *= 1 - 0.15 * s;
  }
  return run;
}

/// A report of one study with all that a report can have, in words as long as those of the studies.
struct StudyReport {
  Folder folder;
  std::string page = folder / "out/report/index.html";

  StudyReport() {
    write_results();
    ReportRequest request{folder / "out", "Studies"};
    request.view = [&] {
      return view_page_of_run({run_file(), schema::FileKind::run}, snapshots, "Compaction in three dimensions");
    };
    request.beside = folder / "page.md";
    request.page_folder = folder / "out/report";
    const ReportRun run{"fig03/press", run_file(), folder / "press.toml"};
    const ReportEntry entry{"fig03",
                            "fig03: the traction-separation law, force and displacement",
                            "Does breaking it dissipate exactly the fracture energy G^c, whatever the step size?",
                            folder / "figure.toml",
                            {run},
                            {{"law.png", "Traction of a bond in opening, with unloading and reloading."}}};
    write_text(page, report_page({entry}, request));
  }

  std::string run_file() const { return folder / "out/fig03/press/run.h5"; }

  void write_results() const {
    write_text(folder / "out/fig03/verdict.json",
               R"([{"statement": "The area under the traction rows (trapezoidal) converges to G^c", "paper": "G^c",
                    "ours": "off by 0.07, 0.0007, 7e-06, 1e-07 at 20, 200, 2000, 20000 increments", "agrees": true,
                    "note": "largest of all laws, modes and fracture energies; own requirement: 1e-6 at 20000"},
                   {"statement": "strength at 0.9", "paper": "1 MPa", "ours": "2 MPa", "agrees": false, "note": "n"},
                   {"statement": "s", "paper": "not stated", "ours": "1 MPa", "agrees": null, "note": ""}])");
    write_text(folder / "out/fig03/a table.csv", "x\n1\n");
    write_png(folder / "out/fig03/law.png", {1200, 900, std::vector<std::uint8_t>(3 * 1200 * 900, 200)});
    write_text(folder / "out/fig03/law.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    write_text(folder / "out/fig03/press/work/log.txt", "log");
    write_text(folder / "out/fig03/press/run.settings", "");
    write_text(folder / "press.toml", "");
    write_text(folder / "figure.toml", "");
    write_text(
        folder / "page.md",
        "# Speed against error\n\n"
        "| error of the mean stress to expect | element and contact surface | element size h | walls "
        "| measured at 0.80 and 0.92 | work to compact 329 grains to 0.92 |\n|---|---|---|---|---|---|\n"
        "| for comparison: the paper's mesh | `tet4`, facets | R/4.7 (0.015 mm) | 4 m/s | +10, +12 % | 19 min |\n");
    write_run(run_file(), pressed_run());
  }

  /// The page in a window of this number of pixels, and what a function of report_page.js reports about it.
  Shown ask(const std::string& function, int width, int height) const {
    const std::string with_script = folder / "out/report/asked.html";
    write_text(with_script,
               fmt::format("{}<script>\n{}\nwindow.addEventListener('load', {});\n</script>\n",
                           drawn_by_timers(read_text(page), "&lt;", "&gt;"), read_text(REPORT_PAGE_SCRIPT), function));
    return show(folder, with_script, width, height);
  }
};

std::size_t colours_in(const Image& image) {
  std::set<std::array<int, 3>> colours;
  for (unsigned int y = 0; y < image.height; ++y)
    for (unsigned int x = 0; x < image.width; ++x) colours.insert(image.at(x, y));
  return colours.size();
}

/// The file that an address names: "file:///a%20b#c" is "/a b".
std::filesystem::path file_at(const std::string& address) {
  const std::string begin = "file://";
  REQUIRE(address.starts_with(begin));
  const std::string path = address.substr(begin.size(), address.find_first_of("?#") - begin.size());
  std::string file;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool escaped = path[i] == '%' && i + 2 < path.size();
    file += escaped ? static_cast<char>(std::stoi(path.substr(i + 1, 2), nullptr, 16)) : path[i];
    if (escaped) i += 2;
  }
  return file;
}

/// Every table is within the window, with all that is in it, or in a box there that scrolls to its end.
void check_tables(const json& tables) {
  CHECK(tables.size() == 4); // verdicts, the page beside, statements, runs
  for (const json& table : tables) {
    INFO(table.dump());
    CHECK(table.at("out").get<double>() < 1);
    CHECK(table.at("beyond").get<double>() < 1);
    CHECK(table.at("clipped").empty());
    CHECK(table.at("tallest").get<double>() < 150); // rows of many short lines are hard to read
  }
}

/// All controls are in sight without scrolling in the frame, and large enough for a thumb where there is no mouse.
void check_view(const json& view, bool phone) {
  INFO(view.dump());
  CHECK(view.at("contentWidth") <= view.at("width"));
  CHECK(view.at("contentHeight") <= view.at("height"));
  CHECK(view.at("controls").size() == 6); // snapshot, colour, cut, its position, rods between grains, tools
  for (const json& control : view.at("controls")) {
    INFO(control.dump());
    CHECK(control.at("left") >= 0);
    CHECK(control.at("right") <= view.at("width"));
    CHECK(control.at("bottom") <= view.at("height"));
    CHECK(control.at("width") > (control.at("name") == "tools" ? 12 : 120)); // of a box to tick, and of the others
    CHECK(control.at("height") >= (phone ? 32 : 12));
  }
  const double width = view.at("width"), canvas = view.at("canvas").at("width");
  CHECK(canvas > (phone ? 0.9 : 0.75) * width);
  CHECK(view.at("canvas").at("height") >= 250);
}

/// A plot's letters, a fortieth of its width, can be read once it is large, in a separate box.
void check_picture(const json& picture, int width) {
  INFO(picture.dump());
  CHECK(picture.at("before") > std::min(0.9 * width, 550.0));
  CHECK(picture.at("after") >= 760);
  CHECK(picture.at("scrolls") == true);
  CHECK(picture.at("contentWidth") <= width);
}

} // namespace

TEST_CASE(
    "the grains in a report are drawn, and change when turned, cut, coloured by another field or at another time") {
  const StudyReport report;
  const Shown shown = report.ask("tellPixels", 1280, 900);
  INFO(shown.console);
  CHECK(shown.console.empty());
  REQUIRE(shown.found.size() == 1);
  const json& seen = shown.found[0];
  INFO(seen.dump(1));
  const auto number = [&](const char* step, const char* what) { return seen.at(step).at(what).get<double>(); };
  // A blank canvas has one colour, flat shapes as many as there are shapes and edges: shades are many more.
  CHECK(number("at first", "colours") > 2000);
  CHECK(number("at first", "covered") > 0.05);
  // Chromium without a graphics card draws edges of lines a bit differently every time: 0.2 % of the pixels at most.
  CHECK(number("left alone", "changed") < 0.01);
  for (const char* step : {"turned", "cut elsewhere", "cut along x", "whole", "other field", "grain by grain",
                           "field again", "other snapshot"}) {
    INFO(step);
    CHECK(number(step, "changed") > 0.03);
  }
  CHECK(number("whole", "covered") > 1.1 * number("at first", "covered"));
  // Colours leave the shape as it is. Grains have one colour each, in shades.
  for (const char* step : {"other field", "grain by grain", "field again"})
    CHECK(std::abs(number(step, "covered") - number("whole", "covered")) < 0.002);
  CHECK(number("grain by grain", "colours") < 0.5 * number("whole", "colours"));
  // The first snapshot is the highest, and has the lowest density.
  CHECK(number("other snapshot", "covered") > 1.1 * number("whole", "covered"));
  CHECK(seen.at("at first").at("state") == "snapshot 3 of 3: relative density 0.900, mean stress 100 MPa");
  CHECK(seen.at("other snapshot").at("state") == "snapshot 1 of 3: relative density 0.700, mean stress 0 MPa");
  CHECK(colours_in(shown.image) > 2000); // the browser puts them into its window
}

TEST_CASE("a report fits a desk and phones of 360 and 430 pixels, its tables scroll, its controls are in sight") {
  const StudyReport report;
  for (const auto& [width, height] : {std::pair{1280, 900}, std::pair{430, 930}, std::pair{360, 780}}) {
    const Shown shown = report.ask("tellLayout", width, height);
    INFO(width << " pixels wide: " << shown.console);
    CHECK(shown.console.empty());
    REQUIRE(shown.found.size() == 1);
    const json& layout = shown.found[0];
    CHECK(layout.at("width") == width);
    CHECK(layout.at("contentWidth") <= width);
    for (const json& text : {layout.at("smallest"), layout.at("view").at("smallest")}) {
      INFO(text.dump());
      CHECK(text.at("pixels") >= 12);
    }
    check_tables(layout.at("tables"));
    check_view(layout.at("view"), width < 768);
    check_picture(layout.at("picture"), width);
  }
}

TEST_CASE("links of a report lead to places that are there: its studies, their tables, scenarios, settings and logs") {
  const StudyReport report;
  const Shown shown = report.ask("tellLinks", 1280, 900);
  INFO(shown.console);
  CHECK(shown.console.empty());
  REQUIRE(shown.found.size() == 1);
  std::multiset<std::string> texts;
  for (const json& link : shown.found[0]) {
    INFO(link.dump());
    texts.insert(link.at("text"));
    if (link.at("inside") == true)
      CHECK(link.at("leads") == true);
    else
      CHECK(std::filesystem::is_regular_file(file_at(link.at("url"))));
  }
  CHECK(texts == std::multiset<std::string>{"fig03: the traction-separation law, force and displacement",
                                            "all tables and conditions", "PNG", "SVG", "a table.csv", "verdict.json",
                                            "figure.toml", "all verdicts", "scenario", "settings", "log"});
}
