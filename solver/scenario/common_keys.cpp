#include "solver/scenario/common_keys.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mpfem {

void refuse_foreign_keys(const TableReader& table, const std::vector<std::string>& all,
                         const std::vector<std::string>& meaningful, std::string_view choice) {
  for (const std::string& key : all)
    if (table.has(key) && std::find(meaningful.begin(), meaningful.end(), key) == meaningful.end())
      table.fail(key, fmt::format("cannot be used with {}", choice));
}

void check_name(const TableReader& table, const std::string& name, std::size_t longest) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (name.empty() || name.size() > longest || !plain)
    table.fail("name", fmt::format("found '{}', allowed: 1 … {} letters (a … z), digits, '-' and '_'",
                                   name.size() > longest ? "a longer text" : name, longest));
}

std::size_t read_axis(TableReader& table) {
  return static_cast<std::size_t>(table.choice_or("axis", "z", {"x", "y", "z"})[0] - 'x');
}

} // namespace mpfem
