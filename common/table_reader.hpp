#pragma once
// A strict, typed view of one TOML table: every key must be read, every value has a range, and each mistake becomes one
// line "FILE:LINE:COLUMN: key 'a.b': found …, allowed: …" (InputError, exit code 2).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/key_places.hpp"
#include "common/range.hpp"
#include "common/toml.hpp"

namespace mpfem {

/// A TOML document, overridden by the values of `--set key=value`. It can be moved, not copied: copies would lose the
/// lines and columns of its values.
class TomlDocument {
public:
  TomlDocument(TomlDocument&&) = default;
  TomlDocument& operator=(TomlDocument&&) = default;
  TomlDocument(const TomlDocument&) = delete;
  TomlDocument& operator=(const TomlDocument&) = delete;

  /// Reads and parses a regular file of at most `most_bytes`. Throws InputError (missing file, syntax error with line
  /// and column, tables or arrays that nest too deep).
  static TomlDocument from_file(const std::string& path);
  /// Parses text; `name` stands for the file in messages.
  static TomlDocument from_text(std::string_view text, const std::string& name);

  static constexpr std::size_t most_bytes = std::size_t{8} << 20U;

  /// Applies "a.b.c=value" (value: TOML syntax; anything else, such as a bare word or a path, is taken as a string;
  /// array elements by number: "stages.0.wall_speed=…"). Missing tables are created; missing array elements are not.
  /// Messages about the value name the assignment instead of line and column. Throws InputError.
  void set(std::string_view assignment);

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }
  /// The document as TOML text, assignments included (keys in alphabetical order, without comments).
  std::string text() const;

private:
  TomlDocument(toml::table root, std::string name);

  toml::table root_;
  std::string name_;
};

/// Strict reader of one table of a document that must outlive it. Call `finish()` when all known keys have been read:
/// it throws on unknown keys and names the nearest known one. Numbers are finite: "nan" and "inf" are refused. Every
/// function throws InputError.
class TableReader {
public:
  explicit TableReader(const TomlDocument& document);

  /// Whether the key is there. It counts as known, but is not yet read.
  bool has(std::string_view key) const;
  /// All keys of the table, in the order of the file.
  std::vector<std::string> keys() const;
  /// The raw value, for keys that take several types; nothing if it is absent.
  const toml::node* value(std::string_view key) { return find(key); }

  double number(std::string_view key, Range range = {});                     ///< required
  double number_or(std::string_view key, double fallback, Range range = {}); ///< optional with default
  std::optional<double> optional_number(std::string_view key, Range range = {});
  std::int64_t integer(std::string_view key, Range range = {}); ///< a whole number without decimal point
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, Range range = {});
  bool boolean_or(std::string_view key, bool fallback);
  std::string string(std::string_view key);
  std::string string_or(std::string_view key, std::string_view fallback);
  /// One of `allowed`; the message lists them.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  std::string choice_or(std::string_view key, std::string_view fallback, const std::vector<std::string>& allowed);
  std::vector<double> numbers(std::string_view key, Range range = {}); ///< required array
  /// A required array of whole numbers, with or without a decimal point.
  std::vector<std::int64_t> integers(std::string_view key, Range range = {});
  std::vector<double> numbers_or(std::string_view key, std::vector<double> fallback, Range range = {});
  std::array<double, 3> vector3(std::string_view key, Range range = {}); ///< required array of three numbers
  std::array<double, 3> vector3_or(std::string_view key, std::array<double, 3> fallback, Range range = {});
  /// An array of arrays of three numbers; empty when absent.
  std::vector<std::array<double, 3>> vectors3(std::string_view key, Range range = {});
  std::vector<std::string> strings_or(std::string_view key, std::vector<std::string> fallback);

  /// A required sub-table; an absent one is reported as a missing key.
  TableReader table(std::string_view key);
  std::optional<TableReader> optional_table(std::string_view key);
  /// An array of tables ([[key]]), in order; empty when absent.
  std::vector<TableReader> tables(std::string_view key);

  /// "FILE:LINE:COLUMN: key 'a.b': " + message, thrown as InputError; for checks across keys.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Where the table's own keys are in the file.
  KeyPlaces places() const;
  /// Throws on the first key that was not read, and names the nearest known key.
  void finish() const;

private:
  TableReader(const toml::table& table, std::string file, std::string path);
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key, std::string_view allowed);
  std::string full_key(std::string_view key) const;
  [[noreturn]] void fail_at(const toml::source_region& source, std::string_view key, std::string_view message) const;

  double read_number(const toml::node& node, std::string_view key, const Range& range) const;
  std::int64_t read_integer(const toml::node& node, std::string_view key, const Range& range) const;
  std::string read_string(const toml::node& node, std::string_view key) const;
  std::string read_choice(const toml::node& node, std::string_view key, const std::vector<std::string>& allowed) const;
  const toml::array& read_array(const toml::node& node, std::string_view key, std::string_view expected) const;
  std::vector<double> read_numbers(const toml::node& node, std::string_view key, const Range& range) const;
  std::array<double, 3> read_vector3(const toml::node& node, std::string_view key, const Range& range) const;

  const toml::table* table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> asked_;             ///< read, or looked for to be read
  mutable std::set<std::string, std::less<>> mentioned_; ///< asked whether they are there
};

} // namespace mpfem
