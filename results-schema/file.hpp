#pragma once
// Typed writing and reading of mpfem's HDF5 files. results-schema/schema.toml defines what may be written.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "results-schema/descriptors.hpp"

namespace mpfem::schema {

class FileReader;

/// Writes one file as PATH.partial, which commit() renames to PATH. Without commit() no new file is left, and an
/// existing PATH stays as it is. If PATH is a symbolic link, its target is written. Every dataset gets a checksum, the
/// file a seal. Throws StorageError where the storage fails, InputError where PATH is a folder or a device.
class FileWriter {
public:
  /// `creator`: program and version, a root attribute of the file.
  FileWriter(const std::string& path, FileKind kind, std::string_view creator);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Writes an array with `rows` rows, row by row. `snapshot`, or the name of a tool, replaces '*' in the path.
  /// Throws std::logic_error where the values do not fill the shape, or extents of one name differ.
  template <class T, int Rank>
  void write(const Dataset<T, Rank>& dataset, std::span<const T> values, std::size_t rows,
             std::string_view snapshot = {}) {
    static_assert(Rank > 0, "write_scalar writes scalars");
    write_values(dataset, values.data(), values.size(), rows, snapshot);
  }
  /// Begins an array with `rows` rows of `columns` values that are written piece by piece: append() until it is
  /// complete, before anything else is written.
  template <class T, int Rank>
  void begin(const Dataset<T, Rank>& dataset, std::size_t rows, std::size_t columns = 1,
             std::string_view snapshot = {}) {
    static_assert(Rank > 0 && std::is_arithmetic_v<T>, "numbers in rows come piece by piece");
    begin_values(dataset, rows * columns, rows, snapshot);
  }
  /// Appends whole rows to the array that begin() has begun.
  template <class T>
  void append(std::span<const T> values) {
    append_values(values.data(), values.size(), sizeof(T));
  }
  template <class T>
  void write_scalar(const Dataset<T, 0>& dataset, const T& value, std::string_view snapshot = {}) {
    write_values(dataset, &value, 1, 1, snapshot);
  }
  /// Copies all datasets of a snapshot from another file of this kind, under another name, piece by piece. Throws
  /// InputError where one of them cannot be read or a required one is missing; this file must be given up then.
  void copy_snapshot(const FileReader& from, std::string_view source, std::string_view target);
  /// Closes the file, waits until it is on disk, and renames it to PATH.
  void commit();

private:
  void write_values(const DatasetDescription& dataset, const void* values, std::size_t count, std::size_t rows,
                    std::string_view snapshot);
  void begin_values(const DatasetDescription& dataset, std::size_t count, std::size_t rows, std::string_view snapshot);
  void append_values(const void* values, std::size_t count, std::size_t size);
  void end_values();
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads one file. Every fault in it throws InputError that names the file and the dataset.
class FileReader {
public:
  /// Throws InputError where the file is missing, is not HDF5, does not match its seal, is not of a kind of the schema,
  /// has another schema version, or is of another kind.
  FileReader(const std::string& path, FileKind kind);
  /// The same for a file of any kind.
  explicit FileReader(const std::string& path);
  ~FileReader();
  FileReader(FileReader&&) noexcept;
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  const std::string& path() const;
  FileKind kind() const;
  std::string creator() const;
  /// Hash of the whole content (root attribute `checksums`); empty for a file without checksums.
  std::string checksums() const;
  bool has(const DatasetDescription& dataset, std::string_view snapshot = {}) const;
  /// All values, row by row. Type and shape are checked against the schema, the values against their checksum.
  template <class T, int Rank>
  std::vector<T> read(const Dataset<T, Rank>& dataset, std::string_view snapshot = {}) const {
    static_assert(Rank > 0, "read_scalar reads scalars");
    return read_all<T>(dataset, snapshot);
  }
  /// All values in pieces of a few megabytes: calls take(first_row, values) with whole rows, one piece after another.
  /// Damage is found only at the end; values taken before must then be discarded.
  template <class T, int Rank, class Take>
  void read_in_pieces(const Dataset<T, Rank>& dataset, Take&& take, std::string_view snapshot = {}) const {
    static_assert(Rank > 0 && std::is_arithmetic_v<T>, "numbers in rows are read in pieces");
    read_pieces<T>(dataset, snapshot, take);
  }
  template <class T>
  T read_scalar(const Dataset<T, 0>& dataset, std::string_view snapshot = {}) const {
    return read_all<T>(dataset, snapshot).front();
  }
  /// First extent of a dataset.
  std::size_t rows(const DatasetDescription& dataset, std::string_view snapshot = {}) const;
  /// Reads all datasets, one at a time, so that damage to any of them throws InputError.
  void verify() const;
  /// Names of the snapshots, ascending: "0000", "0001", …
  std::vector<std::string> snapshots() const;
  /// Names of the rigid tools in the history of a run, ascending; empty where it has no tools.
  std::vector<std::string> tools() const;
  /// Names in the file that replace '*' in the path of a dataset; one empty name for a path without '*'.
  std::vector<std::string> members(const DatasetDescription& dataset) const;

  struct State;

private:
  friend class FileWriter;
  template <class T>
  std::vector<T> read_all(const DatasetDescription& dataset, std::string_view snapshot) const {
    std::vector<T> values(count(dataset, snapshot));
    read_values(dataset, values.data(), snapshot);
    return values;
  }
  template <class T, class Take>
  void read_pieces(const DatasetDescription& dataset, std::string_view snapshot, Take&& take) const {
    std::vector<T> piece;
    read_piecewise(
        dataset, snapshot,
        [&piece](std::size_t values) {
          piece.resize(values);
          return static_cast<void*>(piece.data());
        },
        [&](std::size_t first_row) { take(first_row, std::span<const T>(piece)); });
  }
  std::size_t count(const DatasetDescription& dataset, std::string_view snapshot) const;
  void read_values(const DatasetDescription& dataset, void* values, std::string_view snapshot) const;
  void read_piecewise(const DatasetDescription& dataset, std::string_view snapshot,
                      const std::function<void*(std::size_t)>& room,
                      const std::function<void(std::size_t)>& take) const;
  std::unique_ptr<State> state_;
};

/// Whether a file says of itself that it is of this kind; of any schema version. Nothing else of it is checked but its
/// seal.
bool states_kind(const std::string& path, FileKind kind);

/// Whether a file is there that is not empty and not of this kind. A damaged HDF5 file counts as of this kind.
bool is_other_file(const std::string& path, FileKind kind);

/// Result of validate().
struct Validation {
  std::vector<std::string> findings; ///< one line each; empty for a good file
  std::string kind;                  ///< of the file
  bool checked = false;              ///< true if the file has checksums

  /// True if nothing is wrong.
  bool empty() const { return findings.empty(); }
};

/// Checks a file against the schema: seal and checksums, kind, version, every required dataset, every dataset's type,
/// shape, unit and description, agreement of named extents, ranges of indices, finite numbers, and that it holds no
/// unknown datasets. The file is read in a separate process: a crash or an endless run of the HDF5 library on it is a
/// finding. Throws InputError where the file cannot be read at all.
Validation validate(const std::string& path);

} // namespace mpfem::schema
