#pragma once
// The texts and values of a figure's file, in which the words of `for_each` are replaced.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// A number or a text. Throws InputError.
Value value_of(const toml::node& node, const Place& place);

/// One value or a list of them. Throws InputError where there is none.
std::vector<Value> values_of(TableReader& reader, const std::string& key);

/// A name that becomes a file and a target of make. Throws InputError where it cannot be one.
std::string checked_name(TableReader& reader, const std::string& key, std::string name);

/// Entries of `for_each` that are lists.
using Lists = std::map<std::string, std::vector<Value>>;

/// The texts of one table of the file. Everything throws InputError with the place of a mistake.
class Texts {
public:
  Texts(TableReader& reader, const Words& words) : reader_(reader), words_(words) {}
  Texts(TableReader& reader, const Words& words, const Lists& lists) : reader_(reader), words_(words), lists_(&lists) {}

  std::string required(const std::string& key) { return filled_in(key, reader_.string(key)); }
  std::string optional(const std::string& key, std::string_view fallback = "") {
    return filled_in(key, reader_.string_or(key, fallback));
  }
  std::string name(const std::string& key) { return checked_name(reader_, key, required(key)); }
  std::vector<std::string> list(const std::string& key);
  std::vector<Filter> filters(const std::string& key);
  /// A number, or a text in which a word of `for_each` stands for one; nothing where it is absent.
  std::optional<double> number(const std::string& key);
  /// A whole number, or a text in which a word of `for_each` stands for one.
  int integer(const std::string& key, int fallback, Range range);
  /// The value of a key, a list or one; "{name}" alone stands for a list of `for_each`.
  std::vector<Value> values(const std::string& key);
  TableReader& reader() { return reader_; }
  const Words& words() const { return words_; }

private:
  std::string filled_in(const std::string& key, const std::string& text);
  /// The entry `name` of the table `key`.
  Filter filter(const std::string& key, TableReader& table, const std::string& name);

  TableReader& reader_;
  const Words& words_;
  const Lists* lists_ = nullptr;
};

/// The entries of a table's `for_each`: the words with one value and those with a list; one without any where there is
/// no `for_each`.
std::vector<std::pair<Words, Lists>> for_each_entries(TableReader& table);

/// Calls `read` for a table of the file, once for each entry of its `for_each`, and checks that all keys were known.
template <class Read>
void for_each(TableReader table, const Read& read) {
  const auto entries = for_each_entries(table);
  for (const auto& [words, lists] : entries) {
    TableReader again = table;
    Texts texts(again, words, lists);
    read(texts);
    again.finish();
  }
}

} // namespace mpfem
