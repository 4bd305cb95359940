// postproc picture: pictures as files, by what their pixels are. Built where VTK is.

#include <algorithm>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/folder.hpp"
#include "tests/support/png_image.hpp"
#include "tool_run.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Outcome picture(const std::string& arguments) {
  return run_command(fmt::format("'{}' picture {}", MPFEM_POSTPROC, arguments));
}

} // namespace

TEST_CASE("a picture has the requested size, the cube in the middle on white, and a colour bar at the right") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const Outcome outcome =
      picture(fmt::format("{} --size 600x500 --cut none -o {}", folder / "run.h5", folder / "p.png"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const Image image = read_png(folder / "p.png");
  CHECK(image.width == 600);
  CHECK(image.height == 500);
  CHECK(is_white(image.at(5, 5)));
  CHECK(is_white(image.at(5, 494)));
  CHECK(is_coloured(image.at(250, 270)));
  // The bar: dark violet below, yellow above (viridis).
  const auto low = image.at(520, 396), high = image.at(520, 104);
  CHECK((low[2] > low[1] && low[0] < 100));
  CHECK((high[0] > 200 && high[1] > 200 && high[2] < 100));
}

TEST_CASE("a cut removes what lies in front of it, and its face shows the inside") {
  const Folder folder;
  RunContents run = small_run();
  run.numbers["/snapshots/*/von_mises"].assign(48, 1.0);
  write_run(folder / "run.h5", run);
  const auto share = [&](const std::string& cut) {
    const std::string path = folder / (cut + ".png");
    REQUIRE(picture(fmt::format("{} --size 400x400 --cut {} --color grain -o {}", folder / "run.h5", cut, path))
                .exit_code == 0);
    return read_png(path).share(is_coloured);
  };
  const double whole = share("none"), octant = share("octant"), half = share("y");
  CHECK(whole > 0.1);
  CHECK(half < 0.85 * whole);                     // half of the cube is gone; its outline shrinks by less than half
  CHECK(std::abs(octant - whole) < 0.05 * whole); // an open corner is seen against the faces behind it
}

TEST_CASE("grains with any numbers are outlined") {
  const Folder folder;
  RunContents run = small_run();
  const auto share_of_black = [&](const std::string& name) {
    run.numbers["/snapshots/*/von_mises"].assign(48, 1.0);
    write_run(folder / (name + ".h5"), run);
    const std::string path = folder / (name + ".png");
    REQUIRE(picture(fmt::format("{} --size 400x400 --color von_mises --range 0,1 -o {}", folder / (name + ".h5"), path))
                .exit_code == 0);
    return read_png(path).share([](const auto& c) { return c[0] < 100 && c[1] < 100 && c[2] < 100; });
  };
  const double first = share_of_black("first");
  CHECK(first > 0.01);
  // The same two grains as numbers 60 and 61, after sixty without elements.
  run.extents["grains"] = 62;
  for (const char* offset : {"/mesh/grain_tet_offset", "/mesh/grain_node_offset"})
    run.numbers[offset].insert(run.numbers[offset].begin(), 60, 0.0);
  CHECK(share_of_black("late") == first);
}

TEST_CASE("rigid tools are drawn, unless they are not wanted") {
  const Folder folder;
  write_run(folder / "die.h5", die_run());
  const auto share_of_white = [&](const std::string& options) {
    const std::string path = folder / "p.png";
    REQUIRE(picture(fmt::format("{} --size 400x400 {} -o {}", folder / "die.h5", options, path)).exit_code == 0);
    return read_png(path).share(is_white);
  };
  CHECK(share_of_white("") < 0.7);
  CHECK(share_of_white("--without-tools") > 0.7);
}

TEST_CASE("without -o the picture is named after the run, and an existing one is not overwritten") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  REQUIRE(picture(folder / "run.h5" + " --size 200x200").exit_code == 0);
  const Outcome again = picture(folder / "run.h5" + " --size 200x200");
  CHECK(again.exit_code == 2);
  CHECK(again.messages.find("run.png: already exists") != std::string::npos);
}

TEST_CASE("frames are one picture for each snapshot") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  REQUIRE(picture(fmt::format("{} --size 200x200 --frames {}", folder / "run.h5", folder / "film")).exit_code == 0);
  CHECK(read_png(folder / "film/0000.png").width == 200);
}

TEST_CASE("where a picture goes is checked before the run is read") {
  const Folder folder;
  write_text(folder / "run.h5", "no HDF5");
  write_text(folder / "run.png", "a picture");
  const Outcome named = picture(folder / "run.h5");
  CHECK(named.exit_code == 2);
  CHECK(named.messages.find("run.png: already exists") != std::string::npos);
  const Outcome both = picture("--size 200x200");
  CHECK(both.exit_code == 2);
  CHECK(both.messages.find("found neither of RUN.h5 and --packing") != std::string::npos);
}

TEST_CASE("what cannot be drawn is refused in one line") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const std::pair<const char*, const char*> mistakes[] = {
      {"--size 10x10", "--size: found '10x10'"},
      {"--size big", "--size: found 'big'"},
      {"--range 3,2", "--range: found '3,2'"},
      {"--color damage", "the run has no bonds"},
      {"--cut none --bonds", "--bonds: found --cut"},
      {"--cut none --contacts", "--contacts: found --cut"},
      {"--cut none --cut-at 0.3", "--cut-at: found with --cut none, allowed: with a cut"},
      {"--color grain --range 0,1", "--range: found with the colours 'grain', which have no scale"},
      {"--frames film --snapshot 0", "--snapshot: found together with --frames"},
      {"--bonds", "the run has no bonds"},
      {"--cut w", "--cut: found 'w', allowed: octant, x, y, z, none"},
      {"--color height", "--color"}};
  for (const auto& [options, message] : mistakes) {
    const Outcome outcome = picture(fmt::format("{} {} -o {}", folder / "run.h5", options, folder / "p.png"));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.messages.find(message) != std::string::npos);
    CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
  }
}
