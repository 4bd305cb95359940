#pragma once
// A sum without rounding errors: it depends neither on the order of its terms nor on which thread or process adds which
// of them. Sums over grains use it, so that results are the same for any number of threads and processes.

#include <array>
#include <cstddef>
#include <cstdint>

namespace mpfem {

/// A sum of doubles as a fixed-point number of 512 bits. Terms are exact down to 2^-256 (1e-77), below which bits are
/// cut off. At most 2^31 terms.
class ExactSum {
public:
  /// A term above 2^244 (3e73) or not finite makes the sum NaN.
  void add(double term);
  /// The double nearest to the sum; NaN beyond 2^256.
  double value() const;

  /// Two sums are added by adding their words.
  static constexpr std::size_t words = 17;
  std::array<std::int64_t, words>& data() { return word_; }

private:
  /// Sixteen digits of 32 bits, the lowest first, not normalised; at the end the number of terms that do not fit.
  std::array<std::int64_t, words> word_{};
};

} // namespace mpfem
