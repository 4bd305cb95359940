#pragma once
// The first difference between two TOML documents.

#include <optional>
#include <string>

#include "common/toml.hpp"

namespace mpfem {

/// The first key, in alphabetical order, whose values differ.
struct TomlDifference {
  std::string key;           ///< "stages.0.wall_speed"
  std::string first, second; ///< its values, shortened; "nothing" if the key is missing
};

/// Nothing if the tables have the same content.
std::optional<TomlDifference> first_difference(const toml::table& first, const toml::table& second);

} // namespace mpfem
