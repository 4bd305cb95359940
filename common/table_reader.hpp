#pragma once
// A strict, typed view of one TOML table: every key must be asked for, every value has a range, and each mistake
// becomes one line "FILE:LINE:COLUMN: key 'a.b': found …, allowed …" (InputError, exit code 2).

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace mpfem {

/// Admissible closed or half-open interval of a number; the message prints it.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  static Range any() { return {}; }
  static Range positive() { return {.low = 0, .low_open = true}; }
  static Range non_negative() { return {.low = 0}; }
  static Range between(double low, double high) { return {.low = low, .high = high}; }
  bool contains(double value) const;
  std::string text() const; ///< "> 0", "0 … 1", …
};

/// A TOML document with the values of `--set key=value` laid over it.
class TomlDocument {
public:
  /// Reads and parses a file. Throws InputError (missing file, syntax error with line and column).
  static TomlDocument from_file(const std::string& path);
  /// Parses text; `name` stands for the file in messages.
  static TomlDocument from_text(std::string_view text, const std::string& name);

  /// Applies "a.b.c=value" (value: TOML syntax; a bare word is taken as a string; array elements by number:
  /// "stages.0.speed=…"). Throws InputError.
  void set(std::string_view assignment);

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }
  /// The document as TOML text, assignments included.
  std::string text() const;

private:
  toml::table root_;
  std::string name_;
};

/// Strict reader of one table. Call `finish()` when all known keys were asked for: it throws on unknown keys and names
/// the nearest known one.
class TableReader {
public:
  explicit TableReader(const TomlDocument& document);

  bool has(std::string_view key) const;

  double number(std::string_view key, Range range = {});                           ///< required
  double number_or(std::string_view key, double fallback, Range range = {});       ///< optional with default
  std::optional<double> optional_number(std::string_view key, Range range = {});
  std::int64_t integer(std::string_view key, Range range = {});
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, Range range = {});
  bool boolean_or(std::string_view key, bool fallback);
  std::string string(std::string_view key);
  std::string string_or(std::string_view key, std::string_view fallback);
  /// One of `allowed`; the message lists them.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  std::string choice_or(std::string_view key, std::string_view fallback, const std::vector<std::string>& allowed);
  std::vector<double> numbers(std::string_view key, Range range = {});                        ///< required array
  std::vector<double> numbers_or(std::string_view key, std::vector<double> fallback, Range range = {});
  std::array<double, 3> vector3(std::string_view key, Range range = {});
  std::vector<std::string> strings_or(std::string_view key, std::vector<std::string> fallback);

  /// A required sub-table; an absent one is reported as a missing key.
  TableReader table(std::string_view key);
  std::optional<TableReader> optional_table(std::string_view key);
  /// An array of tables ([[key]]), in order; empty when absent.
  std::vector<TableReader> tables(std::string_view key);

  /// "FILE:LINE:COLUMN: key 'a.b': " + message, thrown as InputError; for checks across keys.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Throws on the first key that nobody asked for, with the nearest known key.
  void finish() const;

private:
  TableReader(const toml::table& table, std::string file, std::string path);
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key);

  const toml::table* table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> asked_;
};

} // namespace mpfem
