// Fields of states as numbers: written and read by one list.

#include <catch2/catch.hpp>

#include "common/fields.hpp"

using namespace mpfem;

namespace {

enum class Colour { red, green };

struct State {
  double length = 0;
  std::array<double, 2> force{};
  std::int64_t step = 0;
  bool ended = false;
  Colour colour = Colour::red;
  std::array<bool, 3> away{};

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("length", s.length), visit("force", s.force), visit("step", s.step), visit("ended", s.ended);
    visit("colour", s.colour), visit("away", s.away);
  }
};

const State written{
    .length = 0.1, .force = {1, -2}, .step = 7, .ended = true, .colour = Colour::green, .away = {0, 1, 0}};

FieldValues values_of(const State& state) {
  FieldWriter writer;
  State::for_each_field(state, writer);
  return writer.values();
}

} // namespace

TEST_CASE("a state that is read from its fields is the one that was written") {
  const FieldValues values = values_of(written);
  State state;
  FieldReader reader(values);
  State::for_each_field(state, reader);
  reader.finish();
  CHECK(values_of(state) == values);
  CHECK(state.colour == Colour::green);
  CHECK(state.away == written.away);
}

TEST_CASE("fields of another version are refused: another name, a value too few, a value too many") {
  const auto read = [](const FieldValues& values) {
    State state;
    FieldReader reader(values);
    State::for_each_field(state, reader);
    reader.finish();
  };
  FieldValues values = values_of(written);
  values.name[2] = "steps";
  CHECK_THROWS_AS(read(values), std::invalid_argument);
  values = values_of(written);
  values.number.pop_back();
  CHECK_THROWS_AS(read(values), std::invalid_argument);
  values = values_of(written);
  values.integer.push_back(0);
  CHECK_THROWS_AS(read(values), std::invalid_argument);
}
