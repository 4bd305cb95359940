#pragma once
// Checksums of datasets and of the list of datasets, shared by writer and reader.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/hash.hpp"
#include "results-schema/descriptors.hpp"

namespace mpfem::schema {

/// Checksum of a dataset's path, type, shape, unit and values; `values` holds as many elements of its type as the
/// extents give.
std::string checksum_of_dataset(const DatasetDescription& dataset, std::string_view path, std::string_view unit,
                                const std::vector<std::size_t>& extents, const void* values);

/// The same for numbers that arrive piece by piece.
class DatasetChecksum {
public:
  DatasetChecksum(const DatasetDescription& dataset, std::string_view path, std::string_view unit,
                  const std::vector<std::size_t>& extents);
  void update(std::span<const std::byte> values) { hash_.update(values); }
  std::string text() const { return hash_text(hash_.value()); }

private:
  StreamingHash hash_;
};

/// Checksum of a file's kind, version and creator and of the checksums of all its datasets, by path.
std::string checksum_of_list(std::string_view kind, std::string_view version, std::string_view creator,
                             const std::map<std::string, std::string>& checksum_of_path);

} // namespace mpfem::schema
