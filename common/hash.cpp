#include "common/hash.hpp"

#include <algorithm>
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

StreamingHash::StreamingHash(std::uint64_t seed)
    : seed_(seed), lane_{seed + prime_1 + prime_2, seed + prime_2, seed, seed - prime_1} {}

/// A stripe: four words, one accumulator each.
void StreamingHash::take_stripe(const std::byte* at) {
  for (std::size_t i = 0; i < 4; ++i) lane_[i] = stir(lane_[i], read_word<std::uint64_t>(at + 8 * i));
}

void StreamingHash::update(std::span<const std::byte> bytes) {
  size_ += bytes.size();
  if (left_ > 0) { // the stripe that was begun comes first
    const std::size_t taken = std::min(rest_.size() - left_, bytes.size());
    std::copy_n(bytes.begin(), taken, rest_.begin() + static_cast<std::ptrdiff_t>(left_));
    bytes = bytes.subspan(taken);
    left_ += taken;
    if (left_ < rest_.size()) return;
    take_stripe(rest_.data());
    left_ = 0;
  }
  for (; bytes.size() >= 32; bytes = bytes.subspan(32)) take_stripe(bytes.data());
  std::copy(bytes.begin(), bytes.end(), rest_.begin());
  left_ = bytes.size();
}

std::uint64_t StreamingHash::value() const {
  std::uint64_t hash = seed_ + prime_5;
  if (size_ >= 32) {
    hash = std::rotl(lane_[0], 1) + std::rotl(lane_[1], 7) + std::rotl(lane_[2], 12) + std::rotl(lane_[3], 18);
    for (const std::uint64_t accumulator : lane_) hash = merge(hash, accumulator);
  }
  hash += size_;

  // The rest, by words, a half word and bytes.
  const std::byte* at = rest_.data();
  std::size_t left = left_;
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

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed) {
  StreamingHash hash(seed);
  hash.update(bytes);
  return hash.value();
}

std::uint64_t hash_string(std::string_view text, std::uint64_t seed) {
  return hash_bytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

} // namespace mpfem
