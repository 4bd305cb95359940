#pragma once
// Pages in a browser without a window: their pixels, what they complain about, and what a test's script found in them.

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/folder.hpp"
#include "tests/support/png_image.hpp"

namespace mpfem::test {

/// Chromium makes no window narrower than this. A narrower page is shown in a frame of such a window.
constexpr int narrowest_window = 500;

struct Shown {
  Image image;                       ///< the window; a narrower page has its left part
  std::string console;               ///< what the page's own script reported
  std::vector<nlohmann::json> found; ///< what scripts of the test told: console.log('found: ' + JSON)
};

/// Sorts a line of the browser: found by a test, a complaint of the page, or neither.
inline void sort_line(const std::string& line, Shown& shown) {
  const std::size_t at = line.find("CONSOLE");
  if (at == std::string::npos) return;
  const std::string mark = "\"found: ";
  const std::size_t begin = line.find(mark), end = line.rfind("\", source: ");
  if (begin == std::string::npos || end == std::string::npos)
    shown.console += line.substr(at) + "\n";
  else
    shown.found.push_back(nlohmann::json::parse(line.substr(begin + mark.size(), end - begin - mark.size())));
}

/// Lets timers draw a page's pictures. Chromium's virtual time does not wait for the next picture, so that a slow
/// machine would show the page before it has drawn. `head`: the tag, as the page has it, where its own script begins.
inline std::string drawn_by_timers(std::string page, const std::string& open = "<", const std::string& close = ">") {
  const std::string head = open + "head" + close;
  const std::size_t at = page.find(head);
  REQUIRE(at != std::string::npos);
  const std::string script = "window.requestAnimationFrame = act => setTimeout(act, 16);";
  return page.insert(at + head.size(), fmt::format("{0}script{1}{2}{0}/script{1}", open, close, script));
}

/// The address of a page that holds another in a frame of so many pixels.
inline std::string in_frame(const Folder& folder, const std::string& page, int width, int height) {
  write_text(folder / "frame.html",
             fmt::format("<!DOCTYPE html>\n<link rel=\"icon\" href=\"data:,\">\n<body style=\"margin: 0\">\n<iframe "
                         "src=\"file://{}\" style=\"width: {}px; height: {}px; border: 0; display: block\"></iframe>",
                         page, width, height));
  return folder / "frame.html";
}

/// A page in a window of so many pixels, once it has come to rest.
inline Shown show(const Folder& folder, const std::string& page, int width, int height) {
  const std::string address = width < narrowest_window ? in_frame(folder, page, width, height) : page;
  const Outcome outcome = run_command(fmt::format(
      "timeout 100 '{}' --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --hide-scrollbars --virtual-time-budget=30000 --enable-logging=stderr "
      "--user-data-dir={} --window-size={},{} --screenshot={} file://{}",
      CHROMIUM, folder / "profile", std::max(width, narrowest_window), height, folder / "shot.png", address));
  REQUIRE(outcome.exit_code == 0);
  Shown shown;
  shown.image = read_png(folder / "shot.png");
  std::istringstream lines(outcome.messages);
  for (std::string line; std::getline(lines, line);) sort_line(line, shown);
  return shown;
}

} // namespace mpfem::test
