// The place of a plot's key.

#include <catch2/catch.hpp>

#include <cmath>

#include "postproc/figure/key_place.hpp"

using namespace mpfem;

namespace {

const ShownAxis unit = {0.0, 1.0, false};
const KeySize quarter = {0.25, 0.25};

} // namespace

TEST_CASE("a key lies in the first corner that holds no data") {
  CHECK(key_place({{{{0, 0}, {1, 1}}, true}}, unit, unit, quarter) == "left top");
  CHECK(key_place({{{{0, 1}, {1, 0}}, true}}, unit, unit, quarter) == "right top");
  CHECK(key_place({{{{0.1, 0.9}, {0.9, 0.9}}, false}}, unit, unit, quarter) == "right bottom");
  CHECK(key_place({{{{0.1, 0.9}, {0.9, 0.9}, {0.9, 0.1}}, false}}, unit, unit, quarter) == "left bottom");
}

TEST_CASE("a line covers a corner that none of its points lies in") {
  const std::vector<std::array<double, 2>> across = {{-1, 0.9}, {2, 0.9}};
  CHECK(key_place({{across, false}}, unit, unit, quarter) == "left top");
  CHECK(key_place({{across, true}}, unit, unit, quarter) == "right bottom");
}

TEST_CASE("a reference line runs from end to end of its axis, a logarithmic one too") {
  const std::vector<DrawnLine> line = {{{{-INFINITY, 90}, {INFINITY, 90}}, true}};
  CHECK(key_place(line, unit, {0.0, 100.0, false}, quarter) == "right bottom");
  CHECK(key_place(line, {1.0, 10.0, true}, {1.0, 100.0, true}, quarter) == "right bottom");
}

TEST_CASE("a key without a free corner lies outside the axes, below them if it is wide") {
  const std::vector<DrawnLine> all = {{{{0.1, 0.1}, {0.1, 0.9}, {0.9, 0.1}, {0.9, 0.9}}, false}};
  CHECK(key_place(all, unit, unit, quarter) == "outside right center vertical");
  CHECK(key_place(all, unit, unit, {0.5, 0.25}) == "outside bottom center vertical maxcols 2");
}

TEST_CASE("a key taller than the axes lies beside them") {
  CHECK(key_place({{{{0.5, 0.5}}, false}}, unit, unit, {0.2, 1.2}) == "outside right center vertical");
}

TEST_CASE("limits that a plot does not give end at ticks around the data") {
  // Upwards to 10, the next tick, 7.2 lies below the key; upwards to 7.2 under it.
  const std::vector<DrawnLine> line = {{{{0.5, 1}, {0.5, 7.2}}, false}};
  CHECK(key_place(line, unit, {}, {0.9, 0.05}) == "left top");
  CHECK(key_place(line, unit, {0.0, 7.2, false}, {0.9, 0.05}) == "right bottom");
}

TEST_CASE("the size of a key follows from its titles without gnuplot's markup") {
  CHECK(key_size({"D_r", "", "D_{r}"}, "").width == key_size({"Dr"}, "").width);
  CHECK(key_size({"δ"}, "").width == key_size({"d"}, "").width);
  CHECK(key_size({"a", "", "b"}, "").height == key_size({"a", "b"}, "").height);
  CHECK(key_size({"a"}, "title").height == key_size({"a", "b"}, "").height);
  CHECK(key_size({"longer"}, "").width > key_size({"short"}, "").width);
}
