#include "results-schema/seal.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"

namespace mpfem::schema {

namespace {

constexpr std::string_view magic = "mpfem file seal\n";
constexpr std::size_t piece = 1 << 20; // bytes
/// After the ranges: their number, the file's length, the hash, and the magic.
constexpr std::size_t tail_size = 3 * sizeof(std::uint64_t) + magic.size();

/// The part of a seal that its hash covers: ranges as (begin, size), their number, the file's length.
std::vector<std::uint64_t> numbers_of(const std::vector<ByteRange>& left_out, std::uint64_t file_length) {
  std::vector<std::uint64_t> numbers;
  for (const ByteRange& range : left_out) numbers.insert(numbers.end(), {range.begin, range.size});
  numbers.insert(numbers.end(), {left_out.size(), file_length});
  return numbers;
}

/// Hash of the bytes [begin, end), chained to `hash`; empty where they cannot be read.
std::optional<std::uint64_t> hash_range(std::ifstream& file, std::uint64_t begin, std::uint64_t end,
                                        std::uint64_t hash) {
  std::vector<char> buffer(std::min<std::uint64_t>(piece, end - begin));
  file.seekg(static_cast<std::streamoff>(begin));
  while (begin < end) {
    const auto count = std::min<std::uint64_t>(piece, end - begin);
    if (!file.read(buffer.data(), static_cast<std::streamsize>(count))) return {};
    hash = hash_bytes(std::as_bytes(std::span(buffer.data(), count)), hash);
    begin += count;
  }
  return hash;
}

/// Hash of a file's first `end` bytes without those left out (ascending), and of the seal's numbers.
std::optional<std::uint64_t> hash_structure(std::ifstream& file, const std::vector<ByteRange>& left_out,
                                            std::uint64_t end, std::span<const std::uint64_t> numbers) {
  std::optional<std::uint64_t> hash = hash_seed;
  std::uint64_t at = 0;
  for (const ByteRange& range : left_out) {
    if (hash) hash = hash_range(file, at, range.begin, *hash);
    at = range.begin + range.size;
  }
  if (hash) hash = hash_range(file, at, end, *hash);
  if (hash) hash = hash_values(numbers, *hash);
  return hash;
}

bool ascend_within(const std::vector<ByteRange>& ranges, std::uint64_t end) {
  std::uint64_t at = 0;
  for (const ByteRange& range : ranges) {
    if (range.begin < at || range.begin > end || range.size > end - range.begin) return false;
    at = range.begin + range.size;
  }
  return true;
}

std::uint64_t length_of(std::ifstream& file) {
  file.seekg(0, std::ios::end);
  return static_cast<std::uint64_t>(file.tellg());
}

} // namespace

void append_seal(const std::string& path, std::vector<ByteRange> left_out) {
  const auto failed = [&path] {
    return StorageError(fmt::format("{}: the file's seal could not be written (disk full?)", one_line(path)));
  };
  std::sort(left_out.begin(), left_out.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::ifstream written(path, std::ios::binary);
  const std::uint64_t end = length_of(written);
  const auto numbers = numbers_of(left_out, end + left_out.size() * sizeof(ByteRange) + tail_size);
  const auto hash = hash_structure(written, left_out, end, numbers);
  if (!hash || !ascend_within(left_out, end)) throw failed();
  written.close();

  std::ofstream file(path, std::ios::binary | std::ios::app);
  const auto append = [&file](const void* bytes, std::size_t size) {
    file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  };
  append(numbers.data(), numbers.size() * sizeof(std::uint64_t));
  append(&*hash, sizeof *hash);
  append(magic.data(), magic.size());
  file.close();
  if (!file) throw failed();
}

Seal check_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be read (no permission?)", one_line(path)));
  const std::uint64_t length = length_of(file);
  if (length < tail_size) return Seal::absent;
  std::array<char, tail_size> tail{};
  file.seekg(static_cast<std::streamoff>(length - tail_size));
  if (!file.read(tail.data(), tail.size())) return Seal::broken;
  if (std::string_view(tail.data() + tail_size - magic.size(), magic.size()) != magic) return Seal::absent;

  std::array<std::uint64_t, 3> last{}; // number of ranges, length of the file, hash
  std::memcpy(last.data(), tail.data(), sizeof last);
  const auto [count, sealed_length, sealed_hash] = last;
  if (sealed_length != length || count > (length - tail_size) / sizeof(ByteRange)) return Seal::broken;
  std::vector<ByteRange> left_out(count);
  const std::uint64_t end = length - tail_size - count * sizeof(ByteRange);
  file.seekg(static_cast<std::streamoff>(end));
  if (!file.read(reinterpret_cast<char*>(left_out.data()), // NOLINT: two 64-bit numbers, as they stand in the file
                 static_cast<std::streamsize>(count * sizeof(ByteRange))) &&
      count > 0)
    return Seal::broken;
  if (!ascend_within(left_out, end)) return Seal::broken;
  const auto hash = hash_structure(file, left_out, end, numbers_of(left_out, length));
  return hash && *hash == sealed_hash ? Seal::intact : Seal::broken;
}

} // namespace mpfem::schema
