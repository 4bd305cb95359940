// The page of postproc view in a browser without a window: no errors, and its pixels. Built where chromium is.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bonded_run.hpp"
#include "browser.hpp"

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
  CHECK(blue_after("set('axis', 1); set('at', 0.45); set('rods', '012');") > 200);
  CHECK(blue_after("set('axis', -1); set('rods', '012');") > 200);
  CHECK(blue_after("set('axis', -1); set('rods', '3');") < 20); // contacts are grey
}
