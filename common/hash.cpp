#include "common/hash.hpp"

#include <bit>
#include <cstring>

#include <fmt/format.h>

namespace mpfem {

namespace {

static_assert(std::endian::native == std::endian::little, "XXH64 reads its input as little-endian words");

constexpr std::uint64_t prime_1 = 0x9E3779B185EBCA87ULL;
constexpr std::uint64_t prime_2 = 0xC2B2AE3D27D4EB4FULL;
constexpr std::uint64_t prime_3 = 0x165667B19E3779F9ULL;
constexpr std::uint64_t prime_4 = 0x85EBCA77C2B2AE63ULL;
constexpr std::uint64_t prime_5 = 0x27D4EB2F165667C5ULL;

template <class Word>
std::uint64_t read_word(const std::byte* at) {
  Word word;
  std::memcpy(&word, at, sizeof word);
  return word;
}

std::uint64_t stir(std::uint64_t accumulator, std::uint64_t lane) {
  return std::rotl(accumulator + lane * prime_2, 31) * prime_1;
}

std::uint64_t merge(std::uint64_t hash, std::uint64_t accumulator) {
  return (hash ^ stir(0, accumulator)) * prime_1 + prime_4;
}

std::uint64_t avalanche(std::uint64_t hash) {
  hash = (hash ^ (hash >> 33)) * prime_2;
  hash = (hash ^ (hash >> 29)) * prime_3;
  return hash ^ (hash >> 32);
}

} // namespace

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed) {
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();

  // 1. Stripes of four words, one accumulator each.
  std::uint64_t hash = seed + prime_5;
  if (left >= 32) {
    std::uint64_t a = seed + prime_1 + prime_2;
    std::uint64_t b = seed + prime_2;
    std::uint64_t c = seed;
    std::uint64_t d = seed - prime_1;
    for (; left >= 32; left -= 32, at += 32) {
      a = stir(a, read_word<std::uint64_t>(at));
      b = stir(b, read_word<std::uint64_t>(at + 8));
      c = stir(c, read_word<std::uint64_t>(at + 16));
      d = stir(d, read_word<std::uint64_t>(at + 24));
    }
    hash = std::rotl(a, 1) + std::rotl(b, 7) + std::rotl(c, 12) + std::rotl(d, 18);
    hash = merge(merge(merge(merge(hash, a), b), c), d);
  }
  hash += bytes.size();

  // 2. The rest, by words, a half word and bytes.
  for (; left >= 8; left -= 8, at += 8)
    hash = std::rotl(hash ^ stir(0, read_word<std::uint64_t>(at)), 27) * prime_1 + prime_4;
  if (left >= 4) {
    hash = std::rotl(hash ^ (read_word<std::uint32_t>(at) * prime_1), 23) * prime_2 + prime_3;
    left -= 4;
    at += 4;
  }
  for (; left > 0; --left, ++at) hash = std::rotl(hash ^ (read_word<std::uint8_t>(at) * prime_5), 11) * prime_1;

  return avalanche(hash);
}

std::uint64_t hash_string(std::string_view text, std::uint64_t seed) {
  return hash_bytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

} // namespace mpfem
