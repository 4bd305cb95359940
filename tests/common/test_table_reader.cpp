#include <cstdio>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/table_reader.hpp"
#include "one_line_error.hpp"

using namespace mpfem;
using test::input_error;

namespace {

TomlDocument parse(std::string_view text) {
  return TomlDocument::from_text(text, "case.toml");
}

/// The message of `read` on the document's root table.
template <class Read>
std::string mistake(std::string_view text, Read read) {
  const TomlDocument document = parse(text);
  TableReader table(document);
  return input_error([&] { read(table); });
}

} // namespace

TEST_CASE("A good document is read value by value") {
  const TomlDocument document = parse(R"(
whole = 3
size = 0.25
small = 1e-300
flag = true
name = "Größe"
mode = "rigid"
lengths = [1, 2.5, 3]
direction = [0, 0, -1]
points = [[0, 0, 0], [1, 2, 3.5]]
words = ["a", "b"]
[inner]
depth = 1
[[stage]]
name = "first"
[[stage]]
name = "second"
)");
  TableReader table(document);
  CHECK(table.has("whole"));
  CHECK(!table.has("absent"));
  CHECK(table.integer("whole") == 3);
  CHECK(table.number("whole") == 3.0);
  CHECK(table.number("size", Range::positive()) == 0.25);
  CHECK(table.optional_number("small") == 1e-300);
  CHECK(table.boolean_or("flag", false));
  CHECK(table.string("name") == "Größe");
  CHECK(table.choice("mode", {"free", "rigid"}) == "rigid");
  CHECK(table.numbers("lengths") == std::vector<double>{1, 2.5, 3});
  CHECK(table.vector3("direction") == std::array<double, 3>{0, 0, -1});
  CHECK(table.vectors3("points") == std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 2, 3.5}});
  CHECK(table.strings_or("words", {}) == std::vector<std::string>{"a", "b"});
  TableReader inner = table.table("inner");
  CHECK(inner.integer("depth") == 1);
  CHECK_NOTHROW(inner.finish());
  std::vector<TableReader> stages = table.tables("stage");
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].string("name") == "first");
  CHECK(stages[1].string("name") == "second");
  CHECK_NOTHROW(table.finish());
}

TEST_CASE("An absent key takes its default, and reading it makes it a known key") {
  const TomlDocument document = parse("");
  TableReader table(document);
  CHECK(table.number_or("a", 2.5) == 2.5);
  CHECK(table.integer_or("b", 4) == 4);
  CHECK(table.boolean_or("c", true));
  CHECK(table.string_or("d", "word") == "word");
  CHECK(table.choice_or("e", "x", {"x", "y"}) == "x");
  CHECK(table.numbers_or("f", {1, 2}) == std::vector<double>{1, 2});
  CHECK(table.vector3_or("g", {1, 2, 3}) == std::array<double, 3>{1, 2, 3});
  CHECK(table.strings_or("h", {"w"}) == std::vector<std::string>{"w"});
  CHECK(table.optional_number("i") == std::nullopt);
  CHECK(!table.optional_table("j"));
  CHECK(table.tables("k").empty());
  CHECK(table.vectors3("l").empty());
  CHECK_NOTHROW(table.finish());
}

TEST_CASE("A value of the wrong type is named with place, key, what was found and what is expected") {
  CHECK(mistake("\n  a = 'x'", [](auto& t) { t.number("a"); }) ==
        "case.toml:2:7: key 'a': found the string 'x', allowed: a number");
  CHECK(mistake("a = true", [](auto& t) { t.number("a", Range::positive()); }) ==
        "case.toml:1:5: key 'a': found true, allowed: a number > 0");
  CHECK(mistake("a = 2.0", [](auto& t) { t.integer("a"); }) == "case.toml:1:5: key 'a': found 2, allowed: an integer");
  CHECK(mistake("a = 1", [](auto& t) { t.boolean_or("a", true); }) ==
        "case.toml:1:5: key 'a': found 1, allowed: true or false");
  CHECK(mistake("a = 1", [](auto& t) { t.string("a"); }) == "case.toml:1:5: key 'a': found 1, allowed: a string");
  CHECK(mistake("a = 1", [](auto& t) { t.string_or("a", ""); }) ==
        "case.toml:1:5: key 'a': found 1, allowed: a string");
  CHECK(mistake("a = [1]", [](auto& t) {
          t.choice("a", {"x", "y"});
        }) == "case.toml:1:5: key 'a': found an array, allowed: one of 'x', 'y'");
  CHECK(mistake("a = 1", [](auto& t) { t.numbers("a"); }) ==
        "case.toml:1:5: key 'a': found 1, allowed: an array of numbers");
  CHECK(mistake("a = [1, 2,\n 'x']", [](auto& t) { t.numbers("a"); }) ==
        "case.toml:2:2: key 'a.2': found the string 'x', allowed: a number");
  CHECK(mistake("a = ['x', 1]", [](auto& t) { t.strings_or("a", {}); }) ==
        "case.toml:1:11: key 'a.1': found 1, allowed: a string");
  CHECK(mistake("a = 1", [](auto& t) { t.table("a"); }) == "case.toml:1:5: key 'a': found 1, allowed: a table [a]");
  CHECK(mistake("a = 1", [](auto& t) { t.optional_table("a"); }) ==
        "case.toml:1:5: key 'a': found 1, allowed: a table [a]");
  CHECK(mistake("a = 1", [](auto& t) { t.tables("a"); }) ==
        "case.toml:1:5: key 'a': found 1, allowed: an array of tables [[a]]");
  CHECK(mistake("a = [{}, 1]", [](auto& t) { t.tables("a"); }) ==
        "case.toml:1:10: key 'a.1': found 1, allowed: a table");
  CHECK(mistake("a = 2020-01-01", [](auto& t) { t.number("a"); }) ==
        "case.toml:1:5: key 'a': found a date or time, allowed: a number");
}

