#include "results-schema/file_reader.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "results-schema/checksum.hpp"

namespace mpfem::schema {

std::vector<hsize_t> extents_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> extents(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  if (!extents.empty()) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return extents;
}

bool has_type(hid_t dataset, ElementType type) {
  const Handle stored(H5Dget_type(dataset), H5Tclose);
  const Handle wanted = file_type(type);
  if (type == ElementType::string)
    return H5Tget_class(stored) == H5T_STRING && H5Tis_variable_str(stored) > 0 && H5Tget_cset(stored) == H5T_CSET_UTF8;
  return H5Tequal(stored, wanted) > 0;
}

std::string extents_text(const std::vector<hsize_t>& extents) {
  return extents.empty() ? "scalar" : fmt::format("[{}]", fmt::join(extents, ", "));
}

namespace {

/// Largest number of bytes of values per byte of file: the limit of deflate.
constexpr std::uintmax_t greatest_compression = 1032;

/// Checksums of all datasets in a file, by path; empty where one has none.
std::map<std::string, std::string> stored_checksums(hid_t file) {
  std::map<std::string, std::string> checksums;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const Handle set(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
    (*static_cast<std::map<std::string, std::string>*>(data))[std::string("/") + name] =
        set ? read_text_attribute(set, attribute::checksum) : "";
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &checksums, H5O_INFO_BASIC);
  return checksums;
}

} // namespace

std::string wrong_list(const FileReader::State& state) {
  const std::string found = checksum_of_list(
      read_text_attribute(state.file, attribute::file_kind), read_text_attribute(state.file, attribute::schema_version),
      read_text_attribute(state.file, attribute::creator), stored_checksums(state.file));
  return found == state.checksums ? ""
                                  : "the file is damaged: its list of datasets does not match its checksum (a dataset "
                                    "is lost, added, renamed or changed)";
}

std::unique_ptr<FileReader::State> open_unchecked(const std::string& path) {
  prepare_hdf5();
  auto state = std::make_unique<FileReader::State>();
  state->path = path;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError(fmt::format("{}: no such file", one_line(path)));
  if (!std::filesystem::is_regular_file(path, ignored))
    throw InputError(fmt::format("{}: not a file, allowed: an HDF5 file", one_line(path)));
  state->file_size = std::filesystem::file_size(path, ignored);
  state->file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!state->file)
    throw InputError(fmt::format("{}: not an HDF5 file that can be opened (damaged or not readable)", one_line(path)));

  const std::string kind = read_text_attribute(state->file, attribute::file_kind);
  const std::string version = read_text_attribute(state->file, attribute::schema_version);
  const auto known = std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.name == kind; });
  if (known == std::end(kinds))
    throw InputError(fmt::format("{}: not a file of mpfem, pack-gen or postproc (attribute file_kind is '{}')",
                                 one_line(path), one_line(kind)));
  if (version != schema_version)
    throw InputError(
        fmt::format("{}: found schema version '{}', allowed: {}", one_line(path), one_line(version), schema_version));
  state->kind = static_cast<FileKind>(known - std::begin(kinds));
  state->checksums = read_text_attribute(state->file, attribute::checksums);
  return state;
}

bool states_kind(const std::string& path, FileKind kind) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || check_seal(path) == Seal::broken) return false;
  prepare_hdf5();
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  return file && read_text_attribute(file, attribute::file_kind) == kinds[static_cast<std::size_t>(kind)].name;
}

bool is_other_file(const std::string& path, FileKind kind) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || std::filesystem::file_size(path, ignored) == 0) return false;
  if (!is_hdf5(path)) return true;
  for (const FileKind other : {FileKind::packing, FileKind::run, FileKind::checkpoint})
    if (other != kind && states_kind(path, other)) return true;
  return false;
}

FileReader::FileReader(const std::string& path) {
  std::error_code ignored;
  const bool regular = std::filesystem::is_regular_file(path, ignored);
  const Seal seal = regular ? check_seal(path) : Seal::absent; // before HDF5 sees the file
  if (seal == Seal::broken)
    throw InputError(fmt::format(
        "{}: the file is damaged: its structure does not match its checksum (postproc validate checks each dataset)",
        one_line(path)));
  state_ = open_unchecked(path);
  state_->seal = seal;
  if (seal == Seal::absent && !state_->checksums.empty())
    if (const std::string wrong = wrong_list(*state_); !wrong.empty())
      throw InputError(fmt::format("{}: {}", one_line(path), wrong));
}

