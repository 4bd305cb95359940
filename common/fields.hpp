#pragma once
// One list of a state's fields serves writing and reading: each state has
//   template <class State, class Visitor> void for_each_field(State& state, Visitor&& visit)
// that calls visit(name, field) for all its fields, always in the same order. Doubles, whole numbers, bools, enums and
// arrays of these are fields.

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mpfem {

/// Fields as plain numbers, in the order in which they were visited.
struct FieldValues {
  std::vector<std::string> name;     ///< of every field; an array is one field
  std::vector<double> number;        ///< doubles
  std::vector<std::int64_t> integer; ///< whole numbers, bools (0, 1) and enums (their number)
  bool operator==(const FieldValues&) const = default;
};

/// Collects fields.
class FieldWriter {
public:
  template <class Field>
  void operator()(std::string_view name, const Field& field) {
    values_.name.emplace_back(name);
    append(field);
  }
  const FieldValues& values() const { return values_; }

private:
  template <class Field>
  void append(const Field& field) {
    if constexpr (std::is_floating_point_v<Field>)
      values_.number.push_back(field);
    else
      values_.integer.push_back(static_cast<std::int64_t>(field));
  }
  template <class Field, std::size_t Size>
  void append(const std::array<Field, Size>& fields) {
    for (const Field& field : fields) append(field);
  }
  FieldValues values_;
};

/// Gives fields back the values that a FieldWriter collected.
class FieldReader {
public:
  /// `values` must outlive the reader.
  explicit FieldReader(const FieldValues& values) : values_(values) {}

  /// Throws std::invalid_argument if the next field has another name or no value.
  template <class Field>
  void operator()(std::string_view name, Field& field) {
    if (next_name_ >= values_.name.size() || values_.name[next_name_] != name)
      throw std::invalid_argument("no value for the field " + std::string(name));
    ++next_name_;
    take(field);
  }
  /// Throws std::invalid_argument if values are left over.
  void finish() const {
    if (next_name_ != values_.name.size() || next_number_ != values_.number.size() ||
        next_integer_ != values_.integer.size())
      throw std::invalid_argument("values without a field");
  }

private:
  template <class Field>
  void take(Field& field) {
    if constexpr (std::is_floating_point_v<Field>) {
      if (next_number_ >= values_.number.size()) throw std::invalid_argument("fewer numbers than fields");
      field = values_.number[next_number_++];
    } else {
      if (next_integer_ >= values_.integer.size()) throw std::invalid_argument("fewer whole numbers than fields");
      field = static_cast<Field>(values_.integer[next_integer_++]);
    }
  }
  template <class Field, std::size_t Size>
  void take(std::array<Field, Size>& fields) {
    for (Field& field : fields) take(field);
  }
  const FieldValues& values_;
  std::size_t next_name_ = 0, next_number_ = 0, next_integer_ = 0;
};

} // namespace mpfem
