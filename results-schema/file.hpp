#pragma once
// Typed writing and reading of the toolkit's HDF5 files. What may be written is what results-schema/schema.toml says.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results-schema/descriptors.hpp"

namespace mpfem::schema {

/// Writes one file: beside its place as PATH.partial, renamed by commit(). Without commit() nothing is left behind and a
/// file that stood at PATH stays as it was. Throws StorageError where the storage fails.
class FileWriter {
public:
  /// `creator`: program and version, a root attribute of the file.
  FileWriter(const std::string& path, FileKind kind, std::string_view creator);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Writes an array with `rows` rows, row by row. `snapshot` takes the place of '*' in the path.
  /// Throws std::logic_error where the values do not fill the shape, or extents of one name differ.
  template <class T, int Rank>
  void write(const Dataset<T, Rank>& dataset, std::span<const T> values, std::size_t rows,
             std::string_view snapshot = {}) {
    static_assert(Rank > 0, "write_scalar writes scalars");
    write_values(dataset, values.data(), values.size(), rows, snapshot);
  }
  template <class T>
  void write_scalar(const Dataset<T, 0>& dataset, const T& value, std::string_view snapshot = {}) {
    write_values(dataset, &value, 1, 1, snapshot);
  }
  /// Closes the file and renames it to its place.
  void commit();

private:
  void write_values(const DatasetDescription& dataset, const void* values, std::size_t count, std::size_t rows,
                    std::string_view snapshot);
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads one file. Every mistake is an InputError that names the file and the dataset.
class FileReader {
public:
  /// Throws InputError where the file is missing, is no HDF5 file, was made by no program of this toolkit, has another
  /// schema version, or is not of this kind.
  FileReader(const std::string& path, FileKind kind);
  /// Any kind.
  explicit FileReader(const std::string& path);
  ~FileReader();
  FileReader(FileReader&&) noexcept;
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  const std::string& path() const;
  FileKind kind() const;
  std::string creator() const;
  bool has(const DatasetDescription& dataset, std::string_view snapshot = {}) const;
  /// All values, row by row. Type and shape are checked against the schema.
  template <class T, int Rank>
  std::vector<T> read(const Dataset<T, Rank>& dataset, std::string_view snapshot = {}) const {
    static_assert(Rank > 0, "read_scalar reads scalars");
    std::vector<T> values(count(dataset, snapshot));
    read_values(dataset, values.data(), snapshot);
    return values;
  }
  template <class T>
  T read_scalar(const Dataset<T, 0>& dataset, std::string_view snapshot = {}) const {
    T value{};
    count(dataset, snapshot);
    read_values(dataset, &value, snapshot);
    return value;
  }
  /// First extent of a dataset.
  std::size_t rows(const DatasetDescription& dataset, std::string_view snapshot = {}) const;
  /// Names of the snapshots, ascending: "0000", "0001", …
  std::vector<std::string> snapshots() const;

private:
  friend std::vector<std::string> validate(const std::string& path);
  std::size_t count(const DatasetDescription& dataset, std::string_view snapshot) const;
  void read_values(const DatasetDescription& dataset, void* values, std::string_view snapshot) const;
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a file to the schema: kind, version, every required dataset, every dataset's type, shape, unit and description,
/// agreement of named extents, ranges of indices, finite numbers, and nothing that the schema does not know. One line a
/// finding; empty for a good file. Throws InputError where the file cannot be read at all.
std::vector<std::string> validate(const std::string& path);

} // namespace mpfem::schema
