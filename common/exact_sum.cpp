#include "common/exact_sum.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace mpfem {

namespace {

constexpr std::size_t digits = ExactSum::words - 1;
constexpr int digit_bits = 32, lowest_exponent = -256;
constexpr std::uint64_t digit_mask = 0xffffffff;

// An IEEE double: 52 bits of the mantissa, 11 of the exponent with its bias, one sign.
constexpr int mantissa_bits = 52, bias = 1023 + mantissa_bits;
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << mantissa_bits, exponent_mask = 0x7ff;
constexpr int first_place_too_high = digit_bits * (static_cast<int>(digits) - 2); // a term spans three digits

/// Brings every digit into 0 … 2^32 - 1; returns the carry beyond the last.
std::int64_t carry(std::array<std::int64_t, digits>& digit) {
  std::int64_t carried = 0;
  for (std::int64_t& d : digit) {
    const std::int64_t sum = d + carried;
    d = sum & static_cast<std::int64_t>(digit_mask);
    carried = sum >> digit_bits;
  }
  return carried;
}

} // namespace

void ExactSum::add(double term) {
  if (term == 0) return;
  const auto bits = std::bit_cast<std::uint64_t>(term);
  // |term| = mantissa 2^(place + lowest_exponent)
  const std::uint64_t mantissa = (bits & (hidden_bit - 1)) | hidden_bit;
  const int place = static_cast<int>((bits >> mantissa_bits) & exponent_mask) - bias - lowest_exponent;
  if (place >= first_place_too_high) {
    ++word_[digits];
    return;
  }
  if (place < -mantissa_bits) return;
  const std::uint64_t kept = place < 0 ? mantissa >> -place : mantissa;
  const int shift = place < 0 ? 0 : place % digit_bits;
  const auto first = static_cast<std::size_t>(place < 0 ? 0 : place / digit_bits);
  const std::uint64_t above = kept >> digit_bits;
  const std::int64_t sign = term < 0 ? -1 : 1;
  word_[first] += sign * static_cast<std::int64_t>((kept << shift) & digit_mask);
  word_[first + 1] += sign * static_cast<std::int64_t>((kept >> (digit_bits - shift)) & digit_mask);
  word_[first + 2] += sign * static_cast<std::int64_t>(above >> (digit_bits - shift));
}

double ExactSum::value() const {
  if (word_[digits] != 0) return std::numeric_limits<double>::quiet_NaN();
  std::array<std::int64_t, digits> digit{};
  for (std::size_t i = 0; i < digits; ++i) digit[i] = word_[i];
  double sign = 1;
  std::int64_t carried = carry(digit);
  if (carried < 0) { // the digits of |sum| instead
    sign = -1;
    for (std::size_t i = 0; i < digits; ++i) digit[i] = -word_[i];
    carried = carry(digit);
  }
  if (carried != 0) return std::numeric_limits<double>::quiet_NaN();
  std::size_t top = digits;
  while (top > 0 && digit[top - 1] == 0) --top;
  if (top == 0) return 0;
  // The 64 highest bits; the last of them stands for all below, so that the conversion to double rounds correctly.
  const auto at = [&](std::size_t below) {
    return below < top ? static_cast<std::uint64_t>(digit[top - 1 - below]) : std::uint64_t{0};
  };
  const std::uint64_t two = at(0) << digit_bits | at(1);
  const int zeros = std::countl_zero(two);
  std::uint64_t high = two << zeros | at(2) >> (digit_bits - zeros);
  bool rest = (at(2) << zeros & digit_mask) != 0;
  for (std::size_t below = 3; below < top && !rest; ++below) rest = at(below) != 0;
  if (rest) high |= 1;
  const int exponent = lowest_exponent + digit_bits * (static_cast<int>(top) - 2) - zeros;
  return sign * std::ldexp(static_cast<double>(high), exponent);
}

} // namespace mpfem
