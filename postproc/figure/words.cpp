#include "postproc/figure/words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// The largest number of digits in a row; a format's width and precision are such rows.
std::size_t most_digits(std::string_view text) {
  std::size_t most = 0, row = 0;
  for (const char c : text) {
    row = c >= '0' && c <= '9' ? row + 1 : 0;
    most = std::max(most, row);
  }
  return most;
}

/// A number below a million in the format "g", without the exponent that this format writes where the number has more
/// digits than wanted: 5400 instead of 5.4e+03.
std::string without_exponent(std::string text) {
  const std::size_t exponent = text.find("e+0");
  if (exponent == std::string::npos || text.back() > '5') return text;
  const std::string_view sign = text.starts_with('+') ? "+" : "";
  double rounded = 0;
  const auto [stop, error] = std::from_chars(text.data() + sign.size(), text.data() + text.size(), rounded);
  return error == std::errc() ? fmt::format("{}{:.0f}", sign, rounded) : text; // fails where a width adds blanks
}

std::string number_text(double number, std::string_view format) {
  const bool percent = format.ends_with('%');
  if (percent) format.remove_suffix(1);
  if (most_digits(format) > 2)
    throw InputError(
        fmt::format("found the format '{}', allowed: width and precision of at most two digits", one_line(format)));
  try {
    const std::string pattern = format.empty() ? "{}" : fmt::format("{{:{}}}", format);
    std::string text = fmt::format(fmt::runtime(pattern), percent ? 100 * number : number);
    if (format.ends_with('g')) text = without_exponent(std::move(text));
    return text + (percent ? " %" : "");
  } catch (const fmt::format_error&) {
    throw InputError(
        fmt::format("found the format '{}', allowed: a number format such as .2f or .3g", one_line(format)));
  }
}

std::string replaced(std::string_view field, const Words& words, Unknown unknown) {
  const std::size_t colon = field.find(':');
  const std::string_view name = field.substr(0, colon);
  const auto word = words.find(name);
  if (word == words.end()) {
    if (unknown == Unknown::kept) return fmt::format("{{{}}}", field);
    std::vector<std::string> names;
    for (const auto& [known, value] : words) names.push_back(known);
    const auto near = nearest_word(name, names);
    throw InputError(fmt::format("found '{{{}}}', {}", one_line(field),
                                 near ? fmt::format("did you mean '{}'?", *near)
                                      : fmt::format("allowed: {} in braces", fmt::join(names, ", "))));
  }
  const Value& value = word->second;
  if (colon == std::string_view::npos) return value.text;
  if (!value.number) {
    if (value.text.empty()) return "not known";
    throw InputError(fmt::format("found '{{{}}}', but {} is the text '{}', which has no format", one_line(field),
                                 one_line(name), one_line(value.text)));
  }
  return number_text(*value.number, field.substr(colon + 1));
}

} // namespace

Value Value::of(double number) {
  return {fmt::format("{}", number), number};
}

Value Value::of_text(std::string text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && stop == end && !text.empty() && std::isfinite(number)) return {std::move(text), number};
  return {std::move(text), {}};
}

bool Value::operator==(const Value& other) const {
  return number && other.number ? *number == *other.number : text == other.text;
}

std::string filled(std::string_view pattern, const Words& words, Unknown unknown) {
  std::string result;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    if ((c == '{' || c == '}') && i + 1 < pattern.size() && pattern[i + 1] == c) {
      result += unknown == Unknown::kept ? std::string(2, c) : std::string(1, c);
      ++i;
      continue;
    }
    const std::size_t end = c == '{' ? pattern.find('}', i) : std::string_view::npos;
    if (c == '{' && end == std::string_view::npos && unknown == Unknown::refused)
      throw InputError(fmt::format("found '{}' without the brace that closes it, allowed: names in braces, and '{{{{' "
                                   "for a brace",
                                   one_line(pattern.substr(i))));
    if (end == std::string_view::npos) {
      result += c;
      continue;
    }
    result += replaced(pattern.substr(i + 1, end - i - 1), words, unknown);
    i = end;
  }
  return result;
}

} // namespace mpfem