TEST_CASE("A table in place of an array of tables is a mistake") {
  CHECK(mistake("[stage]\nb = 1", [](auto& t) { t.tables("stage"); }) ==
        "case.toml:1:1: key 'stage': found a table, allowed: an array of tables [[stage]]");
  CHECK(mistake("[[box]]\nb = 1", [](auto& t) { t.table("box"); }) ==
        "case.toml:1:1: key 'box': found an array of tables, allowed: a table [box]");
}

TEST_CASE("A value out of range is named with the range") {
  CHECK(mistake("a = -1", [](auto& t) { t.number("a", Range::positive()); }) ==
        "case.toml:1:5: key 'a': found -1, allowed: > 0");
  CHECK(mistake("a = 0.0", [](auto& t) { t.number("a", Range::positive()); }) ==
        "case.toml:1:5: key 'a': found 0, allowed: > 0");
  CHECK(mistake("a = -1e-9", [](auto& t) { t.number_or("a", 1, Range::non_negative()); }) ==
        "case.toml:1:5: key 'a': found -1e-09, allowed: ≥ 0");
  CHECK(mistake("a = 1.5", [](auto& t) { t.optional_number("a", Range::between(0, 1)); }) ==
        "case.toml:1:5: key 'a': found 1.5, allowed: 0 … 1");
  CHECK(mistake("a = 9", [](auto& t) { t.integer("a", Range::between(1, 8)); }) ==
        "case.toml:1:5: key 'a': found 9, allowed: 1 … 8");
  CHECK(mistake("a = 9", [](auto& t) { t.integer_or("a", 1, Range::between(1, 8)); }) ==
        "case.toml:1:5: key 'a': found 9, allowed: 1 … 8");
  CHECK(mistake("a = [1, 0]", [](auto& t) { t.numbers_or("a", {}, Range::positive()); }) ==
        "case.toml:1:9: key 'a.1': found 0, allowed: > 0");
  CHECK(mistake("a = 0.5", [](auto& t) { t.number("a", {.low = 0, .high = 0.5, .high_open = true}); }) ==
        "case.toml:1:5: key 'a': found 0.5, allowed: ≥ 0 and < 0.5");
}

TEST_CASE("A range contains its closed ends and not its open ones") {
  CHECK(Range::between(0, 1).contains(0));
  CHECK(Range::between(0, 1).contains(1));
  CHECK(!Range::positive().contains(0));
  CHECK(Range::positive().contains(1e-300));
  CHECK(Range::any().contains(-1e308));
  CHECK(Range::any().text().empty());
}

TEST_CASE("Numbers that are not finite are refused everywhere") {
  const std::string value = GENERATE("nan", "inf", "-inf", "+nan");
  CHECK_THAT(mistake("a = " + value, [](auto& t) { t.number("a"); }),
             Catch::StartsWith("case.toml:1:5: key 'a': found ") && Catch::EndsWith("allowed: a finite number"));
  CHECK_THAT(mistake("a = " + value, [](auto& t) { t.number_or("a", 1); }), Catch::Contains("finite number"));
  CHECK_THAT(mistake("a = " + value, [](auto& t) { t.optional_number("a", Range::positive()); }),
             Catch::Contains("a finite number > 0"));
  CHECK_THAT(mistake("a = [1, " + value + "]", [](auto& t) { t.numbers("a"); }), Catch::Contains("key 'a.1'"));
  CHECK_THAT(mistake("a = [1, 2, " + value + "]", [](auto& t) { t.vector3("a"); }), Catch::Contains("key 'a.2'"));
  CHECK_THAT(mistake("a = " + value, [](auto& t) { t.integer("a"); }), Catch::Contains("allowed: an integer"));
}

