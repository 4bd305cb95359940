#include "common/table_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/text_input.hpp"
#include "common/toml_scan.hpp"

namespace mpfem {

namespace {

constexpr std::string_view assignment_mark = "--set ";
constexpr std::size_t longest_word = 60;     // of a key or value in a message
constexpr std::size_t longest_place = 120;   // characters of an assignment in a message
constexpr std::size_t longest_finding = 160; // of the parser's message, which repeats parts of the text

[[noreturn]] void throw_input_error(std::string_view place, std::string_view message) {
  throw InputError(one_line(fmt::format("{}: {}", place, message)));
}

/// "FILE:LINE:COLUMN", or the assignment that a value comes from, or the file alone if nothing else is known.
std::string place_text(const std::string& file, const toml::source_region& source) {
  if (source.path && source.path->starts_with(assignment_mark)) return shortened(*source.path, longest_place);
  if (!source.begin) return shown_path(file);
  return fmt::format("{}:{}:{}", shown_path(file), source.begin.line, source.begin.column);
}

std::string_view type_text(const toml::node& node) {
  switch (node.type()) {
  case toml::node_type::table:
    return "a table";
  case toml::node_type::array:
    return node.as_array()->is_array_of_tables() ? "an array of tables" : "an array";
  case toml::node_type::string:
    return "a string";
  case toml::node_type::integer:
    return "an integer";
  case toml::node_type::floating_point:
    return "a number";
  case toml::node_type::boolean:
    return "a boolean";
  case toml::node_type::date:
  case toml::node_type::time:
  case toml::node_type::date_time:
    return "a date or time";
  default:
    return "nothing";
  }
}

/// "the string 'abc'", "a table"…: what a message reports as found.
std::string found_text(const toml::node& node) {
  if (const auto* value = node.as_string())
    return fmt::format("the string '{}'", shortened(value->get(), longest_word));
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  return std::string(type_text(node));
}

std::string wrong_type(const toml::node& node, std::string_view expected) {
  return fmt::format("found {}, allowed: {}", found_text(node), expected);
}

std::string quoted_list(const std::vector<std::string>& words) {
  return fmt::format("'{}'", fmt::join(words, "', '"));
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  if (const auto line = line_nested_too_deep(text))
    throw_input_error(fmt::format("{}:{}", shown_path(name), *line),
                      fmt::format("tables and arrays are nested too deeply, allowed: up to {} levels", deepest_toml));
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw_input_error(place_text(name, error.source()),
                      fmt::format("not valid TOML: {}", shortened(error.description(), longest_finding)));
  }
}

/// The value on the right of an assignment. The node remembers the assignment as its source.
toml::table parse_assigned_value(std::string_view value, const std::string& source) {
  const auto first = value.find_first_not_of(" \t");
  if (first == std::string_view::npos) throw_input_error(source, "the value is empty, allowed: KEY=VALUE");
  value = value.substr(first, value.find_last_not_of(" \t") - first + 1);
  if (value.find_first_of("\r\n") != std::string_view::npos) throw_input_error(source, "the value has several lines");
  if (line_nested_too_deep(value))
    throw_input_error(source, fmt::format("the value is nested too deeply, allowed: up to {} levels", deepest_toml));
  try {
    return toml::parse(fmt::format("value = {}", value), source);
  } catch (const toml::parse_error& error) {
    if (std::string_view("\"'[{").find(value.front()) != std::string_view::npos)
      throw_input_error(source,
                        fmt::format("not a valid TOML value: {}", shortened(error.description(), longest_finding)));
  }
  std::string literal = "value = \"";
  for (const char c : value) {
    if (c == '"' || c == '\\') literal += '\\';
    literal += c;
  }
  return parse_toml(literal + '"', source);
}

std::vector<std::string> split_key(std::string_view key, const std::string& source) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    parts.emplace_back(key.substr(begin, end - begin));
    if (parts.back().empty() || parts.back().find_first_of(" \t\r\n\"'[]") != std::string::npos)
      throw_input_error(source,
                        fmt::format("'{}' is not a key, allowed: words joined by dots, such as 'contact.search_margin' "
                                    "or 'stages.0.name'",
                                    shortened(key, longest_word)));
    if (parts.size() > deepest_toml)
      throw_input_error(source, fmt::format("found a key of too many parts, allowed: up to {}", deepest_toml));
    begin = end + 1;
  }
  return parts;
}

