// TomlDocument::set: what `--set KEY=VALUE` does on the command line.

#include <catch2/catch.hpp>

#include "common/table_reader.hpp"
#include "one_line_error.hpp"

using namespace mpfem;
using test::input_error;

namespace {

TomlDocument example() {
  return TomlDocument::from_text("size = 1\nwords = ['a', 'b']\nnone = []\n[box]\nlength = 2.0\n"
                                 "[[stages]]\nname = 'load'\nspeed = 5\n[[stages]]\nname = 'unload'\n",
                                 "case.toml");
}

std::string refusal(std::string_view assignment) {
  TomlDocument document = example();
  const std::string before = document.text();
  const std::string message = input_error([&] { document.set(assignment); });
  CHECK(document.text() == before); // a refused assignment changes nothing
  return message;
}

} // namespace

TEST_CASE("An assignment replaces a value, adds a key and makes tables") {
  TomlDocument document = example();
  document.set("size=2.5");
  document.set("box.length= [1, 2, 3] ");
  document.set("box.fresh=true");
  document.set("new.deeper.key=7");
  TableReader table(document);
  CHECK(table.number("size") == 2.5);
  TableReader box = table.table("box");
  CHECK(box.vector3("length") == std::array<double, 3>{1, 2, 3});
  CHECK(box.boolean_or("fresh", false));
  CHECK(table.table("new").table("deeper").integer("key") == 7);
}

TEST_CASE("An assignment reaches into arrays by number") {
  TomlDocument document = example();
  document.set("stages.0.speed=2000");
  document.set("stages.1.name=hold");
  document.set("words.1=z");
  TableReader table(document);
  std::vector<TableReader> stages = table.tables("stages");
  CHECK(stages[0].integer("speed") == 2000);
  CHECK(stages[0].string("name") == "load");
  CHECK(stages[1].string("name") == "hold");
  CHECK(table.strings_or("words", {}) == std::vector<std::string>{"a", "z"});
}

TEST_CASE("The last assignment of a key wins") {
  TomlDocument document = example();
  document.set("size=3");
  document.set("size=4");
  CHECK(TableReader(document).integer("size") == 4);
}

TEST_CASE("Text that is not a TOML value becomes a string: words, paths, texts with quotes and equal signs") {
  for (const std::string value :
       {"hold", "runs/a b.h5", "a=b", "C:\\runs\\x", "say \"this\"", "1.2.3", "Größe", "5 mm"}) {
    CAPTURE(value);
    TomlDocument document = example();
    document.set("size=" + value);
    CHECK(TableReader(document).string("size") == value);
  }
}

TEST_CASE("Values that are TOML keep their type") {
  TomlDocument document = example();
  document.set("a='5'");
  document.set("b=5");
  document.set("c=5e0");
  document.set("d={x = 1}");
  TableReader table(document);
  CHECK(table.string("a") == "5");
  CHECK(table.integer("b") == 5);
  CHECK_THAT(input_error([&] { table.integer("c"); }), Catch::EndsWith("found 5, allowed: an integer"));
  CHECK(table.table("d").integer("x") == 1);
}

TEST_CASE("A message about an assigned value names the assignment") {
  TomlDocument document = example();
  document.set("box.length=-1");
  document.set("stages.1.spede=1");
  TableReader table(document);
  CHECK(input_error([&] { table.table("box").number("length", Range::positive()); }) ==
        "--set box.length=-1: key 'box.length': found -1, allowed: > 0");
  TableReader stage = table.tables("stages")[1];
  stage.string("name");
  stage.number_or("speed", 1);
  CHECK(input_error([&] { stage.finish(); }) ==
        "--set stages.1.spede=1: unknown key 'stages.1.spede' (did you mean 'speed'?)");
}

TEST_CASE("A value that is not finite is refused when it is read") {
  TomlDocument document = example();
  document.set("size=nan");
  TableReader table(document);
  CHECK(input_error([&] { table.number("size"); }) ==
        "--set size=nan: key 'size': found nan, allowed: a finite number");
}

TEST_CASE("Assignments that cannot be understood are refused in one line and change nothing") {
  CHECK(refusal("size") == "--set size: found no '=', allowed: KEY=VALUE");
  CHECK(refusal("") == "--set : found no '=', allowed: KEY=VALUE");
  CHECK(refusal("size=") == "--set size=: the value is empty, allowed: KEY=VALUE");
  CHECK(refusal("size=  ") == "--set size=  : the value is empty, allowed: KEY=VALUE");
  for (const char* assignment :
       {"=5", ".a=5", "a.=5", "a..b=5", "a b=5", "box.length =5", "'a'=5", "stages[0].speed=5", "a\nb=5"}) {
    CAPTURE(assignment);
    CHECK_THAT(refusal(assignment), Catch::Contains("is not a key, allowed: words joined by dots"));
  }
  CHECK(refusal("size=1\nbox.length=3") == "--set size=1\\nbox.length=3: the value has several lines");
  for (const char* assignment : {"size=[1, 2", "size={a = }", "size='a", "size=\"a", "size=[1] 2"}) {
    CAPTURE(assignment);
    CHECK_THAT(refusal(assignment), Catch::Contains(std::string("--set ") + assignment + ": not a valid TOML value: "));
  }
  CHECK_THAT(refusal("size=a\x01"), Catch::StartsWith("--set size=a\\x01: "));
}

TEST_CASE("An assignment creates neither array elements nor keys below a value that is not a table") {
  CHECK(refusal("stages.2.speed=1") == "--set stages.2.speed=1: found element '2' of an array, allowed: 0 … 1");
  CHECK(refusal("stages.first.speed=1") ==
        "--set stages.first.speed=1: found element 'first' of an array, allowed: 0 … 1");
  CHECK(refusal("stages.-1.speed=1") == "--set stages.-1.speed=1: found element '-1' of an array, allowed: 0 … 1");
  CHECK(refusal("words.2=c") == "--set words.2=c: found element '2' of an array, allowed: 0 … 1");
  CHECK(refusal("none.0=1") == "--set none.0=1: found element '0' of an empty array");
  CHECK_THAT(refusal("size.x=1"), Catch::StartsWith("--set size.x=1: 'x' is below an integer"));
  CHECK_THAT(refusal("size.x.y=1"), Catch::StartsWith("--set size.x.y=1: 'x' is below an integer"));
  CHECK_THAT(refusal("box.length.0=1"), Catch::Contains("is below a number"));
}

TEST_CASE("The text of a document holds its assignments") {
  TomlDocument document = example();
  document.set("stages.0.speed=2000");
  document.set("box.note=a \"word\"");
  const TomlDocument again = TomlDocument::from_text(document.text(), "again.toml");
  CHECK(again.root() == document.root());
}