TEST_CASE("A vector has three numbers") {
  CHECK(mistake("a = [1, 2]", [](auto& t) { t.vector3("a"); }) ==
        "case.toml:1:5: key 'a': found 2 elements, allowed: an array of three numbers");
  CHECK(mistake("a = 5", [](auto& t) { t.vector3_or("a", {}); }) ==
        "case.toml:1:5: key 'a': found 5, allowed: an array of three numbers");
  CHECK(mistake("a = [[0, 0, 0], [1, 2, 3, 4]]", [](auto& t) { t.vectors3("a"); }) ==
        "case.toml:1:17: key 'a.1': found 4 elements, allowed: an array of three numbers");
  CHECK(mistake("a = [[0, 0, 'x']]", [](auto& t) { t.vectors3("a"); }) ==
        "case.toml:1:13: key 'a.0.2': found the string 'x', allowed: a number");
}

TEST_CASE("A word that is not among the choices is refused with the choices and the nearest one") {
  CHECK(mistake("a = 'rigit'", [](auto& t) {
          t.choice("a", {"rigid", "free"});
        }) == "case.toml:1:5: key 'a': found 'rigit', allowed: 'rigid', 'free' (did you mean 'rigid'?)");
  CHECK(mistake("a = 'zzz'", [](auto& t) {
          t.choice_or("a", "free", {"rigid", "free"});
        }) == "case.toml:1:5: key 'a': found 'zzz', allowed: 'rigid', 'free'");
}

TEST_CASE("A missing key is named with what is expected, in the table where it should be") {
  CHECK_THAT(mistake("b = 1", [](auto& t) { t.number("size", Range::positive()); }),
             Catch::StartsWith("case.toml") && Catch::EndsWith("key 'size': missing, allowed: a number > 0"));
  CHECK(mistake("b = 1\n[box]\nc = 1", [](auto& t) { t.table("box").integer("n"); }) ==
        "case.toml:2:1: key 'box.n': missing, allowed: an integer");
  CHECK(mistake("[[stage]]\nn = 1\n[[stage]]\n", [](auto& t) { t.tables("stage")[1].integer("n"); }) ==
        "case.toml:3:1: key 'stage.1.n': missing, allowed: an integer");
  CHECK_THAT(mistake("", [](auto& t) { t.table("box"); }),
             Catch::EndsWith("key 'box': missing, allowed: a table [box]"));
}

TEST_CASE("A missing key is answered with a present one that looks like it") {
  CHECK_THAT(mistake("x = 1\nwall_sped = 2", [](auto& t) { t.number("wall_speed"); }),
             Catch::EndsWith("key 'wall_speed': missing, allowed: a number (did you mean 'wall_sped' in line 2?)"));
}

TEST_CASE("An unknown key is answered with the nearest known one, or with all") {
  const auto read = [](TableReader& table) {
    table.number_or("wall_speed", 1);
    table.string_or("name", "");
    table.finish();
  };
  CHECK(mistake("name = 'a'\n wall_sped = 2", read) ==
        "case.toml:2:2: unknown key 'wall_sped' (did you mean 'wall_speed'?)");
  CHECK(mistake("colour = 2", read) == "case.toml:1:1: unknown key 'colour', known here: name, wall_speed");
  CHECK(mistake("[inner]\nc = 1\ndepht = 2", [](auto& t) {
          TableReader inner = t.table("inner");
          inner.number_or("depth", 1);
          inner.number("c");
          inner.finish();
        }) == "case.toml:3:1: unknown key 'inner.depht' (did you mean 'depth'?)");
  CHECK(mistake("[[stage]]\nq = 1", [](auto& t) { t.tables("stage")[0].finish(); }) ==
        "case.toml:2:1: unknown key 'stage.0.q'");
}

TEST_CASE("A key that a reader only looked for is known, but must still be read") {
  const auto look = [](TableReader& table) {
    CHECK_FALSE(table.has("direction"));
    table.finish();
  };
  CHECK(mistake("directon = 1", look) == "case.toml:1:1: unknown key 'directon' (did you mean 'direction'?)");
  CHECK_THAT(mistake("direction = 1",
                     [](TableReader& table) {
                       CHECK(table.has("direction"));
                       table.finish();
                     }),
             Catch::Contains("unknown key 'direction'"));
}

