#pragma once
// Values by name, and texts in which "{name}" stands for one of them.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace mpfem {

/// A number or a text.
struct Value {
  std::string text;             ///< as it is printed; of a number the shortest that reads back to the same number
  std::optional<double> number; ///< where it is one

  static Value of(double number);
  /// A number where the text is one, else a text.
  static Value of_text(std::string text);
  bool operator==(const Value& other) const;
};

using Words = std::map<std::string, Value, std::less<>>;

/// What a name in braces that nobody knows becomes.
enum class Unknown { refused, kept };

/// "{name}" and "{name:FORMAT}" replaced. FORMAT is that of fmt for numbers (".2f", "+.1e"); with a "%" behind it the
/// number is printed in per cent (".2g%": 0.0123 becomes "1.2 %"). Braces without a name are kept ("x^{max}" with
/// Unknown::kept; "{{" and "}}" stand for braces always). Throws InputError: unknown name (with the nearest), format
/// that is none, format of a text.
std::string filled(std::string_view pattern, const Words& words, Unknown unknown = Unknown::refused);

} // namespace mpfem
