#pragma once
// An open file, as shared by reader and validator.

#include "results-schema/file.hpp"
#include "results-schema/hdf5_handle.hpp"
#include "results-schema/seal.hpp"

namespace mpfem::schema {

/// What FileReader keeps of an open file.
struct FileReader::State {
  std::string path;
  Handle file;
  FileKind kind{};
  Seal seal = Seal::absent;
  std::uintmax_t file_size = 0;
  std::string checksums; ///< root attribute; empty: none

  bool checked() const { return seal != Seal::absent || !checksums.empty(); }
  /// Reads all values of a dataset whose type and shape are correct. Returns what is wrong with it, or "".
  std::string read(const DatasetDescription& dataset, const std::string& path_in_file, void* values) const;
  /// Returns what is wrong with a dataset's extents given the file's size, or "".
  std::string implausible_size(hid_t set) const;
};

/// Opens a file without comparing it with its checksums. Throws InputError as FileReader's constructor does.
std::unique_ptr<FileReader::State> open_unchecked(const std::string& path);
/// Returns what is wrong with the list of datasets given the root attribute `checksums`, or "".
std::string wrong_list(const FileReader::State& state);
/// Names of the links in a group, ascending; empty where there is no such group.
std::vector<std::string> members_in(hid_t file, const std::string& group);
/// Names of the snapshots, by number.
std::vector<std::string> snapshots_in(hid_t file);

/// Calls f(T{}) with the C++ type of an element type.
template <class F>
void with_element(ElementType type, F&& f) {
  switch (type) {
  case ElementType::float64:
    return f(double{});
  case ElementType::float32:
    return f(float{});
  case ElementType::int32:
    return f(std::int32_t{});
  case ElementType::int64:
    return f(std::int64_t{});
  case ElementType::string:
    return f(std::string{});
  }
}

/// Extents of an open dataset.
std::vector<hsize_t> extents_of(hid_t dataset);
/// True if the stored type is the one that the schema requires.
bool has_type(hid_t dataset, ElementType type);
/// "[12, 3]", "scalar".
std::string extents_text(const std::vector<hsize_t>& extents);

} // namespace mpfem::schema