TEST_CASE("Of several unknown keys the first in the file is reported") {
  CHECK_THAT(mistake("zebra = 1\nant = 2", [](auto& t) { t.finish(); }),
             Catch::StartsWith("case.toml:1:1: unknown key 'zebra'"));
}

TEST_CASE("A check across keys fails at the place of its key") {
  CHECK(mistake("\na = 5", [](auto& t) { t.fail("a", "more than b"); }) == "case.toml:2:5: key 'a': more than b");
}

TEST_CASE("A message shortens long texts and stays one line for any content of the file") {
  const std::string message = mistake("a = \"" + std::string(5000, 'x') + "\"", [](auto& t) { t.number("a"); });
  CHECK(message.size() < 200);
  CHECK(mistake(R"(a = "x\n\u001b[31m")", [](auto& t) { t.number("a"); }) ==
        "case.toml:1:5: key 'a': found the string 'x\\n\\x1b[31m', allowed: a number");
  CHECK(mistake("\"k\\ney\" = 1", [](auto& t) { t.finish(); }) == "case.toml:1:1: unknown key 'k\\ney'");
  // A text is not cut within a character: every character here has three bytes.
  std::string wide;
  for (int i = 0; i < 100; ++i) wide += "…";
  const std::string cut = mistake("a = '" + wide + "'", [](auto& t) { t.number("a"); });
  const auto begin = cut.find("'…") + 1;
  CHECK((cut.find("', allowed:") - begin) % 3 == 0);
}

TEST_CASE("Text that is no TOML is refused with line and column") {
  for (const char* text :
       {"a = ", "a = 1\nb == 2", "[box", "a = 1\na = 2", "a = \"x\nb\"", "a = 0x", "\x01 = 2", "a = '\xff\xfe'"}) {
    CAPTURE(text);
    CHECK_THAT(input_error([&] { parse(text); }), Catch::Matches("case\\.toml:[0-9]+:[0-9]+: not valid TOML: .+"));
  }
  CHECK_THAT(input_error([&] { parse("a = 1\nb = = 2"); }), Catch::StartsWith("case.toml:2:"));
}

TEST_CASE("A file that is missing or a folder is refused with its name") {
  CHECK(input_error([] { TomlDocument::from_file("no/such\nfile.toml"); }) == "no/such\\nfile.toml: no such file");
  const std::string folder = std::filesystem::temp_directory_path().string();
  CHECK(input_error([&] { TomlDocument::from_file(folder); }) == folder + ": is a folder, allowed: a file");
}

TEST_CASE("Reading a file gives the same as reading its text") {
  const auto path =
      std::filesystem::temp_directory_path() / ("mpfem-test-common-" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << "\xEF\xBB\xBF"
                      << "a = 1\r\nb = 'x'\r\n"; // a byte order mark and line ends of another system
  const TomlDocument document = TomlDocument::from_file(path);
  std::filesystem::remove(path);
  TableReader table(document);
  CHECK(table.integer("a") == 1);
  CHECK_THAT(input_error([&] { table.number("b"); }), Catch::StartsWith(path.string() + ":2:5: key 'b'"));
}

TEST_CASE("The text of a document reads back to the same values, bit by bit") {
  const TomlDocument document = parse(R"(
third = 0.3333333333333333
tiny = 4.9e-324
large = 1.7976931348623157e308
whole = -9007199254740993
float_whole = 3.0
text = "tab\t quote\" backslash\\ newline\n bell\u0007 Größe"
literal = 'C:\path'
flag = false
empty = []
nested = [[1, 2], [3.5, 4]]
"key with spaces" = 1
[box]
[box.deeper]
x = 1
[[stage]]
name = "a"
[[stage]]
name = "b"
[[stage.output]]
every = 2
)");
  const std::string once = document.text();
  const TomlDocument again = parse(once);
  CHECK(again.root() == document.root());
  CHECK(again.text() == once);
  TableReader table(again);
  CHECK(table.number("third") == 0.3333333333333333);
  CHECK(table.number("tiny") == 4.9e-324);
  CHECK(table.number("large") == 1.7976931348623157e308);
  CHECK(table.integer("whole") == -9007199254740993);
  CHECK(table.string("text") == "tab\t quote\" backslash\\ newline\n bell\a Größe");
}

TEST_CASE("A whole number too large for a double is refused as a number and read as an integer") {
  CHECK_THAT(mistake("a = 9007199254740993", [](auto& t) { t.number("a"); }), Catch::Contains("key 'a'"));
  const TomlDocument document = parse("a = 9007199254740993");
  CHECK(TableReader(document).integer("a") == 9007199254740993);
}
