#include "postproc/figure/figure_texts.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// Whether a field in braces is a name, with or without a format, as tables and for_each have them.
bool is_name(std::string_view field) {
  const std::string_view name = field.substr(0, field.find(':'));
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  const auto belongs = [&](char c) {
    return letters.find(c) != std::string_view::npos || (c >= '0' && c <= '9') || c == '.' || c == '-';
  };
  return !name.empty() && letters.find(name.front()) != std::string_view::npos &&
         std::all_of(name.begin(), name.end(), belongs);
}

/// The names in braces of a text, with their formats. In exponents and indices ("x^{max}"), after other marks of
/// gnuplot, and in double braces they are no names.
std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t i = text.find('{'); i != std::string::npos; i = text.find('{', i + 1)) {
    const std::size_t end = text.find('}', i);
    if (end == std::string::npos) break;
    if (text[i + 1] == '{') {
      ++i;
      continue;
    }
    const std::string field = text.substr(i + 1, end - i - 1);
    const bool marked = i > 0 && std::string_view("^_@&").find(text[i - 1]) != std::string_view::npos;
    if (!marked && is_name(field)) names.push_back(field);
  }
  return names;
}

} // namespace

Value value_of(const toml::node& node, const Place& place) {
  if (const auto* text = node.as_string()) return {text->get(), {}};
  if (const auto number = node.is_number() ? node.value<double>() : std::nullopt) return Value::of(*number);
  place.fail("allowed: a number or a text");
}

std::vector<Value> values_of(TableReader& reader, const std::string& key) {
  const Place place(reader, key);
  const toml::node* node = reader.value(key);
  std::vector<Value> values;
  if (const toml::array* list = node->as_array())
    for (const toml::node& element : *list) values.push_back(value_of(element, place));
  else
    values.push_back(value_of(*node, place));
  if (values.empty()) place.fail("found an empty list, allowed: a value or more");
  return values;
}

std::string checked_name(TableReader& reader, const std::string& key, std::string name) {
  if (name.empty() ||
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") != std::string::npos)
    reader.fail(key, fmt::format("found '{}', allowed: letters, digits, '.', '_' and '-'", name));
  return name;
}

std::vector<std::string> Texts::list(const std::string& key) {
  std::vector<std::string> texts = reader_.strings_or(key, {});
  for (std::string& text : texts) text = filled_in(key, text);
  return texts;
}

std::vector<Filter> Texts::filters(const std::string& key) {
  std::vector<Filter> result;
  auto table = reader_.optional_table(key);
  if (!table) return result;
  for (const std::string& name : table->keys()) result.push_back(filter(key, *table, name));
  return result;
}

Filter Texts::filter(const std::string& key, TableReader& table, const std::string& name) {
  Filter filter{name, {}, {}, {}};
  if (table.value(name)->is_table()) {
    TableReader limits = table.table(name);
    Texts texts(limits, words_);
    filter.at_least = texts.number("at_least");
    filter.at_most = texts.number("at_most");
    if (filter.at_least && filter.at_most && *filter.at_least > *filter.at_most)
      limits.fail("at_most", fmt::format("found {:g}, below 'at_least' = {:g}, allowed: no smaller number",
                                         *filter.at_most, *filter.at_least));
    limits.finish();
    return filter;
  }
  filter.equal = values_of(table, name);
  for (Value& value : filter.equal)
    if (!value.number) value = Value::of_text(filled_in(key, value.text));
  return filter;
}

std::optional<double> Texts::number(const std::string& key) {
  if (!reader_.has(key) || !reader_.value(key)->is_string()) return reader_.optional_number(key);
  const auto number = Value::of_text(required(key)).number;
  if (!number) reader_.fail(key, "allowed: a number");
  return number;
}

int Texts::integer(const std::string& key, int fallback, Range range) {
  if (!reader_.has(key) || !reader_.value(key)->is_string())
    return static_cast<int>(reader_.integer_or(key, fallback, range));
  const auto number = Value::of_text(required(key)).number;
  if (!number || *number != static_cast<int>(*number) || !range.contains(*number))
    reader_.fail(key, fmt::format("allowed: a whole number {}", range.text()));
  return static_cast<int>(*number);
}

std::vector<Value> Texts::values(const std::string& key) {
  std::vector<Value> result = values_of(reader_, key);
  if (lists_ != nullptr && result.size() == 1 && !result.front().number)
    for (const auto& [name, list] : *lists_)
      if (result.front().text == fmt::format("{{{}}}", name)) return list;
  for (Value& value : result)
    if (!value.number) value = Value::of_text(filled_in(key, value.text));
  return result;
}

std::string Texts::shown(const std::string& key, const std::string& later) {
  std::string text = optional(key);
  refuse_names(key, text, later);
  return text;
}

void Texts::refuse_names(const std::string& key, const std::string& text, const std::string& later) const {
  for (const std::string& field : names_in(text)) {
    if (!later.empty() && field.substr(0, field.find(':')) == later) continue;
    std::vector<std::string> known;
    for (const auto& [name, value] : words_) known.push_back(fmt::format("{{{}}}", name));
    if (!later.empty()) known.push_back(fmt::format("{{{}}}", later));
    const std::string allowed = known.empty() ? "no names here; for_each gives them, and a series' group gives {value}"
                                              : fmt::format("{}", fmt::join(known, ", "));
    reader_.fail(key, fmt::format("found '{{{}}}', allowed: {}", one_line(field), allowed));
  }
}

std::string Texts::filled_in(const std::string& key, const std::string& text) {
  return filled_at(Place(reader_, key), text, words_, Unknown::kept);
}

std::vector<std::pair<Words, Lists>> for_each_entries(TableReader& table) {
  std::vector<std::pair<Words, Lists>> entries;
  for (TableReader& entry : table.tables("for_each")) {
    auto& [words, lists] = entries.emplace_back();
    for (const std::string& key : entry.keys()) {
      std::vector<Value> values = values_of(entry, key);
      if (values.size() == 1)
        words[key] = values.front();
      else
        lists[key] = std::move(values);
    }
  }
  if (entries.empty()) entries.emplace_back();
  return entries;
}

} // namespace mpfem
