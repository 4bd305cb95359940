#pragma once
// XXH64, a fast non-cryptographic hash (Yann Collet, "xxHash fast digest algorithm", specification v0.1.1): it
// recognises inputs and finds damaged files. It protects against accidents, not against intent.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace mpfem {

/// Where a chain of hashes begins.
inline constexpr std::uint64_t hash_seed = 0;

/// XXH64 of the bytes with the given seed. Chain arrays by passing the hash of the one before as the seed:
/// hash_bytes(b, hash_bytes(a)). Both the order of the arrays and the boundaries between them matter.
std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = hash_seed);

/// The same of bytes that come piece by piece: update(a), update(b), value() is hash_bytes of a and b joined.
class StreamingHash {
public:
  explicit StreamingHash(std::uint64_t seed = hash_seed);
  void update(std::span<const std::byte> bytes);
  std::uint64_t value() const;

private:
  void take_stripe(const std::byte* at);
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> lane_;
  std::array<std::byte, 32> rest_{}; ///< the last stripe, not yet complete
  std::size_t left_ = 0, size_ = 0;
};

/// The same of the memory of numbers (this machine's byte order; -0.0 differs from 0.0).
template <class Number>
requires std::is_arithmetic_v<Number> std::uint64_t hash_values(std::span<const Number> values,
                                                                std::uint64_t seed = hash_seed) {
  return hash_bytes(std::as_bytes(values), seed);
}

/// The same of the characters of a text.
std::uint64_t hash_string(std::string_view text, std::uint64_t seed = hash_seed);

/// Sixteen hexadecimal digits, most significant first (the canonical form of XXH64).
std::string hash_text(std::uint64_t hash);

} // namespace mpfem
