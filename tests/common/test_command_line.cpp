// Options of the programs: numbers with their range and unit, and mistakes in one line.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/command_line.hpp"
#include "one_line_error.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using test::Folder;
using test::input_error;
using test::write_text;

namespace {

enum class Way { up, down };

struct Options {
  double size = 0;
  int threads = 1;
  std::optional<std::int64_t> seed;
  std::vector<double> box, densities;
  std::string input, axis, from;
  std::optional<Way> way;
  bool quiet = false;
};

Options parsed(std::vector<std::string> words) {
  CLI::App app("example");
  Options options;
  add_number(app, "--size", options.size, positive_length, "mm", "Element size");
  add_number(app, "--threads", options.threads, thread_numbers, "", "Threads");
  add_number(app, "--seed", options.seed, seed_numbers, "", "Seed");
  add_numbers(app, "--box", options.box, 3, positive_length, "mm", "Box");
  add_numbers(app, "--densities", options.densities, 0, Range::between(0, 1), "", "Densities");
  app.add_option("input", options.input, "Input");
  app.add_option("--axis", options.axis, "Axis")->check(one_of({"x", "y", "z"}));
  app.add_option("--from", options.from, "File")->check(existing_file());
  app.add_flag("--quiet", options.quiet, "Quiet");
  add_choice(app, "--way", options.way, {{"up", Way::up}, {"down", Way::down}}, "Way");
  words.insert(words.begin(), "example");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  parse_command_line(app, "example", static_cast<int>(pointers.size()), pointers.data());
  return options;
}

std::string refusal(const std::vector<std::string>& words) {
  return input_error([&] { (void)parsed(words); });
}

} // namespace

TEST_CASE("Options take numbers within their range") {
  const Options options = parsed({"--size", "0.5", "--threads", "4", "--seed", "9007199254740991", "--box", "1,2,3"});
  CHECK(options.size == 0.5);
  CHECK(options.threads == 4);
  CHECK(options.seed == 9007199254740991);
  CHECK(options.box == std::vector<double>{1, 2, 3});
}

TEST_CASE("A list ends at the last of its numbers, and the word after it is another argument") {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--box", "1,2,3", "--densities", "0.5,0.6", "7"},
        {"--densities", "0.5,0.6", "--box", "1,2,3", "7"},
        {"--densities", "0.5,0.6", "7", "--box", "1", "2", "3"}}) {
    const Options options = parsed(words);
    CHECK(options.box == std::vector<double>{1, 2, 3});
    CHECK(options.densities == std::vector<double>{0.5, 0.6});
    CHECK(options.input == "7");
  }
  CHECK_THAT(refusal({"--box", "1,2"}), Catch::StartsWith("--box"));
  CHECK_THAT(refusal({"--box", "1,2,3,4"}), Catch::StartsWith("--box"));
}

TEST_CASE("Options refuse anything but a finite number within their range, in one line") {
  CHECK(refusal({"--size", "0"}) == "--size: found '0', allowed: a number 1e-12 … 1e+09 mm (see example --help)");
  for (const char* text : {"nan", "-nan", "inf", "1e400", "-1", "0", "abc", "1mm", "", " ", "0x1p3"}) {
    INFO(text);
    CHECK_THAT(refusal({"--size", text}), Catch::StartsWith("--size"));
    CHECK_THAT(refusal({"--threads", text}), Catch::StartsWith("--threads"));
    CHECK_THAT(refusal({"--box", std::string("1,1,") + text}), Catch::StartsWith("--box"));
  }
  CHECK_THAT(refusal({"--threads", "1.5"}), Catch::Contains("found '1.5', allowed: a whole number 1 … 1024"));
  CHECK_THAT(refusal({"--seed", "9223372036854775808"}), Catch::StartsWith("--seed"));
}

TEST_CASE("An option that takes one of some words refuses others and lists those that are allowed") {
  const Options options = parsed({"--axis", "y", "--way", "down"});
  CHECK(options.axis == "y");
  CHECK(options.way == Way::down);
  CHECK_FALSE(parsed({}).way.has_value());
  CHECK(refusal({"--axis", "w"}) == "--axis: found 'w', allowed: x, y, z (see example --help)");
  for (const char* text : {"Up", "0", "", "up,down"}) {
    INFO(text);
    CHECK(refusal({"--way", text}) == fmt::format("--way: found '{}', allowed: up, down (see example --help)", text));
  }
}

TEST_CASE("An option that names an input file refuses what is no file, and says which option it is") {
  const Folder folder;
  write_text(folder / "a.toml", "");
  CHECK(parsed({"--from", folder / "a.toml"}).from == folder / "a.toml");
  CHECK(parsed({"--from", ""}).from.empty());
  CHECK(refusal({"--from", "none.toml"}) == "--from: none.toml: no such file (see example --help)");
  CHECK(refusal({"--from", "/"}) == "--from: /: is a folder, allowed: a file (see example --help)");
  CHECK(refusal({"--from", "/dev/null"}) ==
        "--from: /dev/null: is a pipe, socket or device, allowed: a file (see example --help)");
}

TEST_CASE("A word that no option or argument takes is named before what is missing") {
  CHECK(refusal({"--siez", "1"}) == "found '--siez'; did you mean '--size'? (see example --help)");
  CHECK(refusal({"--q=3"}) == "found '--q', allowed: --help, --size, --threads, --seed, --box, --densities, --axis, "
                              "--from, --quiet, --way (see example --help)");
  CHECK(refusal({"one", "two", "three"}) == "found one more word, 'two', allowed: options (see example --help)");
}

TEST_CASE("An unknown subcommand is named with the nearest one, or with the allowed ones") {
  const auto refusal_of = [](std::vector<std::string> words) {
    CLI::App app("example");
    app.require_subcommand(1);
    std::string input, output;
    CLI::App* pack = app.add_subcommand("pack", "Pack");
    pack->add_option("input", input, "Input");
    pack->add_option("-o,--output", output, "Output")->required();
    app.add_subcommand("mesh", "Mesh");
    words.insert(words.begin(), "example");
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    return input_error([&] { parse_command_line(app, "example", static_cast<int>(pointers.size()), pointers.data()); });
  };
  CHECK(refusal_of({"foo"}) == "found 'foo', allowed: pack, mesh (see example --help)");
  CHECK(refusal_of({"pakc"}) == "found 'pakc'; did you mean 'pack'? (see example --help)");
  CHECK(refusal_of({}) == "found no subcommand, allowed: pack, mesh (see example --help)");
  CHECK(refusal_of({"--foo"}) == "found '--foo', allowed: --help (see example --help)");
  CHECK(refusal_of({"pack", "a"}) == "--output is required (see example pack --help)");
  CHECK(refusal_of({"pack", "a", "--outptu", "b"}) ==
        "found '--outptu'; did you mean '--output'? (see example pack --help)");
}

TEST_CASE("Options with no value, or with the wrong number of them, say how many were found and are allowed") {
  CHECK(refusal({"--from"}) == "--from: found no value, allowed: TEXT:FILE (see example --help)");
  CHECK(refusal({"--box", "1,2"}) == "--box: found 2 values, allowed: 3 (see example --help)");
  CHECK(refusal({"--quiet=maybe"}) ==
        "--quiet: found 'maybe', allowed: the option without a value (see example --help)");
}

TEST_CASE("A long word on the command line is shortened in the message") {
  const std::string endless(100'000, 'x');
  CHECK(refusal({"--size", endless}).size() < 300);
  CHECK(refusal({"--" + endless}).size() < 300);
  CHECK(refusal({"input", endless}).size() < 300);
}
