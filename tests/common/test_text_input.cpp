// Text that comes from outside: files, numbers, tables, and what of them a message repeats.

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "common/csv_reader.hpp"
#include "common/number_text.hpp"
#include "common/one_line.hpp"
#include "common/table_reader.hpp"
#include "common/text_input.hpp"
#include "common/toml_difference.hpp"
#include "common/toml_scan.hpp"
#include "folder.hpp"
#include "one_line_error.hpp"

using namespace mpfem;
using test::Folder;
using test::input_error;
using test::write_text;

namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

} // namespace

TEST_CASE("A long text keeps its ends in a message, and a short one is whole") {
  CHECK(shortened("short", 10) == "short");
  CHECK(shortened("0123456789", 10) == "0123456789");
  CHECK(shortened("0123456789a", 10) == "0123…6789a");
  CHECK(shortened(repeated("ä", 11), 5) == "ää…ää");
  CHECK(shortened(repeated("\n", 100), 5) == "\\n…\\n");
  CHECK(shortened(std::string(200'000, 'x')).size() < 90);
}

TEST_CASE("A line for a narrow terminal is cut between characters") {
  CHECK(first_characters("1 µs … 2", 3) == "1 µ");
  CHECK(first_characters("1 µs … 2", 6) == "1 µs …");
  CHECK(first_characters("µ", 0).empty());
  CHECK(first_characters("short", 10) == "short");
}

TEST_CASE("Bytes that are not valid text are shown as numbers") {
  CHECK(one_line("\xff") == "\\xff");
  CHECK(one_line("\xc3") == "\\xc3");
  CHECK(one_line("a\xc2\x9b"
                 "b") == "a\\xc2\\x9bb"); // begins an order to a terminal
  CHECK(one_line("Größe …") == "Größe …");
}

TEST_CASE("A number is taken only when the whole text is one and it is finite") {
  CHECK(finite_number("-1.5e-3") == -1.5e-3);
  CHECK(finite_number("+2") == 2.0);
  for (const char* text : {"", "nan", "inf", "-inf", "1e400", "1.5x", " 1", "0x10", "+-1", "1,5"})
    CHECK_FALSE(finite_number(text));
  CHECK(whole_number("-7") == -7);
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808", "7x"}) CHECK_FALSE(whole_number(text));
}

TEST_CASE("Only a regular file is read, and not more of it than is allowed") {
  const Folder folder;
  write_text(folder / "a", "abc");
  CHECK(read_text_file(folder / "a", 3) == "abc");
  CHECK_THAT(input_error([&] { read_text_file(folder / "a", 2); }), Catch::Contains("is too large, allowed: up to "));
  CHECK_THAT(input_error([&] { read_text_file(folder / "none", 2); }), Catch::Contains("no such file"));
  CHECK_THAT(input_error([&] { read_text_file(folder / "", 2); }), Catch::Contains("is a folder"));
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THAT(input_error([&] { read_text_file(folder / "pipe", 2); }), Catch::Contains("is a pipe"));
  CHECK_THAT(input_error([&] { read_text_file("/dev/zero", 2); }), Catch::Contains("device"));
  CHECK_THAT(input_error([&] { read_text_file(std::string(5000, 'x'), 2); }), Catch::Contains("too long"));
}

TEST_CASE("Brackets, headings and dotted keys that nest too deep are found by their line") {
  CHECK_FALSE(line_nested_too_deep("a = [[1, 2], {b.c = 3}]\n[d.e.f]\ng.h = 1.5\n"));
  CHECK_FALSE(line_nested_too_deep(std::string("a = \"") + repeated("[", 100) + "\"\n"));
  CHECK_FALSE(line_nested_too_deep(std::string("a = '''\n") + repeated("[", 100) + "\n''''\n# " + repeated("[.", 100)));
  CHECK_FALSE(line_nested_too_deep(std::string("a = \"\"\"\\\"\"\"\\\n") + repeated("{.", 100) + "\"\"\"\n"));
  CHECK_FALSE(line_nested_too_deep(repeated("[a.b]\nc.d = [[1.5]]\n", 100)));
  CHECK(line_nested_too_deep(std::string("x = 1\na = ") + repeated("[", 65)) == 2);
  CHECK(line_nested_too_deep(std::string("x = '''\n'''\n[a") + repeated(".a", 65) + "]") == 3);
  CHECK(line_nested_too_deep(std::string("a") + repeated(".a", 65) + " = 1") == 1);
  CHECK(line_nested_too_deep(std::string("a = ") + repeated("{b.c.d = ", 25)) == 1);
  CHECK(line_nested_too_deep(std::string("[a") + repeated(".a", 40) + "]\nb" + repeated(".b", 40) + " = 1") == 2);
  CHECK(line_nested_too_deep(std::string("a = ['''x'''', ") + repeated("[", 65)) == 1);
}

TEST_CASE("Letters beyond ASCII are read in strings and comments and refused elsewhere") {
  const auto read = TomlDocument::from_text("\xef\xbb\xbf"
                                            "a = 'ä' # ö\nb = \"\"\"\nü\xce\xa2\"\"\"\n",
                                            "umlaut.toml");
  TableReader reader(read);
  CHECK(reader.string("a") == "ä");
  CHECK(reader.string("b") == "ü\xce\xa2");
  // toml++ 3.3 checks whether these letters are blanks and has no result for them: U+00E4, U+03A2, U+048C.
  for (const std::string letter : {"ä", "\xce\xa2", "\xd2\x8c"})
    for (const std::string before : {"a = 1\nM1", "", "a = 0E1\"", "a = 0E1[[\";", "b = 'x' '", "a = 0..'.E1\"",
                                     "a = [1, b.'", "a = 2e1=.='*s", "a.", "[", "[[a].", "a = "})
      CHECK_THAT(input_error([&] { TomlDocument::from_text(before + letter + " 8 = 1", "greek.toml"); }),
                 Catch::Matches("greek.toml:[12](:[0-9]+)?: not valid TOML: .+"));
  TomlDocument document = TomlDocument::from_text("", "flat.toml");
  document.set("packing=größe-\xce\xa2.h5");
  CHECK(TableReader(document).string("packing") == "größe-\xce\xa2.h5");
  CHECK_THAT(input_error([&] { document.set("a=[1, \xce\xa2]"); }), Catch::Contains("not a valid TOML value: "));
}

TEST_CASE("Tables that nest too deep are refused before they are followed") {
  for (const std::string& text :
       {std::string("a = ") + repeated("[", 32'000), std::string("a = ") + repeated("{a=", 32'000),
        std::string("[a") + repeated(".a", 32'000) + "]\n", std::string("a") + repeated(".a", 32'000) + " = 1\n",
        std::string("[[a") + repeated(".a", 32'000) + "]]\n"})
    CHECK_THAT(input_error([&] { TomlDocument::from_text(text, "deep.toml"); }),
               Catch::StartsWith("deep.toml:1: tables and arrays are nested too deeply, allowed: up to 64 levels"));
  TomlDocument document = TomlDocument::from_text("", "flat.toml");
  CHECK_THAT(input_error([&] { document.set(std::string("a") + repeated(".a", 60'000) + "=1"); }),
             Catch::Contains("found a key of too many parts, allowed: up to 64"));
  CHECK_THAT(input_error([&] { document.set(std::string("a=") + repeated("[", 1000)); }), Catch::Contains("64 levels"));
}

TEST_CASE("A message repeats only the ends of a long key, value or path") {
  const std::string endless(200'000, 'x');
  const auto short_enough = [](const std::string& message) { return message.size() < 400; };
  CHECK(short_enough(input_error([&] { TomlDocument::from_file(std::string("/") + endless); })));
  CHECK(short_enough(input_error([&] { TomlDocument::from_text(endless + " = 1\n" + endless + " = 1", "a.toml"); })));
  TomlDocument document = TomlDocument::from_text(std::string("a = '") + endless + "'\n" + endless + " = 1\n", endless);
  CHECK(short_enough(input_error([&] { document.set(endless); })));
  CHECK(short_enough(input_error([&] { document.set(endless + " b=1"); })));
  TableReader reader(document);
  CHECK(short_enough(input_error([&] { (void)reader.number("a"); })));
  CHECK(short_enough(input_error([&] { (void)reader.choice("a", {"b", "c"}); })));
  CHECK(short_enough(input_error([&] { reader.finish(); })));
}

TEST_CASE("Whole numbers in an array are those that an integer holds") {
  const auto document = TomlDocument::from_text("a = [0, 2.0]\nb = [1e300]\nc = [1.5]\nd = [-1]", "a.toml");
  TableReader reader(document);
  CHECK(reader.integers("a") == std::vector<std::int64_t>{0, 2});
  CHECK_THAT(input_error([&] { (void)reader.integers("b"); }),
             Catch::Contains("found 1e+300, allowed: -9007199254740992 … 9007199254740992"));
  CHECK_THAT(input_error([&] { (void)reader.integers("c"); }), Catch::Contains("found 1.5, allowed: whole numbers"));
  CHECK_THAT(input_error([&] { (void)reader.integers("d", Range::non_negative()); }), Catch::Contains("found -1"));
}

TEST_CASE("A table of comma-separated values gives cells, numbers and places") {
  CsvReader reader =
      CsvReader::from_text("\xEF\xBB\xBF# made by hand\n\n\"x [mm]\", y\r\n 1.5 ,2 # two\n,\nnan,1", "t.csv");
  const CsvRow heading = *reader.next();
  CHECK(heading.line == 3);
  CHECK(csv_heading(heading.cells[0]).name == "x");
  CHECK(csv_heading(heading.cells[0]).unit == "mm");
  CHECK(csv_heading(heading.cells[1]).unit.empty());
  const CsvRow row = *reader.next();
  CHECK(reader.number(row, 0, "x") == 1.5);
  CHECK(reader.integer(row, 1, "y") == 2);
  CHECK(input_error([&] { (void)reader.number(row, 0, "x", Range::between(2, 3)); }) ==
        "t.csv:4: column x: found '1.5', allowed: a number 2 … 3");
  CHECK(input_error([&] { reader.expect_columns(row, 3); }) == "t.csv:4: found 2 columns, allowed: 3");
  CHECK(reader.next()->cells == std::vector<std::string_view>{"", ""});
  const CsvRow last = *reader.next();
  CHECK(input_error([&] { (void)reader.number(last, 0, "x"); }) == "t.csv:6: column x: found 'nan', allowed: a number");
  CHECK_FALSE(reader.next());
}

TEST_CASE("A row of very many columns is refused") {
  CsvReader reader = CsvReader::from_text(std::string(1'000'000, ','), "t.csv");
  CHECK(input_error([&] { (void)reader.next(); }) == "t.csv:1: found too many columns, allowed: up to 10000");
}

TEST_CASE("The difference of two documents is the first key whose values differ") {
  const auto difference = [](const char* first, const char* second) {
    const auto found = first_difference(toml::parse(first), toml::parse(second));
    return found ? found->key + ": " + found->first + " | " + found->second : "none";
  };
  CHECK(difference("a = 1\n[b]\nc = 2.5", "b.c = 2.5\na = 1") == "none");
  CHECK(difference("a = 1\nz = 2", "a = 1.0\nz = 3") == "a: 1 | 1.0");
  CHECK(difference("[[s]]\nv = 1\n[[s]]\nv = 2", "[[s]]\nv = 1\n[[s]]\nv = 'x'") == "s.1.v: 2 | 'x'");
  CHECK(difference("[b]\nc = 1", "") == "b: a table | nothing");
  CHECK(difference("a = [1]", "a = [1, 2]") == "a: an array of 1 element | an array of 2 elements");
}
