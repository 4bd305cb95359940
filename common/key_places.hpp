#pragma once
// Places of keys in a file, for messages.

#include <map>
#include <string>
#include <utility>

namespace mpfem {

/// Where the keys of a table are, for errors that cannot be found from the file alone.
class KeyPlaces {
public:
  KeyPlaces() = default;
  KeyPlaces(std::string table, std::map<std::string, std::string> keys)
      : table_(std::move(table)), keys_(std::move(keys)) {}
  /// "FILE:LINE:COLUMN: " of a key, or of the table if it has no such key; empty if there is no file.
  std::string prefix(const std::string& key) const;
  /// Whether the table has the key; without it, its default applies.
  bool has(const std::string& key) const { return keys_.contains(key); }

private:
  std::string table_; ///< place of the table itself
  std::map<std::string, std::string> keys_;
};

} // namespace mpfem
