#include <catch2/catch.hpp>

#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

using namespace mpfem;

TEST_CASE("The edit distance counts insertions, deletions, substitutions and swaps of neighbours") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("radius", "raduis") == 1);
  CHECK(edit_distance("ab", "ba") == 1);
  CHECK(edit_distance("ca", "abc") == 3); // optimal string alignment; the unrestricted distance would be 2
  CHECK(edit_distance("abcd", "acbd") == edit_distance("acbd", "abcd"));
}

TEST_CASE("The nearest word is the one that a mistyped word probably meant") {
  const std::vector<std::string> known = {"wall_speed", "wall_stress", "name", "until"};
  CHECK(nearest_word("wallspeed", known) == "wall_speed");
  CHECK(nearest_word("wall_sped", known) == "wall_speed");
  CHECK(nearest_word("wall_srtess", known) == "wall_stress");
  CHECK(nearest_word("nmae", known) == "name");
  CHECK(nearest_word("name", known) == "name");
}

TEST_CASE("No word is proposed beyond a third of the longer word's letters") {
  CHECK(nearest_word("abcdef", {"abcdxy"}) == "abcdxy");
  CHECK(nearest_word("abcdef", {"abcxyz"}) == std::nullopt);
  CHECK(nearest_word("temperature", {"wall_speed", "name"}) == std::nullopt);
}

TEST_CASE("A short word may be one letter away, but must share one with the word proposed") {
  CHECK(nearest_word("b", {"bc"}) == "bc");
  CHECK(nearest_word("bc", {"b"}) == "b");
  CHECK(nearest_word("p", {"q"}) == std::nullopt);
  CHECK(nearest_word("", {"q"}) == std::nullopt);
}

TEST_CASE("The first of equally near words wins, and nothing is proposed where nothing is known") {
  CHECK(nearest_word("box_x", {"box_a", "box_b"}) == "box_a");
  CHECK(nearest_word("box", {}) == std::nullopt);
}

TEST_CASE("A suggestion names the nearest word, otherwise all known ones") {
  CHECK(suggestion("nmae", {"name", "until"}) == "; did you mean 'name'?");
  CHECK(suggestion("radius", {"name", "until"}) == ", allowed: name, until");
  CHECK(suggestion("radius", {}).empty());
}

TEST_CASE("Words of absurd length are not compared") {
  const std::string long_word(100'000, 'a');
  CHECK(nearest_word(long_word, {long_word}) == std::nullopt);
}

TEST_CASE("Control characters are written as escapes, other characters as they are") {
  CHECK(one_line("a\nb\tc\rd\x1b[31me\x7f") == "a\\nb\\tc\\x0dd\\x1b[31me\\x7f");
  CHECK(one_line(std::string_view("\0", 1)) == "\\x00");
  CHECK(one_line("Grenzfläche ≥ 0 …") == "Grenzfläche ≥ 0 …");
  CHECK(one_line("").empty());
}
