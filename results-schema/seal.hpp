#pragma once
// The seal of a file: a hash of its structure, after the end of its HDF5 data. HDF5 does not check all of its own
// structure, and crashes on some damage; the seal is checked before the library sees the file.
//
// The values of large datasets are left out, so that opening a file does not require reading all of it; each dataset's
// own checksum covers them. docs/results-schema.md describes the layout of a seal.

#include <cstdint>
#include <string>
#include <vector>

namespace mpfem::schema {

/// A range of bytes in a file.
struct ByteRange {
  std::uint64_t begin = 0, size = 0;
};

/// Appends a seal to a complete file. `left_out` are the ranges that the seal does not cover; they do not overlap.
/// Throws StorageError.
void append_seal(const std::string& path, std::vector<ByteRange> left_out);

/// Whether a file has a seal, and whether the seal matches the file.
enum class Seal { absent, intact, broken };

/// Compares a file with its seal. Throws InputError where the file cannot be read.
Seal check_seal(const std::string& path);

} // namespace mpfem::schema
