// XXH64 against published values: those of xxHash's own self test (xsum_sanity_check.c of the reference
// implementation) and of the texts that its bindings publish.

#include <algorithm>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "common/hash.hpp"

using namespace mpfem;

namespace {

constexpr std::uint64_t prime_32 = 2654435761U;

/// The self test's buffer: top bytes of powers of a prime.
std::vector<std::byte> sanity_buffer(std::size_t size) {
  std::vector<std::byte> bytes;
  std::uint64_t generator = prime_32;
  for (std::size_t i = 0; i < size; ++i, generator *= 11400714785074694797ULL)
    bytes.push_back(static_cast<std::byte>(generator >> 56));
  return bytes;
}

} // namespace

TEST_CASE("XXH64 gives the values of the reference implementation's self test") {
  struct Vector {
    std::size_t size;
    std::uint64_t seed, hash;
  };
  // Sizes below, at and above the stripes of 32 bytes, with tails of every kind.
  const auto [size, seed, hash] =
      GENERATE(Vector{0, 0, 0xEF46DB3751D8E999ULL}, Vector{0, prime_32, 0xAC75FDA2929B17EFULL},
               Vector{1, 0, 0xE934A84ADB052768ULL}, Vector{1, prime_32, 0x5014607643A9B4C3ULL},
               Vector{4, 0, 0x9136A0DCA57457EEULL}, Vector{14, 0, 0x8282DCC4994E35C8ULL},
               Vector{14, prime_32, 0xC3BD6BF63DEB6DF0ULL}, Vector{222, 0, 0xB641AE8CB691C174ULL},
               Vector{222, prime_32, 0x20CB8AB7AE10C14AULL});
  CAPTURE(size, seed);
  CHECK(hash_bytes(sanity_buffer(size), seed) == hash);
}

TEST_CASE("XXH64 of known texts has the published values and is printed as sixteen digits") {
  CHECK(hash_text(hash_string("")) == "ef46db3751d8e999");
  CHECK(hash_text(hash_string("a")) == "d24ec4f1a98c6e5b");
  CHECK(hash_text(hash_string("abc")) == "44bc2cf5ad770999");
  CHECK(hash_text(hash_string("xxhash")) == "32dd38952c4bc720");
  CHECK(hash_text(hash_string("xxhash", 20141025)) == "b559b98d844e0635");
  CHECK(hash_text(hash_string("Nobody inspects the spammish repetition")) == "fbcea83c8a378bf1");
  CHECK(hash_text(0x2a) == "000000000000002a");
}

TEST_CASE("A hash does not depend on the alignment of its bytes") {
  const std::vector<std::byte> bytes = sanity_buffer(101);
  for (std::size_t shift = 0; shift < 9; ++shift) {
    std::vector<std::byte> shifted(shift);
    shifted.insert(shifted.end(), bytes.begin(), bytes.end());
    CHECK(hash_bytes(std::span(shifted).subspan(shift)) == hash_bytes(bytes));
  }
}

TEST_CASE("The hash of numbers sees a change of any bit, the sign of zero and the order of a chain") {
  const std::vector<double> first = {0.0, 1.0, 2.0}, second = {3.0};
  const std::vector<double> negative_zero = {-0.0, 1.0, 2.0};
  const auto hash = [](const std::vector<double>& values, std::uint64_t seed) {
    return hash_values(std::span<const double>(values), seed);
  };
  CHECK(hash(first, hash_seed) != hash(negative_zero, hash_seed));
  CHECK(hash(second, hash(first, hash_seed)) != hash(first, hash(second, hash_seed)));
  CHECK(hash({2.0}, hash({0.0, 1.0}, hash_seed)) != hash({1.0, 2.0}, hash({0.0}, hash_seed)));

  const std::vector<std::byte> bytes = sanity_buffer(70);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::vector<std::byte> flipped = bytes;
    flipped[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    CHECK(hash_bytes(flipped) != hash_bytes(bytes));
  }
}

TEST_CASE("The hash of bytes added in pieces equals the hash of all of them, however they are divided") {
  const std::uint64_t seed = GENERATE(std::uint64_t{0}, std::uint64_t{prime_32});
  std::mt19937 random(3);
  for (const std::size_t size : {0U, 1U, 31U, 32U, 33U, 64U, 100U, 1000U}) {
    const std::vector<std::byte> bytes = sanity_buffer(size);
    for (int repeat = 0; repeat < 50; ++repeat) {
      StreamingHash hash(seed);
      // Pieces about as long as a stripe, empty ones among them; now and then longer than several.
      for (std::span<const std::byte> rest(bytes); !rest.empty();) {
        const std::size_t piece = std::min<std::size_t>(rest.size(), random() % (repeat % 2 == 0 ? 40 : 200));
        hash.update(rest.first(piece));
        rest = rest.subspan(piece);
      }
      REQUIRE(hash.value() == hash_bytes(bytes, seed));
      REQUIRE(hash.value() == hash_bytes(bytes, seed)); // asking does not change it
    }
  }
}
