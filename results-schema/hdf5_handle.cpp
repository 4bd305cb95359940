#include "results-schema/hdf5_handle.hpp"

#include <vector>

namespace mpfem::schema {

void prepare_hdf5() {
  // The library keeps a file that could not be closed (disk full). Its cleanup at the end of the program then crashes,
  // and the exit code is lost. All handles close themselves, so no cleanup is needed.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

namespace {

Handle string_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

} // namespace

Handle memory_type(ElementType type) {
  switch (type) {
  case ElementType::float64:
    return {H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose};
  case ElementType::float32:
    return {H5Tcopy(H5T_NATIVE_FLOAT), H5Tclose};
  case ElementType::int32:
    return {H5Tcopy(H5T_NATIVE_INT32), H5Tclose};
  case ElementType::int64:
    return {H5Tcopy(H5T_NATIVE_INT64), H5Tclose};
  case ElementType::string:
    return string_type();
  }
  return {};
}

Handle file_type(ElementType type) {
  switch (type) {
  case ElementType::float64:
    return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
  case ElementType::float32:
    return {H5Tcopy(H5T_IEEE_F32LE), H5Tclose};
  case ElementType::int32:
    return {H5Tcopy(H5T_STD_I32LE), H5Tclose};
  case ElementType::int64:
    return {H5Tcopy(H5T_STD_I64LE), H5Tclose};
  case ElementType::string:
    return string_type();
  }
  return {};
}

std::string path_of(const DatasetDescription& dataset, std::string_view snapshot) {
  std::string path(dataset.path);
  if (const std::size_t star = path.find('*'); star != std::string::npos) path.replace(star, 1, snapshot);
  return path;
}

bool path_exists(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (H5Lexists(file, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

std::string read_text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle stored(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(stored) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return {};
  if (H5Tis_variable_str(stored) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, string_type(), &text) < 0 || !text) return {};
    std::string result(text);
    H5free_memory(text);
    return result;
  }
  constexpr std::size_t longest = 1 << 20;
  if (H5Tget_size(stored) > longest) return {};
  std::vector<char> text(H5Tget_size(stored) + 1, '\0');
  if (H5Aread(attribute, stored, text.data()) < 0) return {};
  return text.data();
}

herr_t write_text_attribute(hid_t object, const char* name, std::string_view value) {
  const Handle type = string_type();
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute) return -1;
  const std::string text(value);
  const char* pointer = text.c_str();
  return H5Awrite(attribute, type, &pointer);
}

} // namespace mpfem::schema
