#pragma once
// A complete good file of any kind, made from nothing but the schema's descriptors.

#include <map>
#include <string>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem::test {

using namespace schema;

inline const std::vector<std::string> snapshot_names = {"0000", "0001"}, tool_names = {"lower", "upper"};

/// Extents by name: all different, so that a mix-up of two names shows. Names of a snapshot differ from one to the
/// next.
class Extents {
public:
  std::size_t of(std::string name, const std::string& snapshot) {
    std::size_t more = 0;
    if (constexpr std::string_view suffix = "_plus_1"; name.ends_with(suffix)) {
      name.resize(name.size() - suffix.size());
      more = 1;
    }
    if (name.front() == '*') name = snapshot + name;
    return extents_.emplace(name, 3 + extents_.size()).first->second + more;
  }

private:
  std::map<std::string, std::size_t> extents_;
};

/// Values that fill a dataset and obey its restrictions, different from place to place.
struct Values {
  std::size_t rows = 1;
  std::vector<double> numbers;
};

inline Values good_values(const DatasetDescription& dataset, Extents& extents, const std::string& snapshot) {
  Values values;
  std::size_t count = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dataset.rank); ++i) {
    const Extent& extent = dataset.extent[i];
    const std::size_t size = extent.name.empty() ? extent.fixed : extents.of(std::string(extent.name), snapshot);
    if (i == 0) values.rows = size;
    count *= size;
  }
  for (std::size_t i = 0; i < count; ++i) {
    double value = static_cast<double>(i) * 0.5 + static_cast<double>(dataset.path.size());
    if (!dataset.indexes.empty()) value = static_cast<double>(i % extents.of(std::string(dataset.indexes), snapshot));
    if (!dataset.partitions.empty()) {
      // 0, limit, limit, …: rises from 0 to the limit for any number of parts.
      value = i == 0 ? 0 : static_cast<double>(extents.of(std::string(dataset.partitions), snapshot));
    }
    values.numbers.push_back(value);
  }
  return values;
}

template <class T>
void write_as(FileWriter& writer, const DatasetDescription& dataset, const std::vector<T>& values, std::size_t rows,
              const std::string& snapshot) {
  const std::span<const T> all(values);
  switch (dataset.rank) {
  case 0:
    return writer.write_scalar(Dataset<T, 0>{dataset}, values.front(), snapshot);
  case 1:
    return writer.write(Dataset<T, 1>{dataset}, all, rows, snapshot);
  default:
    return writer.write(Dataset<T, 2>{dataset}, all, rows, snapshot);
  }
}

template <class T>
std::vector<T> converted(const std::vector<double>& numbers) {
  std::vector<T> values;
  for (const double number : numbers) {
    if constexpr (std::is_same_v<T, std::string>)
      values.push_back("text " + std::to_string(number));
    else
      values.push_back(static_cast<T>(number));
  }
  return values;
}

inline void write_values(FileWriter& writer, const DatasetDescription& dataset, const Values& values,
                         const std::string& snapshot) {
  switch (dataset.type) {
  case ElementType::float64:
    return write_as(writer, dataset, values.numbers, values.rows, snapshot);
  case ElementType::float32:
    return write_as(writer, dataset, converted<float>(values.numbers), values.rows, snapshot);
  case ElementType::int32:
    return write_as(writer, dataset, converted<std::int32_t>(values.numbers), values.rows, snapshot);
  case ElementType::int64:
    return write_as(writer, dataset, converted<std::int64_t>(values.numbers), values.rows, snapshot);
  case ElementType::string:
    return write_as(writer, dataset, converted<std::string>(values.numbers), values.rows, snapshot);
  }
}

/// The snapshots or tools that a dataset is written for: none but the nameless one outside both.
inline std::vector<std::string> members_of(const DatasetDescription& dataset) {
  if (!dataset.of_member()) return {""};
  return dataset.of_snapshot() ? snapshot_names : tool_names;
}

/// Writes every dataset of the kind, the ones that are not required included where `optional`.
inline void write_complete_file(const std::string& path, FileKind kind, bool optional = true) {
  FileWriter writer(path, kind, "mpfem tests");
  Extents extents;
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(kind)].datasets)
    if (dataset.required || optional)
      for (const std::string& member : members_of(dataset))
        write_values(writer, dataset, good_values(dataset, extents, member), member);
  writer.commit();
}

inline std::vector<FileKind> all_kinds() {
  std::vector<FileKind> all;
  for (std::size_t i = 0; i < std::size(kinds); ++i) all.push_back(static_cast<FileKind>(i));
  return all;
}

} // namespace mpfem::test
