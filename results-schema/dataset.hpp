#pragma once
// What the schema says of one dataset. The descriptors themselves are generated from results-schema/schema.toml.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mpfem::schema {

enum class ElementType { float64, float32, int32, int64, string };

/// Name of the type as schema.toml writes it.
constexpr std::string_view type_name(ElementType type) {
  constexpr std::array<std::string_view, 5> names = {"float64", "float32", "int32", "int64", "string"};
  return names[static_cast<std::size_t>(type)];
}

/// One extent of a shape: a number, or (where `name` is not empty) free and the same wherever the name stands.
struct Extent {
  std::string_view name;
  std::size_t fixed = 0;
};

/// One line of the schema.
struct DatasetDescription {
  std::string_view path; ///< '*' stands for the name of a snapshot or a tool
  ElementType type;
  int rank; ///< 0, 1 or 2
  std::array<Extent, 2> extent;
  std::string_view unit;
  std::string_view shape; ///< "[nodes, 3]"
  std::string_view description;
  bool required;
  std::string_view indexes;    ///< values are indices below this extent, where not empty
  std::string_view partitions; ///< values never fall from 0 to this extent, where not empty

  /// Whether the path has a '*': there is one dataset for each snapshot or tool.
  constexpr bool of_member() const { return path.find('*') != std::string_view::npos; }
  constexpr bool of_snapshot() const { return path.starts_with("/snapshots/"); }
  /// Of a path with '*' what stands before it: "/snapshots", "/history/tools".
  constexpr std::string_view group() const { return path.substr(0, path.find("/*")); }
};

/// A dataset with its element type (double, float, std::int32_t, std::int64_t, std::string) and its rank.
template <class T, int Rank>
struct Dataset : DatasetDescription {};

/// All datasets of one kind of file.
struct KindDescription {
  std::string_view name;
  std::string_view description;
  std::span<const DatasetDescription> datasets;
};

} // namespace mpfem::schema
