#pragma once
// Texts and values of a figure's file, with the words of `for_each` filled in.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// A number or a text. Throws InputError for any other type.
Value value_of(const toml::node& node, const Place& place);

/// One value or a list of values. Throws InputError for an empty list.
std::vector<Value> values_of(TableReader& reader, const std::string& key);

/// The name, which becomes a file and a target of make. Throws InputError where it has other characters than letters,
/// digits, '.', '_' and '-'.
std::string checked_name(TableReader& reader, const std::string& key, std::string name);

/// The entries of `for_each` that are lists.
using Lists = std::map<std::string, std::vector<Value>>;

/// The texts of one table of the file. All members throw InputError with the place of the error.
class Texts {
public:
  Texts(TableReader& reader, const Words& words) : reader_(reader), words_(words) {}
  Texts(TableReader& reader, const Words& words, const Lists& lists) : reader_(reader), words_(words), lists_(&lists) {}

  std::string required(const std::string& key) { return filled_in(key, reader_.string(key)); }
  std::string optional(const std::string& key, std::string_view fallback = "") {
    return filled_in(key, reader_.string_or(key, fallback));
  }
  /// A text that readers see, by refuse_names; empty where it is absent.
  std::string shown(const std::string& key, const std::string& later = "");
  /// Refuses a name in braces that nothing fills in, in a text that readers see. `later`: a name that is filled in when
  /// the text is shown. Braces of gnuplot ("s^{-1}", "{/Italic x}") are fine.
  void refuse_names(const std::string& key, const std::string& text, const std::string& later = "") const;
  std::string name(const std::string& key) { return checked_name(reader_, key, required(key)); }
  std::vector<std::string> list(const std::string& key);
  std::vector<Filter> filters(const std::string& key);
  /// A number, or a text that becomes one with the words of `for_each`; empty where it is absent.
  std::optional<double> number(const std::string& key);
  /// A whole number, or a text that becomes one with the words of `for_each`.
  int integer(const std::string& key, int fallback, Range range);
  /// The values of a key that holds one or a list; "{name}" alone stands for a list of `for_each`.
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

/// The entries of a table's `for_each`: the words with one value, and those with a list. Without `for_each` one entry
/// without words.
std::vector<std::pair<Words, Lists>> for_each_entries(TableReader& table);

/// Calls `read` for a table of the file, once for each entry of its `for_each`. Throws InputError for unknown keys.
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
