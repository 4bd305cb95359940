#include "surfaces/stl_facets.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/number_text.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

Vector3<double> binary_vector(std::string_view bytes, std::size_t at) {
  const auto number = [&](std::size_t i) {
    return static_cast<double>(std::bit_cast<float>(little_endian(bytes, at + 4 * i)));
  };
  return {number(0), number(1), number(2)};
}

/// The number of triangles that a binary file states; 0 where it is too short for one.
std::size_t binary_count(std::string_view bytes) {
  return bytes.size() < head_bytes ? 0 : little_endian(bytes, head_bytes - 4);
}

bool is_finite(const Vector3<double>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<StlFacet> read_binary(std::string_view bytes, const std::string& name) {
  std::vector<StlFacet> facets;
  facets.reserve(binary_count(bytes));
  for (std::size_t at = head_bytes; at < bytes.size(); at += facet_bytes) {
    StlFacet facet{binary_vector(bytes, at), {}};
    for (std::size_t k = 0; k < 3; ++k) {
      facet.corner[k] = binary_vector(bytes, at + 12 * (k + 1));
      if (!is_finite(facet.corner[k]))
        throw InputError(fmt::format("{}: triangle {}: found a corner at ({}, {}, {}), allowed: finite numbers",
                                     shown_path(name), facets.size() + 1, facet.corner[k].x, facet.corner[k].y,
                                     facet.corner[k].z));
    }
    facets.push_back(facet);
  }
  return facets;
}

/// The words of a text and the line of each.
class Words {
public:
  Words(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  /// The next word in lower case; empty at the end of the text.
  std::string next() {
    while (place_ < text_.size() && is_blank(text_[place_])) line_ += text_[place_++] == '\n' ? 1 : 0;
    const std::size_t begin = place_;
    while (place_ < text_.size() && !is_blank(text_[place_])) ++place_;
    std::string word(text_.substr(begin, place_ - begin));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }
  void skip_line() { place_ = std::min(text_.find('\n', place_), text_.size()); }
  [[noreturn]] void fail(const std::string& found, std::string_view allowed) const {
    throw InputError(fmt::format("{}:{}: found {}, allowed: {}", shown_path(name_), line_,
                                 found.empty() ? "the end of the file" : fmt::format("'{}'", shortened(found)),
                                 allowed));
  }
  void expect(std::string_view word) {
    if (const std::string found = next(); found != word) fail(found, fmt::format("'{}'", word));
  }
  double number() {
    const std::string found = next();
    const auto value = finite_number(found);
    if (!value) fail(found, "a finite number");
    return *value;
  }

private:
  static bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

  std::string_view text_;
  std::string_view name_;
  std::size_t place_ = 0;
  int line_ = 1;
};

/// A number of a stored normal, which may be anything because it is not used; NaN if it is not a number.
double number_or_none(Words& words) {
  return finite_number(words.next()).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Reads what follows the word "facet".
StlFacet read_text_facet(Words& words) {
  StlFacet facet{};
  words.expect("normal");
  for (double* x : {&facet.normal.x, &facet.normal.y, &facet.normal.z}) *x = number_or_none(words);
  words.expect("outer");
  words.expect("loop");
  for (Vector3<double>& corner : facet.corner) {
    words.expect("vertex");
    for (double* x : {&corner.x, &corner.y, &corner.z}) *x = words.number();
  }
  words.expect("endloop");
  words.expect("endfacet");
  return facet;
}

std::vector<StlFacet> read_text(std::string_view bytes, const std::string& name) {
  std::vector<StlFacet> facets;
  Words words(bytes, name);
  for (std::string word = words.next(); !word.empty(); word = words.next()) {
    if (word != "solid") words.fail(word, "'solid'");
    words.skip_line(); // the name, of any number of words
    for (word = words.next(); word != "endsolid"; word = words.next()) {
      if (word != "facet") words.fail(word, "'facet' or 'endsolid'");
      facets.push_back(read_text_facet(words));
    }
    words.skip_line();
  }
  return facets;
}

bool begins_with_solid(std::string_view bytes) {
  return Words(bytes.substr(0, std::min(bytes.size(), std::size_t{80})), "").next() == "solid";
}

[[noreturn]] void fail_of_no_form(std::string_view bytes, const std::string& name) {
  const std::string binary = bytes.size() < head_bytes
                                 ? fmt::format("{} at least", head_bytes)
                                 : fmt::format("{} for the {} triangles in its header",
                                               head_bytes + facet_bytes * binary_count(bytes), binary_count(bytes));
  throw InputError(
      fmt::format("{}: is not an STL file: found {} bytes, a binary one has {}; an ASCII one begins with 'solid'",
                  shown_path(name), bytes.size(), binary));
}

} // namespace

StlFacets read_stl_facets(std::string_view bytes, const std::string& name) {
  const bool binary = bytes.size() >= head_bytes && bytes.size() == head_bytes + facet_bytes * binary_count(bytes);
  if (!binary && !begins_with_solid(bytes)) fail_of_no_form(bytes, name);
  StlFacets result{binary ? read_binary(bytes, name) : read_text(bytes, name), binary};
  if (result.facet.empty())
    throw InputError(fmt::format("{}: found no triangle, allowed: a closed surface of triangles", shown_path(name)));
  return result;
}

} // namespace mpfem
