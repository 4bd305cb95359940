#include "results-schema/checksum.hpp"

#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpfem::schema {

namespace {

std::size_t size_of(ElementType type) {
  switch (type) {
  case ElementType::float64:
  case ElementType::int64:
    return 8;
  case ElementType::float32:
  case ElementType::int32:
    return 4;
  case ElementType::string:
    return 0;
  }
  return 0;
}

/// Start value for the hash of a dataset's values.
std::uint64_t hash_of_description(const DatasetDescription& dataset, std::string_view path, std::string_view unit,
                                  const std::vector<std::size_t>& extents) {
  return hash_string(fmt::format("{}|{}|{}|{}", path, type_name(dataset.type), fmt::join(extents, ","), unit));
}

} // namespace

DatasetChecksum::DatasetChecksum(const DatasetDescription& dataset, std::string_view path, std::string_view unit,
                                 const std::vector<std::size_t>& extents)
    : hash_(hash_of_description(dataset, path, unit, extents)) {}

std::string checksum_of_dataset(const DatasetDescription& dataset, std::string_view path, std::string_view unit,
                                const std::vector<std::size_t>& extents, const void* values) {
  std::uint64_t hash = hash_of_description(dataset, path, unit, extents);
  std::size_t count = 1;
  for (const auto extent : extents) count *= extent;
  if (dataset.type == ElementType::string)
    for (const std::string& text : std::span(static_cast<const std::string*>(values), count))
      hash = hash_string(text.c_str(), hash); // HDF5 stores a text up to its first zero
  else
    hash = hash_bytes({static_cast<const std::byte*>(values), count * size_of(dataset.type)}, hash);
  return hash_text(hash);
}

std::string checksum_of_list(std::string_view kind, std::string_view version, std::string_view creator,
                             const std::map<std::string, std::string>& checksum_of_path) {
  std::uint64_t hash = hash_string(fmt::format("{}|{}|{}", kind, version, creator));
  for (const auto& [path, checksum] : checksum_of_path) hash = hash_string(path + "|" + checksum, hash);
  return hash_text(hash);
}

} // namespace mpfem::schema
