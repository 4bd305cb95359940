#pragma once
// The schema's description of one dataset. The descriptors themselves are generated from results-schema/schema.toml.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mpfem::schema {

/// Types of the values of a dataset.
enum class ElementType { float64, float32, int32, int64, string };

/// Name of the type as in schema.toml.
constexpr std::string_view type_name(ElementType type) {
  constexpr std::array<std::string_view, 5> names = {"float64", "float32", "int32", "int64", "string"};
  return names[static_cast<std::size_t>(type)];
}

/// One extent of a shape: fixed, or (where `name` is not empty) free and equal wherever the name occurs.
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
  std::string_view indexes;    ///< if not empty: values are indices below this extent
  std::string_view partitions; ///< if not empty: values never fall, from 0 to this extent

  /// True if the path has a '*': there is one dataset for each snapshot or tool.
  constexpr bool of_member() const { return path.find('*') != std::string_view::npos; }
  constexpr bool of_snapshot() const { return path.starts_with("/snapshots/"); }
  /// The part of a path before "/*": "/snapshots", "/history/tools".
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
