// The page of postproc view in a browser without a window: no errors, and its pixels. Built where chromium is.

#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/png_image.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

struct Shown {
  Image image;
  std::string console; ///< what the page's script reported
};

/// A page in a window of so many pixels, once it has come to rest.
Shown show(const Folder& folder, const std::string& page, int width, int height) {
  const Outcome outcome = run_command(
      fmt::format("timeout 100 '{}' --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader "
                  "--enable-unsafe-swiftshader --hide-scrollbars --virtual-time-budget=30000 --enable-logging=stderr "
                  "--user-data-dir={} --window-size={},{} --screenshot={} file://{}",
                  CHROMIUM, folder / "profile", width, height, folder / "shot.png", page));
  REQUIRE(outcome.exit_code == 0);
  Shown shown{read_png(folder / "shot.png"), ""};
  for (std::size_t at = 0; (at = outcome.messages.find("CONSOLE", at)) != std::string::npos; ++at)
    shown.console += outcome.messages.substr(at, outcome.messages.find('\n', at) - at) + "\n";
  return shown;
}

/// The page of small_run, with a script that goes on where the page is ready.
std::string page_with(const Folder& folder, const std::string& script) {
  write_run(folder / "run.h5", small_run());
  REQUIRE(run_command(fmt::format("'{}' view {} -o {}", MPFEM_POSTPROC, folder / "run.h5", folder / "view.html"))
              .exit_code == 0);
  std::ofstream page(folder / "view.html", std::ios::app);
  page << "<script>const wait = setInterval(() => { if (!document.body.dataset.ready) return; clearInterval(wait);\n"
       << script << "\n}, 20);</script>\n";
  return folder / "view.html";
}

/// Of the part of the window where the grains are: left of the colour bar, above the controls.
double coloured_share(const Image& image) {
  std::size_t count = 0, all = 0;
  for (unsigned int y = image.height / 10; y < image.height * 6 / 10; ++y)
    for (unsigned int x = 0; x < image.width * 8 / 10; ++x, ++all) count += is_coloured(image.at(x, y)) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(all);
}

const std::string set = "const set = (id, value) => { const e = document.getElementById(id); e.value = value; "
                        "e.dispatchEvent(new Event('input')); };\n";

} // namespace

TEST_CASE("the page draws the grains without an error, on a desk and on a phone") {
  const Folder folder;
  const std::string page = page_with(folder, "");
  for (const auto& [width, height] : {std::pair{1200, 1000}, std::pair{500, 900}}) {
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