std::size_t element_index(const toml::array& array, const std::string& index, const std::string& source) {
  std::size_t i = 0;
  const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), i);
  if (error == std::errc{} && end == index.data() + index.size() && i < array.size()) return i;
  throw_input_error(source, array.empty()
                                ? fmt::format("found element '{}' of an empty array", shortened(index, longest_word))
                                : fmt::format("found element '{}' of an array, allowed: 0 … {}",
                                              shortened(index, longest_word), array.size() - 1));
}

/// The table or array element below `parent`; created if a table has none.
toml::node& child(toml::node& parent, const std::string& part, const toml::source_region& source) {
  if (toml::array* array = parent.as_array()) return *array->get(element_index(*array, part, *source.path));
  toml::table* table = parent.as_table();
  if (table == nullptr)
    throw_input_error(*source.path, fmt::format("'{}' is below {}, which has no keys", shortened(part, longest_word),
                                                type_text(parent)));
  if (table->get(part) == nullptr) table->insert_or_assign(toml::key(part, source), toml::table{});
  return *table->get(part);
}

} // namespace

// ---------------------------------------------------------------- TomlDocument

TomlDocument::TomlDocument(toml::table root, std::string name) : root_(std::move(root)), name_(std::move(name)) {}

TomlDocument TomlDocument::from_file(const std::string& path) {
  refuse_irregular_file(path);
  if (is_hdf5(path)) throw_input_error(shown_path(path), "found an HDF5 file, allowed: a text file (TOML)");
  return from_text(read_text_file(path, most_bytes), path);
}

TomlDocument TomlDocument::from_text(std::string_view text, const std::string& name) {
  return {parse_toml(text, name), name};
}

void TomlDocument::set(std::string_view assignment) {
  const std::string source =
      fmt::format("{}{}", assignment_mark, shortened(assignment, longest_place - assignment_mark.size()));
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) throw_input_error(source, "found no '=', allowed: KEY=VALUE");
  const std::vector<std::string> parts = split_key(assignment.substr(0, equals), source);
  toml::table parsed = parse_assigned_value(assignment.substr(equals + 1), source);
  toml::node& value = *parsed.get("value");
  const toml::source_region at{.begin = {1, 1}, .end = {1, 1}, .path = std::make_shared<const std::string>(source)};

  toml::node* parent = &root_;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) parent = &child(*parent, parts[i], at);
  const std::string& last = parts.back();
  if (toml::table* table = parent->as_table()) {
    value.visit([&](auto& typed) { table->insert_or_assign(toml::key(last, at), std::move(typed)); });
  } else if (toml::array* array = parent->as_array()) {
    const std::size_t i = element_index(*array, last, source);
    value.visit(
        [&](auto& typed) { array->replace(array->begin() + static_cast<std::ptrdiff_t>(i), std::move(typed)); });
  } else {
    throw_input_error(
        source, fmt::format("'{}' is below {}, which has no keys", shortened(last, longest_word), type_text(*parent)));
  }
}

std::string TomlDocument::text() const {
  std::ostringstream text;
  text << root_ << '\n';
  return text.str();
}

// ---------------------------------------------------------------- TableReader

TableReader::TableReader(const TomlDocument& document) : TableReader(document.root(), document.name(), "") {}

