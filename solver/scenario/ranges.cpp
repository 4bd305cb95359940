#include "solver/scenario/ranges.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mpfem {

/// Refuses keys of `all` that are given but do not belong to the choice made ("law = 'elastic'").
void refuse_foreign_keys(const TableReader& table, const std::vector<std::string>& all,
                         const std::vector<std::string>& meaningful, std::string_view choice) {
  for (const std::string& key : all)
    if (table.has(key) && std::find(meaningful.begin(), meaningful.end(), key) == meaningful.end())
      table.fail(key, fmt::format("cannot be used with {}", choice));
}

} // namespace mpfem
