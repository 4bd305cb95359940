#pragma once
// What tells two TOML documents apart.

#include <optional>
#include <string>

#include <toml++/toml.h>

namespace mpfem {

/// The first key, in alphabetical order, whose values differ.
struct TomlDifference {
  std::string key;           ///< "stages.0.wall_speed"
  std::string first, second; ///< its values, shortened; "nothing" where the key is missing
};

/// Nothing where the tables hold the same.
std::optional<TomlDifference> first_difference(const toml::table& first, const toml::table& second);

} // namespace mpfem
