#pragma once
// What reader and validator share of an open file.

#include "results-schema/file.hpp"
#include "results-schema/hdf5_handle.hpp"

namespace mpfem::schema {

struct FileReader::State {
  std::string path;
  Handle file;
  FileKind kind{};
};

/// Extents of an open dataset.
std::vector<hsize_t> extents_of(hid_t dataset);
/// True when the stored type has the class and size that the schema wants.
bool has_type(hid_t dataset, ElementType type);
/// "[12, 3]", "scalar".
std::string extents_text(const std::vector<hsize_t>& extents);

} // namespace mpfem::schema
