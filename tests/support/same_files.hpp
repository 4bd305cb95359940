#pragma once
// Whether two run files or checkpoints hold the same numbers to the bit, but for wall-clock times, what is made of them
// (checksums), and the numbers of ranks and threads.

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "solver/output/profile_parts.hpp"

namespace mpfem::test {

namespace same_files {

/// Wall-clock times stand at the end of /run/numbers (RunRecord::for_each_field).
inline bool is_wall_time(std::size_t i, std::size_t count) {
  return i + 1 + profile_parts >= count;
}

inline bool may_differ(std::string_view path) {
  for (const std::string_view name : {"/provenance/wall_time", "/provenance/profile_seconds", "/provenance/threads",
                                      "/provenance/ranks", "/provenance/from", "/run/from"})
    if (path.find(name) != std::string_view::npos) return true;
  return false;
}

template <class T>
bool same_values(const schema::FileReader& a, const schema::FileReader& b, const schema::DatasetDescription& what,
                 const std::string& snapshot) {
  const auto of = [&](const schema::FileReader& file) {
    if (what.rank == 0) {
      schema::Dataset<T, 0> dataset;
      static_cast<schema::DatasetDescription&>(dataset) = what;
      return std::vector<T>{file.read_scalar(dataset, snapshot)};
    }
    schema::Dataset<T, 1> dataset;
    static_cast<schema::DatasetDescription&>(dataset) = what;
    return file.read(dataset, snapshot);
  };
  auto left = of(a), right = of(b);
  if (left.size() != right.size()) return false;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (what.path == "/run/numbers" && is_wall_time(i, left.size())) continue;
    if constexpr (std::is_arithmetic_v<T>) {
      if (std::memcmp(&left[i], &right[i], sizeof(T)) != 0) return false;
    } else if (left[i] != right[i]) {
      return false;
    }
  }
  return true;
}

inline bool same(const schema::FileReader& a, const schema::FileReader& b, const schema::DatasetDescription& what,
                 const std::string& snapshot) {
  if (a.has(what, snapshot) != b.has(what, snapshot)) return false;
  if (!a.has(what, snapshot)) return true;
  switch (what.type) {
  case schema::ElementType::float64:
    return same_values<double>(a, b, what, snapshot);
  case schema::ElementType::float32:
    return same_values<float>(a, b, what, snapshot);
  case schema::ElementType::int32:
    return same_values<std::int32_t>(a, b, what, snapshot);
  case schema::ElementType::int64:
    return same_values<std::int64_t>(a, b, what, snapshot);
  case schema::ElementType::string:
    return same_values<std::string>(a, b, what, snapshot);
  }
  return false;
}

} // namespace same_files

/// In words, the first thing in which two files of one kind differ; empty if they are the same.
inline std::string first_difference(const std::string& path, const std::string& other) {
  const schema::FileReader a(path), b(other);
  if (a.kind() != b.kind() || a.snapshots() != b.snapshots() || a.tools() != b.tools())
    return fmt::format("{} and {} differ in kind, snapshots or tools", path, other);
  for (const schema::DatasetDescription& what : schema::kinds[static_cast<std::size_t>(a.kind())].datasets) {
    if (same_files::may_differ(what.path)) continue;
    for (const std::string& member : a.members(what))
      if (!same_files::same(a, b, what, member))
        return fmt::format("{} and {} differ in {} {}", path, other, what.path, member);
  }
  return {};
}

} // namespace mpfem::test
