#pragma once
// Keys that several tables of a scenario have, and checks of keys that several readers need. They throw InputError.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/table_reader.hpp"

namespace mpfem {

/// Refuses keys of `all` that are given but do not belong to the choice made ("law = 'elastic'").
void refuse_foreign_keys(const TableReader& table, const std::vector<std::string>& all,
                         const std::vector<std::string>& meaningful, std::string_view choice);

/// Refuses the table's `name` unless it is a plain word of at most `longest` characters: it becomes part of names of
/// files or datasets.
void check_name(const TableReader& table, const std::string& name, std::size_t longest);

/// Reads `axis`: 0 x, 1 y, 2 z; z if it is missing.
std::size_t read_axis(TableReader& table);

} // namespace mpfem
