// Malformed descriptions of packings and tables of spheres, given to the readers of pack-gen, and some to pack-gen
// itself: it takes a fifth of a second to load.

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "folder.hpp"
#include "limited_program.hpp"
#include "malformed_toml.hpp"
#include "pack-gen/packing_description.hpp"
#include "pack-gen/sphere_import.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const char* const table_description = R"(count = 25
relative_density = 0.45
box = [0.43, 0.43, 0.43]
smallest_gap = 0.003
seed = 1
size_scale_tolerance = 0.02
[size_distribution]
kind = 'table'
measure = 'diameter'
weight = 'volume'
values = [0.1, 0.2]
cumulative = [0.0, 1.0]
)";

const char* const log_normal_description = R"(count = 25
relative_density = 0.45
box = [0.43, 0.43, 0.43]
smallest_gap = 0.003
[size_distribution]
kind = 'log_normal'
measure = 'radius'
weight = 'number'
median = 0.07
log_deviation = 0.2
smallest = 0.05
largest = 0.1
)";

const std::string damaged_packing = std::string("\x89HDF\r\n\x1a\n", 8) + "what was there before";

/// The message of a body that refuses its input, or what it does instead.
template <class Body>
std::string message_of(Body body) {
  try {
    body();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(taken)";
}

std::string description_message(const std::string& text) {
  return message_of([&] { draw_sizes(read_packing_description(TomlDocument::from_text(text, "powder.toml"))); });
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

} // namespace

TEST_CASE("A description with one spoilt value is refused with file, key and line") {
  const Folder folder;
  write_text(folder / "p.h5", damaged_packing);
  std::size_t number = 0;
  for (const char* good : {table_description, log_normal_description})
    for (MalformedText& document : spoilt_documents(good)) {
      INFO(document.what);
      document.names.push_back("powder.toml");
      CHECK(fault_of_message(description_message(document.text), document.names) == "");
      if (++number % 16 != 0) continue;
      write_text(folder / "powder.toml", document.text);
      CHECK(fault_of_refusal(MPFEM_PACK_GEN, {"spheres", folder / "powder.toml", "-o", folder / "p.h5"},
                             document.names) == "");
      CHECK(read_text(folder / "p.h5") == damaged_packing);
    }
}

TEST_CASE("A description that is no document is refused") {
  for (MalformedText& document : hopeless_documents()) {
    INFO(document.what);
    document.names.push_back("powder.toml");
    CHECK(fault_of_message(description_message(document.text), document.names) == "");
  }
}

TEST_CASE("A description whose sizes do not fit together is refused by what does not") {
  for (const auto& [from, to, name] : std::vector<std::array<std::string, 3>>{
           {"count = 25", "count = 0", "count"},
           {"count = 25", "count = -1", "count"},
           {"count = 25", "count = 9223372036854775807", "count"},
           {"count = 25", "count = 1e9", "count"},
           {"count = 25", "count = 10000000", "count"},
           {"relative_density = 0.45", "relative_density = 0", "relative_density"},
           {"relative_density = 0.45", "relative_density = 0.75", "relative_density"},
           {"relative_density = 0.45", "relative_density = 1e-300", "relative_density"},
           {"box = [0.43, 0.43, 0.43]", "box = [0.43, 0.43]", "box"},
           {"box = [0.43, 0.43, 0.43]", "box = [0, 0.43, 0.43]", "box"},
           {"box = [0.43, 0.43, 0.43]", "box = [1e300, 1e300, 1e300]", "box"},
           {"box = [0.43, 0.43, 0.43]", "container = 'cylinder'\ndiameter = 0.43", "height"},
           {"box = [0.43, 0.43, 0.43]", "container = 'cylinder'\ndiameter = 0\nheight = 1", "diameter"},
           {"box = [0.43, 0.43, 0.43]", "container = 'cylinder'\ndiameter = 1e300\nheight = 1", "diameter"},
           {"box = [0.43, 0.43, 0.43]", "container = 'sphere'\ndiameter = 1", "container"},
           {"box = [0.43, 0.43, 0.43]", "box = [0.43, 0.43, 0.43]\nheight = 1", "height"},
           {"box = [0.43, 0.43, 0.43]", "box = [1, 1, 1]\ncontainer = 'cylinder'\ndiameter = 1\nheight = 1", "box"},
           {"smallest_gap = 0.003", "smallest_gap = 0", "smallest_gap"},
           {"seed = 1", "seed = -1", "seed"},
           {"seed = 1", "seed = 1.5", "seed"},
           {"values = [0.1, 0.2]", "values = []", "size"},
           {"values = [0.1, 0.2]", "values = [0.2, 0.1]", "size"},
           {"values = [0.1, 0.2]", "values = [0.1]", "size"},
           {"values = [0.1, 0.2]", "values = [-0.1, 0.2]", "values"},
           {"values = [0.1, 0.2]", "values = [1e-300, 0.2]", "values"},
           {"values = [0.1, 0.2]", "file = 'none.csv'", "file"},
           {"values = [0.1, 0.2]\ncumulative = [0.0, 1.0]", "file = '/dev/zero'", "/dev/zero"},
           {"values = [0.1, 0.2]\ncumulative = [0.0, 1.0]", "file = '.'", "folder"},
           {"values = [0.1, 0.2]\ncumulative = [0.0, 1.0]", "file = \"a\\u0000b\"", "zero byte"},
           {"cumulative = [0.0, 1.0]", "cumulative = [0.0, 0.9]", "cumulative"},
           {"cumulative = [0.0, 1.0]", "cumulative = [1.0, 0.0]", "cumulative"},
           {"cumulative = [0.0, 1.0]", "cumulative = [0.0, 2.0]", "cumulative"},
           {"kind = 'table'", "kind = 'list'", "weight"},
       }) {
    INFO(to);
    CHECK(fault_of_message(description_message(changed(table_description, from, to)), {"powder.toml", name}) == "");
  }
  for (const auto& [from, to] : std::vector<std::array<std::string, 2>>{
           {"median = 0.07", "median = 1e9"},
           {"log_deviation = 0.2", "log_deviation = 1e-300"},
           {"smallest = 0.05", "smallest = 0.2"},
           {"largest = 0.1", "largest = 0.01"},
       }) {
    INFO(to);
    CHECK(fault_of_message(description_message(changed(log_normal_description, from, to)), {"powder.toml"}) == "");
  }
}

TEST_CASE("A table that holds no spheres is refused with file and line") {
  const Folder folder;
  write_text(folder / "s.h5", damaged_packing);
  const std::string endless(100'000, 'x');
  std::size_t number = 0;
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
           {"", "no rows"},
           {"x,y,z,radius\n", "no rows"},
           {"x,y,radius,z\n0,0,1,0\n", ":1"},
           {"x,y,z\n0,0,0\n", ":1"},
           {"0,0,0\n", ":1"},
           {"0,0,0,1,1\n", ":1"},
           {"0,0,0,0\n", ":1"},
           {"0,0,0,-1\n", ":1"},
           {"0,0,0,nan\n", ":1"},
           {"0,0,0,inf\n", ":1"},
           {"0,0,0,1e300\n", ":1"},
           {"0,0,0,1e-300\n", ":1"},
           {"0,0,1e300,1\n", ":1"},
           {"0,-inf,0,1\n", ":1"},
           {"nan,0,0,1\n", ":1"},
           {"0,0,0,1\nx,y,z,radius\n", ":2"},
           {"0,0,0,1\n3,0,0,1e\n", ":2"},
           {"0,0,0,1\n3,0,0,0x1\n", ":2"},
           {"0,0,0,1\n3;0;0;1\n", ":2"},
           {"0,0,0,1\n3,0,0," + endless + "\n", ":2"},
           {endless, ":1"},
           {std::string(100'000, ','), ":1"},
           {std::string(1000, '\0'), ":1"},
           {"\xff\xfe,0,0,1\n", ":1"},
           {"0,0,0,1\n0,0,0,1\n", "overlap"},
           {"0,0,0,1\n1,0,0,1\n", "overlap"},
           {"0,0,0,1\n0,0,0.1,1e-9\n", "overlap"},
       }) {
    INFO(text.substr(0, 60));
    write_text(folder / "s.csv", text);
    const std::string message =
        message_of([&] { refuse_overlap(import_spheres(folder / "s.csv", std::nullopt).packing, folder / "s.csv"); });
    CHECK(fault_of_message(message, {"s.csv", name}) == "");
    if (++number % 4 != 0) continue;
    CHECK(fault_of_refusal(MPFEM_PACK_GEN, {"import", folder / "s.csv", "-o", folder / "s.h5"}, {"s.csv", name}) == "");
    CHECK(read_text(folder / "s.h5") == damaged_packing);
  }
}

TEST_CASE("Very many spheres in one place are refused at the first overlap") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += "1,1,1,0.5\n";
  write_text(folder / "s.csv", text);
  CHECK(fault_of_refusal(MPFEM_PACK_GEN, {"import", folder / "s.csv", "-o", folder / "s.h5"}, {"s.csv", "overlap"}) ==
        "");
}

TEST_CASE("Very many small spheres beside a large one are imported in a few seconds") {
  const Folder folder;
  std::string text = "0.5,0.5,0.5,0.4\n";
  for (int i = 0; i < 100'000; ++i)
    text +=
        fmt::format("{},{},{},1e-7\n", 0.01 + 3e-7 * (i % 50), 0.01 + 3e-7 * (i / 50 % 50), 0.01 + 3e-7 * (i / 2500));
  write_text(folder / "s.csv", text);
  const LimitedOutcome outcome =
      run_limited(MPFEM_PACK_GEN, {"import", folder / "s.csv", "--box", "1,1,1", "-o", folder / "s.h5"});
  CHECK(outcome.in_time);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("Spheres that touch are imported with numbers rounded to any digit") {
  const Folder folder;
  for (const char* text :
       {"0.1,0,0,0.1\n0.3,0,0,0.1\n", "0.7,0.1,0.3,0.1\n0.7,0.1,0.6,0.2\n", "0,0,0,0.3\n0.9,0,0,0.6\n"}) {
    INFO(text);
    write_text(folder / "s.csv", text);
    CHECK(message_of([&] { refuse_overlap(import_spheres(folder / "s.csv", std::nullopt).packing, "s.csv"); }) ==
          "(taken)");
  }
  write_text(folder / "s.csv", "0,0,0,1\n1.999999,0,0,1\n");
  CHECK(message_of([&] { refuse_overlap(import_spheres(folder / "s.csv", std::nullopt).packing, "s.csv"); }) !=
        "(taken)");
}

TEST_CASE("A table of spheres that is no regular file is refused at once") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const std::string& path : {folder / "pipe", folder / "", folder / "none", std::string("/dev/zero")}) {
    INFO(path);
    CHECK(fault_of_refusal(MPFEM_PACK_GEN, {"import", path, "-o", folder / "s.h5"}, {path}) == "");
    CHECK(fault_of_refusal(MPFEM_PACK_GEN, {"spheres", path, "-o", folder / "s.h5"}, {path}) == "");
  }
}
