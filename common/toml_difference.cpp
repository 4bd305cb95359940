#include "common/toml_difference.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

namespace {

std::optional<TomlDifference> difference_of(const toml::node* first, const toml::node* second, const std::string& key);

std::string value_text(const toml::node* node) {
  constexpr std::size_t longest = 40;
  if (node == nullptr) return "nothing";
  if (node->is_table()) return "a table";
  if (const toml::array* array = node->as_array())
    return array->size() == 1 ? "an array of 1 element" : "an array of " + std::to_string(array->size()) + " elements";
  if (const auto number = node->value_exact<double>())
    return fmt::format("{:#}", *number); // as short as it can be, with a point
  std::ostringstream text;
  node->visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << value;
  });
  return shortened(text.str(), longest);
}

std::string below(const std::string& key, std::string_view part) {
  return key.empty() ? std::string(part) : key + "." + std::string(part);
}

std::optional<TomlDifference> tables_difference(const toml::table& first, const toml::table& second,
                                                const std::string& key) {
  std::set<std::string_view> parts;
  for (const toml::table* table : {&first, &second})
    for (const auto& entry : *table) parts.insert(entry.first.str());
  for (const std::string_view part : parts)
    if (auto difference = difference_of(first.get(part), second.get(part), below(key, part))) return difference;
  return std::nullopt;
}

std::optional<TomlDifference> arrays_difference(const toml::array& first, const toml::array& second,
                                                const std::string& key) {
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
    if (auto difference = difference_of(first.get(i), second.get(i), below(key, std::to_string(i)))) return difference;
  if (first.size() == second.size()) return std::nullopt;
  return TomlDifference{key, value_text(&first), value_text(&second)};
}

std::optional<TomlDifference> difference_of(const toml::node* first, const toml::node* second, const std::string& key) {
  if (first != nullptr && second != nullptr && first->type() == second->type()) {
    if (first->is_table()) return tables_difference(*first->as_table(), *second->as_table(), key);
    if (first->is_array()) return arrays_difference(*first->as_array(), *second->as_array(), key);
    const bool same = first->visit([second](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>)
        return value == *second->as<toml::inserted_type_of<decltype(value.get())>>();
      else
        return false;
    });
    if (same) return std::nullopt;
  }
  return TomlDifference{shortened(key), value_text(first), value_text(second)};
}

} // namespace

std::optional<TomlDifference> first_difference(const toml::table& first, const toml::table& second) {
  return tables_difference(first, second, "");
}

} // namespace mpfem
