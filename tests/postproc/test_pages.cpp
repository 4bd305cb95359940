// The page of postproc view in a browser without a window: no errors, and its pixels. Built where chromium is.

#include <filesystem>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bonded_run.hpp"
#include "browser.hpp"
#include "postproc/figure/report.hpp"
#include "postproc/view/view_page.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// The page of a run, with a script that goes on where the page is ready.
std::string page_with(const Folder& folder, const std::string& script, const RunContents& run = small_run()) {
  write_run(folder / "run.h5", run);
  REQUIRE(run_command(fmt::format("'{}' view {} -o {}", MPFEM_POSTPROC, folder / "run.h5", folder / "view.html"))
              .exit_code == 0);
  write_text(folder / "view.html",
             fmt::format("{}<script>const wait = setInterval(() => {{ if (!document.body.dataset.ready) return; "
                         "clearInterval(wait);\n{}\n}}, 20);</script>\n",
                         drawn_by_timers(read_text(folder / "view.html")), script));
  return folder / "view.html";
}

/// Of the part of the window where the grains are: left of the colour bar, above the controls.
double coloured_share(const Image& image) {
  std::size_t count = 0, all = 0;
  for (unsigned int y = image.height / 10; y < image.height * 6 / 10; ++y)
    for (unsigned int x = 0; x < image.width * 8 / 10; ++x, ++all) count += is_coloured(image.at(x, y)) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(all);
}

/// Pixels in the blue of whole bonds, lit or in shade; viridis has none such.
std::size_t blue_pixels(const Image& image) {
  std::size_t count = 0;
  for (unsigned int y = 0; y < image.height; ++y)
    for (unsigned int x = 0; x < image.width; ++x) {
      const auto [r, g, b] = image.at(x, y);
      count += r < 12 && g > 50 && b > 80 && b > g + 20 && b < 195 ? 1 : 0; // the controls are brighter
    }
  return count;
}

/// What the links of a page name.
std::vector<std::string> links_in(const std::string& page) {
  std::vector<std::string> links;
  const std::string mark = "<a href=\"";
  for (std::size_t at = 0; (at = page.find(mark, at)) != std::string::npos;) {
    at += mark.size();
    links.push_back(page.substr(at, page.find('"', at) - at));
  }
  return links;
}

const std::string set = "const set = (id, value) => { const e = document.getElementById(id); e.value = value; "
                        "e.dispatchEvent(new Event('input')); };\n";

} // namespace

TEST_CASE("the page draws the grains without an error, on a desk and on a phone") {
  const Folder folder;
  const std::string page = page_with(folder, "");
  for (const auto& [width, height] : {std::pair{1200, 1000}, std::pair{360, 780}}) {
    const Shown shown = show(folder, page, width, height);
    INFO(width << " pixels wide: " << shown.console);
    CHECK(shown.console.empty());
    CHECK(coloured_share(shown.image) > 0.03);
    CHECK(is_white(shown.image.at(2, shown.image.height / 2)));
  }
}

TEST_CASE("without a cut more of the grains is seen, zoomed in more of the window, and turning changes the picture") {
  const Folder folder;
  const auto share_after = [&](const std::string& script) {
    const Shown shown = show(folder, page_with(folder, set + script), 900, 900);
    CHECK(shown.console.empty());
    return coloured_share(shown.image);
  };
  const double cut = share_after(""), whole = share_after("set('axis', -1);");
  CHECK(whole > 1.1 * cut);
  CHECK(share_after("set('axis', -1); canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -300}));") > 1.2 * whole);
  // From straight above a cube shows one face where it showed three.
  CHECK(share_after("set('axis', -1); for (let i = 0; i < 30; ++i) "
                    "canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowDown'}));") < 0.9 * whole);
}

TEST_CASE("bonds are drawn where they are chosen: in the part that is cut away, and in whole grains") {
  const Folder folder;
  const auto blue_after = [&](const std::string& script) {
    const Shown shown = show(folder, page_with(folder, set + script, bonded_run()), 900, 900);
    INFO(script << ": " << shown.console);
    CHECK(shown.console.empty());
    return blue_pixels(shown.image);
  };
  CHECK(blue_after("set('axis', 1);") < 20);
  CHECK(blue_after("set('axis', 1); set('at', 0.45); set('rods', '01');") > 200);
  CHECK(blue_after("set('axis', -1); set('rods', '01');") > 200);
  CHECK(blue_after("set('axis', -1); set('rods', '2');") < 20); // contacts are grey
}

TEST_CASE("a report is shown without an error, fits a desk and a phone, and its links lead to what they name") {
  const Folder folder;
  write_text(
      folder / "out/fig03/verdict.json",
      R"([{"statement": "strength rises with density", "paper": "yes", "ours": "yes", "agrees": true, "note": ""},
                {"statement": "strength at 0.9", "paper": "1 MPa", "ours": "2 MPa", "agrees": false, "note": "n"}])");
  write_text(folder / "out/fig03/a table.csv", "x\n1\n");
  write_text(folder / "out/fig03/press/work/log.txt", "log");
  write_text(folder / "press.toml", "");
  write_text(folder / "page.md", "# Speed against error\n\n| error | work |\n|---|---|\n| 3 % | 11 s |\n");
  write_run(folder / "out/fig03/press/run.h5", bonded_run());
  const std::string page = folder / "out/report/index.html";
  ReportRequest request{folder / "out", "Studies"};
  request.view = view_page_of_run({folder / "out/fig03/press/run.h5", schema::FileKind::run}, 2, "Grains");
  request.beside = folder / "page.md";
  request.page_folder = folder / "out/report";
  const ReportRun run{"fig03/press", folder / "out/fig03/press/run.h5", folder / "press.toml"};
  // A page wider than its window is an error, which the console tells.
  const std::string check = "<script>window.addEventListener('load', () => { "
                            "if (document.documentElement.scrollWidth > window.innerWidth + 1) "
                            "console.error('too wide: ' + document.documentElement.scrollWidth); });</script>";
  const std::string text = report_page({{"fig03", "Strength", "What rises?", folder / "press.toml", {run}}}, request);
  write_text(page, text + check);
  for (const auto& [width, height] : {std::pair{1200, 1000}, std::pair{500, 900}}) {
    const Shown shown = show(folder, page, width, height);
    INFO(width << " pixels wide: " << shown.console);
    CHECK(shown.console.empty());
  }
  const std::vector<std::string> links = links_in(text);
  CHECK(links.size() == 7); // the figure; the page beside; the table, the verdict, figure.toml; scenario and log
  for (const std::string& link : links) {
    INFO(link);
    if (link.starts_with('#')) {
      CHECK(text.find(fmt::format("id=\"{}\"", link.substr(1))) != std::string::npos);
      continue;
    }
    const std::size_t space = link.find("%20"); // in the name of the table
    const std::string name =
        space == std::string::npos ? link : fmt::format("{} {}", link.substr(0, space), link.substr(space + 3));
    CHECK(std::filesystem::exists(std::filesystem::path(request.page_folder) / name));
  }
}
