#pragma once
// Places of keys in a file, for messages.

#include <map>
#include <string>
#include <utility>

namespace mpfem {

/// Where the keys of a table stand, for refusals that need more than the file itself to be found.
class KeyPlaces {
public:
  KeyPlaces() = default;
  KeyPlaces(std::string table, std::map<std::string, std::string> keys)
      : table_(std::move(table)), keys_(std::move(keys)) {}
  /// "FILE:LINE:COLUMN: " of a key, or of the table where it has no such key; empty where there is no file.
  std::string prefix(const std::string& key) const;

private:
  std::string table_; ///< place of the table itself
  std::map<std::string, std::string> keys_;
};

} // namespace mpfem
