// compare-results FILE FILE: whether two result files hold bitwise the same numbers.
//
// Compares every dataset below /history, /snapshots, /mesh, /spheres and /box of both files by name, shape, type and
// bytes. Provenance is left out: it holds dates, versions and times of the computer. Exit code 0: all the same; 1: they
// differ, and the datasets that do are printed; 2: a file cannot be read.

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hdf5.h>

namespace {

/// Contents of a dataset: the description of its type, its shape and its bytes.
struct Contents {
  std::string type;
  std::vector<hsize_t> shape;
  std::vector<char> bytes;
  bool operator==(const Contents&) const = default;
};
using Datasets = std::map<std::string, Contents>;

Contents read_contents(hid_t dataset) {
  Contents contents;
  const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
  contents.type = fmt::format("class {} of {} bytes", static_cast<int>(H5Tget_class(type)), H5Tget_size(type));
  contents.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, contents.shape.data(), nullptr);
  contents.bytes.resize(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  // Strings of variable length are pointers in memory: only their number is compared.
  const bool plain = H5Tget_class(type) != H5T_VLEN && H5Tis_variable_str(type) <= 0;
  if (plain && !contents.bytes.empty()) H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, contents.bytes.data());
  H5Sclose(space);
  H5Tclose(type);
  return contents;
}

herr_t visit(hid_t file, const char* name, const H5L_info_t*, void* data) {
  const std::string path = std::string("/") + name;
  const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  if (H5Iget_type(object) == H5I_DATASET)
    for (const char* compared : {"/history/", "/snapshots/", "/mesh/", "/spheres/", "/box/"})
      if (path.starts_with(compared)) static_cast<Datasets*>(data)->emplace(path, read_contents(object));
  H5Oclose(object);
  return 0;
}

/// Every compared dataset of a file by its path; none where the file cannot be read.
Datasets read_datasets(const char* path) {
  Datasets datasets;
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return datasets;
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &datasets);
  H5Fclose(file);
  return datasets;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: compare-results FILE FILE\n");
    return 2;
  }
  const Datasets first = read_datasets(argv[1]), second = read_datasets(argv[2]);
  for (int i = 1; i < 3; ++i)
    if ((i == 1 ? first : second).empty()) {
      fmt::print(stderr, "compare-results: error: {}: no results in it\n", argv[i]);
      return 2;
    }
  int different = 0;
  const auto report = [&](const std::string& path, const char* how) { ++different, fmt::print("{} {}\n", path, how); };
  for (const auto& [path, contents] : first) {
    const auto other = second.find(path);
    if (other == second.end())
      report(path, "is in the first file only");
    else if (!(contents == other->second))
      report(path, "differs");
  }
  for (const auto& [path, contents] : second)
    if (!first.contains(path)) report(path, "is in the second file only");
  fmt::print("{} of {} datasets differ\n", different, first.size());
  return different > 0 ? 1 : 0;
}
