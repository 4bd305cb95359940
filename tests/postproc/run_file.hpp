#pragma once
// Run files with known numbers: all that the schema requires, and of what it leaves open what a test gives.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem::test {

/// Contents of a run file by dataset path ('*' for all snapshots or tools that have no separate path). What is not
/// given is filled with zeros of the right extent, strings with "text"; optional datasets that are not given are left
/// out.
struct RunContents {
  std::map<std::string, std::size_t> extents;         ///< rows, tets, nodes, grains, profile, *pairs, *bonds
  std::map<std::string, std::vector<double>> numbers; ///< by path
  std::map<std::string, std::vector<std::string>> texts;
  std::vector<std::string> snapshots = {"0000"}, tools = {};
};

/// Writes one dataset of a snapshot or tool (`member`, else empty).
inline void write_dataset(schema::FileWriter& writer, const schema::DatasetDescription& line, const std::string& member,
                          const RunContents& contents) {
  std::string key(line.path);
  if (line.of_member()) {
    std::string own = key;
    own.replace(own.find('*'), 1, member);
    if (contents.numbers.contains(own) || contents.texts.contains(own)) key = own;
  }
  if (!line.required && !contents.numbers.contains(key) && !contents.texts.contains(key)) return;
  std::size_t count = 1, rows = 1;
  for (int i = 0; i < line.rank; ++i) {
    const schema::Extent& extent = line.extent[static_cast<std::size_t>(i)];
    std::string name(extent.name);
    std::size_t value = extent.fixed;
    if (!name.empty()) {
      const bool more = name.ends_with("_plus_1");
      if (more) name.resize(name.size() - 7);
      value = contents.extents.at(name) + (more ? 1 : 0);
    }
    count *= value;
    if (i == 0) rows = value;
  }
  const auto write = [&]<class T>(const std::vector<T>& values) {
    if (line.rank == 0)
      writer.write_scalar(schema::Dataset<T, 0>{line}, values.at(0), member);
    else if (line.rank == 1)
      writer.write(schema::Dataset<T, 1>{line}, std::span<const T>(values), rows, member);
    else
      writer.write(schema::Dataset<T, 2>{line}, std::span<const T>(values), rows, member);
  };
  if (line.type == schema::ElementType::string) {
    write(contents.texts.contains(key) ? contents.texts.at(key) : std::vector<std::string>(count, "text"));
    return;
  }
  const std::vector<double> numbers =
      contents.numbers.contains(key) ? contents.numbers.at(key) : std::vector<double>(count, 0.0);
  switch (line.type) {
  case schema::ElementType::float64:
    return write(numbers);
  case schema::ElementType::float32:
    return write(std::vector<float>(numbers.begin(), numbers.end()));
  case schema::ElementType::int32:
    return write(std::vector<std::int32_t>(numbers.begin(), numbers.end()));
  default:
    return write(std::vector<std::int64_t>(numbers.begin(), numbers.end()));
  }
}

inline void write_run(const std::string& path, const RunContents& contents) {
  schema::FileWriter writer(path, schema::FileKind::run, "mpfem tests");
  for (const schema::DatasetDescription& line : schema::run::all) {
    if (!line.of_member()) write_dataset(writer, line, "", contents);
    for (const std::string& member : line.of_snapshot() ? contents.snapshots : contents.tools)
      if (line.of_member()) write_dataset(writer, line, member, contents);
  }
  writer.commit();
}

} // namespace mpfem::test
