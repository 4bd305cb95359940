#pragma once
// Named values, and texts in which "{name}" stands for one of them.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace mpfem {

/// A number or a text.
struct Value {
  std::string text;             ///< as printed; for `of`, the shortest text that reads back to the same number
  std::optional<double> number; ///< empty where it is not a number

  static Value of(double number);
  /// A number if the text is one, otherwise a text.
  static Value of_text(std::string text);
  bool operator==(const Value& other) const;
};

using Words = std::map<std::string, Value, std::less<>>;

/// Treatment of unknown names in braces.
enum class Unknown { refused, kept };

/// Replaces "{name}" and "{name:FORMAT}". FORMAT is fmt's for numbers (".2f", "+.1e"); with a "%" after it the number
/// is printed in per cent (".2g%": 0.0123 becomes "1.2 %"). "g" writes numbers below a million without an exponent. An
/// empty value with a format becomes "not known". "{{" and "}}" stand for braces. With Unknown::kept, unknown names in
/// braces ("x^{max}") and double braces stay as they are. Throws InputError: unknown name (suggests the nearest),
/// invalid format, format of a text, and with Unknown::refused a brace that is not closed.
std::string filled(std::string_view pattern, const Words& words, Unknown unknown = Unknown::refused);

} // namespace mpfem