FileReader::FileReader(const std::string& path, FileKind kind) : FileReader(path) {
  if (state_->kind != kind)
    throw InputError(fmt::format("{}: a {} file, allowed: a {} file", one_line(path),
                                 kinds[static_cast<std::size_t>(state_->kind)].name,
                                 kinds[static_cast<std::size_t>(kind)].name));
}

FileReader::~FileReader() = default;
FileReader::FileReader(FileReader&&) noexcept = default;

const std::string& FileReader::path() const {
  return state_->path;
}
FileKind FileReader::kind() const {
  return state_->kind;
}
std::string FileReader::creator() const {
  return read_text_attribute(state_->file, attribute::creator);
}
std::string FileReader::checksums() const {
  return state_->checksums;
}

bool FileReader::has(const DatasetDescription& dataset, std::string_view snapshot) const {
  return path_exists(state_->file, path_of(dataset, snapshot));
}

std::size_t FileReader::count(const DatasetDescription& dataset, std::string_view snapshot) const {
  const std::string path = path_of(dataset, snapshot);
  const auto fail = [&](const std::string& found) {
    throw InputError(fmt::format("{}: dataset {} {}", one_line(state_->path), path, found));
  };
  if (!path_exists(state_->file, path)) fail("is missing");
  const Handle set(H5Dopen2(state_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail("is not a dataset");
  if (!has_type(set, dataset.type)) fail(fmt::format("has another element type than {}", type_name(dataset.type)));
  const auto extents = extents_of(set);
  std::size_t values = 1;
  bool good = extents.size() == static_cast<std::size_t>(dataset.rank);
  for (std::size_t i = 0; good && i < extents.size(); ++i) {
    good = !dataset.extent[i].name.empty() || dataset.extent[i].fixed == extents[i];
    values *= extents[i];
  }
  if (!good) fail(fmt::format("has the shape {}, allowed: {}", extents_text(extents), dataset.shape));
  if (const std::string problem = state_->implausible_size(set); !problem.empty()) fail(problem);
  return values;
}

std::string FileReader::State::implausible_size(hid_t set) const {
  const Handle type(H5Dget_type(set), H5Tclose), creation(H5Dget_create_plist(set), H5Pclose);
  const std::uintmax_t compression = H5Pget_nfilters(creation) > 0 ? greatest_compression : 1;
  const auto extents = extents_of(set);
  std::uintmax_t left = file_size * compression / std::max<std::size_t>(H5Tget_size(type), 1); // values that fit
  for (const hsize_t extent : extents) {
    if (extent == 0) return "";
    left /= extent;
  }
  if (left > 0) return "";
  return fmt::format("has the shape {}, more values than a file of {} bytes can hold", extents_text(extents),
                     file_size);
}

std::string FileReader::State::read(const DatasetDescription& dataset, const std::string& path_in_file,
                                    void* values) const {
  const Handle set(H5Dopen2(file, path_in_file.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type = memory_type(dataset.type);
  herr_t status = 0;
  if (dataset.type == ElementType::string) {
    const Handle space(H5Dget_space(set), H5Sclose);
    const auto texts = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    std::vector<char*> pointers(texts, nullptr);
    if (texts > 0) status = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data());
    for (std::size_t i = 0; i < texts && status >= 0; ++i)
      static_cast<std::string*>(values)[i] = pointers[i] ? pointers[i] : "";
    if (texts > 0 && status >= 0) H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  } else {
    status = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  }
  if (status < 0) return "is damaged: it cannot be read";
  const std::string checksum = read_text_attribute(set, attribute::checksum);
  if (checksum.empty()) return checked() ? "is damaged: it has no checksum" : "";
  const auto extents = extents_of(set);
  const std::string found = checksum_of_dataset(dataset, path_in_file, read_text_attribute(set, attribute::unit),
                                                {extents.begin(), extents.end()}, values);
  return found == checksum ? "" : "is damaged: its values do not match its checksum";
}

void FileReader::read_values(const DatasetDescription& dataset, void* values, std::string_view snapshot) const {
  const std::string path = path_of(dataset, snapshot);
  if (const std::string wrong = state_->read(dataset, path, values); !wrong.empty())
    throw InputError(fmt::format("{}: dataset {} {}", one_line(state_->path), path, wrong));
}

void FileReader::read_piecewise(const DatasetDescription& dataset, std::string_view snapshot,
                                const std::function<void*(std::size_t)>& room,
                                const std::function<void(std::size_t)>& take) const {
  constexpr std::size_t piece_bytes = std::size_t{4} << 20;
  const std::string path = path_of(dataset, snapshot);
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{}: dataset {} {}", one_line(state_->path), path, what));
  };
  count(dataset, snapshot); // checks type and shape
  const Handle set(H5Dopen2(state_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type = memory_type(dataset.type), space(H5Dget_space(set), H5Sclose);
  const auto extents = extents_of(set);
  const hsize_t columns = extents.size() > 1 ? extents[1] : 1;
  const std::size_t row_bytes = columns * H5Tget_size(type);
  const hsize_t rows_of_piece = std::max<hsize_t>(1, piece_bytes / std::max<std::size_t>(row_bytes, 1));
  DatasetChecksum found(dataset, path, read_text_attribute(set, attribute::unit), {extents.begin(), extents.end()});
  for (hsize_t first = 0; first < extents[0]; first += rows_of_piece) {
    const hsize_t rows = std::min(rows_of_piece, extents[0] - first);
    const std::array<hsize_t, 2> from{first, 0}, block{rows, columns};
    void* const values = room(rows * columns);
    const Handle memory(H5Screate_simple(dataset.rank, block.data(), nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, block.data(), nullptr) < 0 ||
        H5Dread(set, type, memory, space, H5P_DEFAULT, values) < 0)
      fail("is damaged: it cannot be read");
    found.update({static_cast<const std::byte*>(values), rows * row_bytes});
    take(first);
  }
  const std::string checksum = read_text_attribute(set, attribute::checksum);
  if (checksum.empty() ? state_->checked() : checksum != found.text())
    fail(checksum.empty() ? "is damaged: it has no checksum" : "is damaged: its values do not match its checksum");
}

std::size_t FileReader::rows(const DatasetDescription& dataset, std::string_view snapshot) const {
  count(dataset, snapshot);
  const Handle set(H5Dopen2(state_->file, path_of(dataset, snapshot).c_str(), H5P_DEFAULT), H5Dclose);
  const auto extents = extents_of(set);
  return extents.empty() ? 1 : extents.front();
}

void FileReader::verify() const {
  const auto read_one = [this](const DatasetDescription& dataset, const std::string& snapshot) {
    if (!has(dataset, snapshot)) return;
    with_element(dataset.type, [&](auto element) {
      using T = decltype(element);
      if constexpr (std::is_arithmetic_v<T>)
        if (dataset.rank > 0) return read_pieces<T>(dataset, snapshot, [](std::size_t, std::span<const T>) {});
      read_all<T>(dataset, snapshot);
    });
  };
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(kind())].datasets)
    for (const std::string& member : members(dataset)) read_one(dataset, member);
}

std::vector<std::string> members_in(hid_t file, const std::string& path) {
  std::vector<std::string> names;
  if (!path_exists(file, path)) return names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  const Handle group(H5Gopen2(file, path.c_str(), H5P_DEFAULT), H5Gclose);
  if (group) H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> snapshots_in(hid_t file) {
  std::vector<std::string> names = members_in(file, "/snapshots");
  // Numbers have at least four digits: 10000 comes after 9999.
  std::stable_sort(names.begin(), names.end(),
                   [](const std::string& a, const std::string& b) { return a.size() < b.size(); });
  return names;
}

std::vector<std::string> FileReader::snapshots() const {
  return snapshots_in(state_->file);
}

std::vector<std::string> FileReader::tools() const {
  return members_in(state_->file, "/history/tools");
}

std::vector<std::string> FileReader::members(const DatasetDescription& dataset) const {
  if (!dataset.of_member()) return {""};
  return members_in(state_->file, std::string(dataset.group()));
}

} // namespace mpfem::schema