TableReader::TableReader(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

bool TableReader::has(std::string_view key) const {
  mentioned_.emplace(key);
  return table_->get(key) != nullptr;
}

std::vector<std::string> TableReader::keys() const {
  std::vector<const toml::key*> found;
  for (const auto& entry : *table_) found.push_back(&entry.first);
  std::sort(found.begin(), found.end(),
            [](const toml::key* a, const toml::key* b) { return a->source().begin < b->source().begin; });
  std::vector<std::string> names;
  for (const toml::key* key : found) names.emplace_back(key->str());
  return names;
}

const toml::node* TableReader::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

const toml::node& TableReader::require(std::string_view key, std::string_view allowed) {
  if (const toml::node* node = find(key)) return *node;
  std::string message = fmt::format("missing, allowed: {}", allowed);
  std::vector<std::string> present;
  for (const auto& entry : *table_)
    if (!asked_.contains(entry.first.str())) present.emplace_back(entry.first.str());
  if (const auto near = nearest_word(key, present)) {
    const auto line = table_->find(*near)->first.source().begin.line;
    message += line > 0 ? fmt::format(" (did you mean '{}' in line {}?)", shortened(*near, longest_word), line)
                        : fmt::format(" (did you mean '{}'?)", shortened(*near, longest_word));
  }
  fail_at(table_->source(), key, message);
}

std::string TableReader::full_key(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::fail_at(const toml::source_region& source, std::string_view key, std::string_view message) const {
  throw_input_error(place_text(file_, source), fmt::format("key '{}': {}", shortened(full_key(key)), message));
}

void TableReader::fail(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->get(key);
  fail_at(node != nullptr ? node->source() : table_->source(), key, message);
}

// Values of one node. `key` is the name for messages, with the element's number if the node is in an array.

double TableReader::read_number(const toml::node& node, std::string_view key, const Range& range) const {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) fail_at(node.source(), key, wrong_type(node, allowed_number("a number", range)));
  if (!std::isfinite(*value)) fail_at(node.source(), key, wrong_type(node, allowed_number("a finite number", range)));
  if (!range.contains(*value)) fail_at(node.source(), key, fmt::format("found {}, allowed: {}", *value, range.text()));
  return *value;
}

std::int64_t TableReader::read_integer(const toml::node& node, std::string_view key, const Range& range) const {
  if (!node.is_integer()) fail_at(node.source(), key, wrong_type(node, allowed_number("an integer", range)));
  const std::int64_t value = node.as_integer()->get();
  if (!range.contains(static_cast<double>(value)))
    fail_at(node.source(), key, fmt::format("found {}, allowed: {}", value, range.text()));
  return value;
}

std::string TableReader::read_string(const toml::node& node, std::string_view key) const {
  if (!node.is_string()) fail_at(node.source(), key, wrong_type(node, "a string"));
  return node.as_string()->get();
}

std::string TableReader::read_choice(const toml::node& node, std::string_view key,
                                     const std::vector<std::string>& allowed) const {
  if (!node.is_string()) fail_at(node.source(), key, wrong_type(node, fmt::format("one of {}", quoted_list(allowed))));
  const std::string& value = node.as_string()->get();
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  std::string message = fmt::format("found '{}', allowed: {}", shortened(value, longest_word), quoted_list(allowed));
  if (const auto near = nearest_word(value, allowed)) message += fmt::format(" (did you mean '{}'?)", *near);
  fail_at(node.source(), key, message);
}

const toml::array& TableReader::read_array(const toml::node& node, std::string_view key,
                                           std::string_view expected) const {
  if (!node.is_array()) fail_at(node.source(), key, wrong_type(node, expected));
  return *node.as_array();
}

std::vector<double> TableReader::read_numbers(const toml::node& node, std::string_view key, const Range& range) const {
  const toml::array& array = read_array(node, key, "an array of numbers");
  std::vector<double> values;
  values.reserve(array.size());
  for (const toml::node& element : array)
    values.push_back(read_number(element, fmt::format("{}.{}", key, values.size()), range));
  return values;
}

std::array<double, 3> TableReader::read_vector3(const toml::node& node, std::string_view key,
                                                const Range& range) const {
  const toml::array& array = read_array(node, key, "an array of three numbers");
  if (array.size() != 3)
    fail_at(node.source(), key, fmt::format("found {} elements, allowed: an array of three numbers", array.size()));
  const std::vector<double> values = read_numbers(node, key, range);
  return {values[0], values[1], values[2]};
}

// Public readers: required, with a fallback, optional.

double TableReader::number(std::string_view key, Range range) {
  return read_number(require(key, allowed_number("a number", range)), key, range);
}

double TableReader::number_or(std::string_view key, double fallback, Range range) {
  const toml::node* node = find(key);
  return node != nullptr ? read_number(*node, key, range) : fallback;
}

std::optional<double> TableReader::optional_number(std::string_view key, Range range) {
  const toml::node* node = find(key);
  return node != nullptr ? std::optional(read_number(*node, key, range)) : std::nullopt;
}

std::int64_t TableReader::integer(std::string_view key, Range range) {
  return read_integer(require(key, allowed_number("an integer", range)), key, range);
}

std::int64_t TableReader::integer_or(std::string_view key, std::int64_t fallback, Range range) {
  const toml::node* node = find(key);
  return node != nullptr ? read_integer(*node, key, range) : fallback;
}

bool TableReader::boolean_or(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) fail_at(node->source(), key, wrong_type(*node, "true or false"));
  return node->as_boolean()->get();
}

std::string TableReader::string(std::string_view key) {
  return read_string(require(key, "a string"), key);
}

std::string TableReader::string_or(std::string_view key, std::string_view fallback) {
  const toml::node* node = find(key);
  return node != nullptr ? read_string(*node, key) : std::string(fallback);
}

std::string TableReader::choice(std::string_view key, const std::vector<std::string>& allowed) {
  return read_choice(require(key, fmt::format("one of {}", quoted_list(allowed))), key, allowed);
}

