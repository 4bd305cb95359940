#pragma once
// Everything that a reader gets from a file, to be compared.

#include <map>
#include <sstream>
#include <string>

#include "results-schema/file_reader.hpp"

namespace mpfem::test {

/// Bytes of all values that the schema knows, by path. Throws what the reader throws.
inline std::map<std::string, std::string> content_of(const std::string& path) {
  const schema::FileReader file(path);
  std::map<std::string, std::string> content;
  const auto add = [&](const schema::DatasetDescription& dataset, const std::string& snapshot) {
    if (!file.has(dataset, snapshot)) return;
    std::string& bytes = content[schema::path_of(dataset, snapshot)];
    schema::with_element(dataset.type, [&](auto element) {
      using T = decltype(element);
      std::vector<T> values;
      if (dataset.rank == 0)
        values.push_back(file.read_scalar(schema::Dataset<T, 0>{dataset}, snapshot));
      else
        values = file.read(schema::Dataset<T, 1>{dataset}, snapshot);
      for (const T& value : values)
        if constexpr (std::is_same_v<T, std::string>)
          bytes += value + '\0';
        else
          bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    });
  };
  for (const auto& dataset : schema::kinds[static_cast<std::size_t>(file.kind())].datasets)
    for (const std::string& member : file.members(dataset)) add(dataset, member);
  return content;
}

} // namespace mpfem::test
