#pragma once
// Changes to files behind the writer's back, through HDF5's C interface.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "results-schema/descriptors.hpp"
#include "results-schema/hdf5_handle.hpp"
#include "results-schema/seal.hpp"

namespace mpfem::test {

using schema::Handle;

/// Takes the seal off, as a program that copies a file's HDF5 content does.
inline void remove_seal(const std::string& path) {
  if (schema::check_seal(path) == schema::Seal::absent) return;
  constexpr std::uintmax_t tail = 40; // number of left-out ranges, length, hash, magic
  std::ifstream file(path, std::ios::binary);
  const std::uintmax_t length = std::filesystem::file_size(path);
  file.seekg(static_cast<std::streamoff>(length - tail));
  std::uint64_t ranges = 0;
  file.read(reinterpret_cast<char*>(&ranges), sizeof ranges);
  std::filesystem::resize_file(path, length - tail - 16 * ranges);
}

/// Makes a file as earlier versions wrote it: without seal and checksums.
inline void remove_checks(const std::string& path) {
  remove_seal(path);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  REQUIRE(file);
  if (H5Aexists(file, schema::attribute::checksums) > 0) H5Adelete(file, schema::attribute::checksums);
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void*) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const Handle set(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
    if (H5Aexists(set, schema::attribute::checksum) > 0) H5Adelete(set, schema::attribute::checksum);
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, visit, nullptr, H5O_INFO_BASIC);
}

/// Opens a file without its checks: changes are not to be noticed by them.
inline Handle open_to_write(const std::string& path) {
  remove_checks(path);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  REQUIRE(file);
  return file;
}

inline void set_text_attribute(hid_t object, const char* name, const std::string& value) {
  if (H5Aexists(object, name) > 0) H5Adelete(object, name);
  REQUIRE(schema::write_text_attribute(object, name, value) >= 0);
}

inline void set_root_attribute(const std::string& path, const char* name, const std::string& value) {
  set_text_attribute(open_to_write(path), name, value);
}

inline void remove_dataset(const std::string& path, const std::string& dataset) {
  REQUIRE(H5Ldelete(open_to_write(path), dataset.c_str(), H5P_DEFAULT) >= 0);
}

/// Puts a dataset of zeros of this type and shape in the place of another, its attributes kept.
inline void replace_dataset(const std::string& path, const std::string& dataset, hid_t type,
                            const std::vector<hsize_t>& extents) {
  const Handle file = open_to_write(path);
  std::string unit, description;
  if (schema::path_exists(file, dataset)) {
    const Handle old(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    unit = schema::read_text_attribute(old, "unit");
    description = schema::read_text_attribute(old, "description");
    H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
  }
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  const Handle space(extents.empty() ? H5Screate(H5S_SCALAR)
                                     : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                     H5Sclose);
  const Handle set(H5Dcreate2(file, dataset.c_str(), type, space, link, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  REQUIRE(set);
  set_text_attribute(set, "unit", unit);
  set_text_attribute(set, "description", description);
}

/// Overwrites one value of a dataset of numbers.
inline void set_value(const std::string& path, const std::string& dataset, std::size_t index, double value) {
  const Handle file = open_to_write(path);
  const Handle set(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  REQUIRE(set);
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  REQUIRE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  values.at(index) = value;
  REQUIRE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
}

} // namespace mpfem::test