std::string TableReader::choice_or(std::string_view key, std::string_view fallback,
                                   const std::vector<std::string>& allowed) {
  const toml::node* node = find(key);
  return node != nullptr ? read_choice(*node, key, allowed) : std::string(fallback);
}

std::vector<double> TableReader::numbers(std::string_view key, Range range) {
  return read_numbers(require(key, "an array of numbers"), key, range);
}

std::vector<std::int64_t> TableReader::integers(std::string_view key, Range range) {
  const toml::node& node = require(key, "an array of whole numbers");
  constexpr double largest = 9007199254740992.0; // 2^53: beyond it a double no longer identifies one integer
  range.low = std::max(range.low, -largest), range.high = std::min(range.high, largest);
  std::vector<std::int64_t> values;
  for (const double number : read_numbers(node, key, range)) {
    values.push_back(static_cast<std::int64_t>(number));
    if (static_cast<double>(values.back()) != number)
      fail_at(node.source(), key, fmt::format("found {:g}, allowed: whole numbers", number));
  }
  return values;
}

std::vector<double> TableReader::numbers_or(std::string_view key, std::vector<double> fallback, Range range) {
  const toml::node* node = find(key);
  return node != nullptr ? read_numbers(*node, key, range) : std::move(fallback);
}

std::array<double, 3> TableReader::vector3(std::string_view key, Range range) {
  return read_vector3(require(key, "an array of three numbers"), key, range);
}

std::array<double, 3> TableReader::vector3_or(std::string_view key, std::array<double, 3> fallback, Range range) {
  const toml::node* node = find(key);
  return node != nullptr ? read_vector3(*node, key, range) : fallback;
}

std::vector<std::array<double, 3>> TableReader::vectors3(std::string_view key, Range range) {
  std::vector<std::array<double, 3>> vectors;
  const toml::node* node = find(key);
  if (node == nullptr) return vectors;
  for (const toml::node& element : read_array(*node, key, "an array of arrays of three numbers"))
    vectors.push_back(read_vector3(element, fmt::format("{}.{}", key, vectors.size()), range));
  return vectors;
}

std::vector<std::string> TableReader::strings_or(std::string_view key, std::vector<std::string> fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  std::vector<std::string> values;
  for (const toml::node& element : read_array(*node, key, "an array of strings"))
    values.push_back(read_string(element, fmt::format("{}.{}", key, values.size())));
  return values;
}

TableReader TableReader::table(std::string_view key) {
  const toml::node& node = require(key, fmt::format("a table [{}]", full_key(key)));
  if (!node.is_table()) fail_at(node.source(), key, wrong_type(node, fmt::format("a table [{}]", full_key(key))));
  return {*node.as_table(), file_, full_key(key)};
}

std::optional<TableReader> TableReader::optional_table(std::string_view key) {
  if (find(key) == nullptr) return std::nullopt;
  return table(key);
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  std::vector<TableReader> readers;
  const toml::node* node = find(key);
  if (node == nullptr) return readers;
  const std::string expected = fmt::format("an array of tables [[{}]]", full_key(key));
  for (const toml::node& element : read_array(*node, key, expected)) {
    const std::string element_key = fmt::format("{}.{}", key, readers.size());
    if (!element.is_table()) fail_at(element.source(), element_key, wrong_type(element, "a table"));
    readers.push_back(TableReader(*element.as_table(), file_, full_key(element_key)));
  }
  return readers;
}

KeyPlaces TableReader::places() const {
  std::map<std::string, std::string> keys;
  for (const auto& [key, node] : *table_) keys.emplace(key.str(), place_text(file_, node.source()));
  return {place_text(file_, table_->source()), std::move(keys)};
}

void TableReader::finish() const {
  // The table iterates alphabetically; the mistake to report is the one that comes first in the file.
  const auto unknown = [&](const auto& entry) { return !asked_.contains(entry.first.str()); };
  const toml::key* first = nullptr;
  for (const auto& entry : *table_)
    if (unknown(entry) && (first == nullptr || entry.first.source().begin < first->source().begin))
      first = &entry.first;
  if (first == nullptr) return;

  std::string message = fmt::format("unknown key '{}'", shortened(full_key(first->str())));
  std::set<std::string, std::less<>> known = asked_;
  known.insert(mentioned_.begin(), mentioned_.end());
  known.erase(std::string(first->str()));
  if (const auto near = nearest_word(first->str(), {known.begin(), known.end()}))
    message += fmt::format(" (did you mean '{}'?)", *near);
  else if (!known.empty())
    message += fmt::format(", known here: {}", fmt::join(known, ", "));
  throw_input_error(place_text(file_, first->source()), message);
}

} // namespace mpfem
