#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "results-schema/checksum.hpp"
#include "results-schema/file_reader.hpp"
#include "results-schema/seal.hpp"

namespace mpfem::schema {

namespace {

/// Arrays of snapshots from this many bytes on are compressed: byte shuffle and deflate at its fastest level.
constexpr std::size_t compressed_from = 64 * 1024;
constexpr hsize_t chunk_values = 64 * 1024;
/// The seal leaves out values of datasets from this many bytes on.
constexpr std::size_t left_out_from = 64 * 1024;

/// Where the values of a dataset are in the file. Everything must have been flushed before.
std::vector<ByteRange> places_of_values(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  if (H5Pget_layout(creation) == H5D_CONTIGUOUS) {
    const haddr_t address = H5Dget_offset(set);
    if (address == HADDR_UNDEF) return {};
    return {{address, H5Dget_storage_size(set)}};
  }
  std::array<hsize_t, 2> chunk{}, offset{}; // a chunk has whole rows
  H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
  std::vector<ByteRange> places;
  for (const hsize_t rows = extents_of(set).front(); offset[0] < rows; offset[0] += chunk[0]) {
    haddr_t address = HADDR_UNDEF;
    hsize_t size = 0;
    unsigned filters = 0;
    if (H5Dget_chunk_info_by_coord(set, offset.data(), &filters, &address, &size) >= 0 && address != HADDR_UNDEF)
      places.push_back({address, size});
  }
  return places;
}

using Extents = std::array<hsize_t, 2>;

/// Throws std::logic_error: the program does not call the writer as the schema requires.
[[noreturn]] void misused(const std::string& path, const std::string& what) {
  throw std::logic_error(fmt::format("{}: {}", path, what));
}

/// The extents of `count` values in `rows` rows; 1 beyond the dataset's rank. Throws std::logic_error where the values
/// do not fill them.
Extents extents_for(const DatasetDescription& dataset, const std::string& path, std::size_t count, std::size_t rows) {
  Extents extent{rows, 1};
  if (dataset.rank == 2)
    extent[1] = dataset.extent[1].name.empty() ? dataset.extent[1].fixed : count / std::max<std::size_t>(rows, 1);
  if (extent[0] * extent[1] != count) misused(path, fmt::format("{} values do not fill {}", count, dataset.shape));
  return extent;
}

/// How a dataset is stored: large ones of snapshots in compressed chunks of whole rows.
Handle creation_list(const DatasetDescription& dataset, const Extents& extent, std::size_t bytes) {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (!dataset.of_snapshot() || bytes < compressed_from) return creation;
  const Extents chunk{std::min<hsize_t>(extent[0], std::max<hsize_t>(1, chunk_values / extent[1])), extent[1]};
  H5Pset_chunk(creation, dataset.rank, chunk.data());
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 1);
  return creation;
}

/// Also creates the groups above it.
Handle create_dataset(hid_t file, const DatasetDescription& dataset, const std::string& path, const Extents& extent,
                      std::size_t bytes) {
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  const Handle creation = creation_list(dataset, extent, bytes);
  const Handle space(dataset.rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(dataset.rank, extent.data(), nullptr),
                     H5Sclose);
  return {H5Dcreate2(file, path.c_str(), file_type(dataset.type), space, link, creation, H5P_DEFAULT), H5Dclose};
}

/// Returns a negative number on failure.
herr_t write_elements(hid_t set, ElementType type, const void* values, std::size_t count) {
  const Handle memory = memory_type(type);
  if (type != ElementType::string) return H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  std::vector<const char*> pointers;
  for (std::size_t i = 0; i < count; ++i) pointers.push_back(static_cast<const std::string*>(values)[i].c_str());
  return H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data());
}

} // namespace

/// An array whose values arrive piece by piece.
struct OpenArray {
  Handle set;
  std::string path;
  ElementType type{};
  Extents extent{};
  hsize_t rows_written = 0;
  DatasetChecksum checksum;
};

struct FileWriter::State {
  std::string path, target, partial; ///< as given; after following links; target + ".partial"
  FileKind kind;
  std::string creator;
  Handle file;
  bool complete = false;                        ///< all written and closed: .partial must be kept
  std::map<std::string, std::size_t> extents;   ///< named extents seen so far; for a snapshot's, its name comes first
  std::map<std::string, std::string> checksums; ///< of all datasets so far, by path
  std::vector<std::string> large;               ///< paths of datasets whose values the seal leaves out
  std::optional<OpenArray> open;                ///< begun and not yet complete

  [[noreturn]] void storage_failed(std::string_view what) const {
    throw StorageError(
        fmt::format("{}: {} could not be written (disk full, or the folder is not writable)", path, what));
  }

  void check_call(const DatasetDescription& dataset, const std::string& dataset_path, std::string_view snapshot) const;
  void check_named_extents(const DatasetDescription& dataset, const std::string& dataset_path, const Extents& extent,
                           std::string_view snapshot);
};

/// Throws std::logic_error where this dataset cannot be written now.
void FileWriter::State::check_call(const DatasetDescription& dataset, const std::string& dataset_path,
                                   std::string_view snapshot) const {
  if (!file) misused(dataset_path, "written after commit()");
  if (open) misused(dataset_path, "written before " + open->path + " is complete");
  const auto datasets = kinds[static_cast<std::size_t>(kind)].datasets;
  if (std::none_of(datasets.begin(), datasets.end(), [&](const auto& known) { return known.path == dataset.path; }))
    misused(dataset_path, "not a dataset of this kind of file");
  if (path_exists(file, dataset_path)) misused(dataset_path, "written twice");
  if (dataset.of_member() == snapshot.empty())
    misused(dataset_path, "the name of a snapshot or tool is missing or not allowed");
}

/// Throws std::logic_error unless extents of one name are equal in the whole file (for a snapshot's: in the snapshot).
void FileWriter::State::check_named_extents(const DatasetDescription& dataset, const std::string& dataset_path,
                                            const Extents& extent, std::string_view snapshot) {
  for (int i = 0; i < dataset.rank; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Extent& wanted = dataset.extent[index];
    std::size_t found = extent[index];
    if (wanted.name.empty()) {
      if (found != wanted.fixed) misused(dataset_path, fmt::format("not of the shape {}", dataset.shape));
      continue;
    }
    std::string name(wanted.name);
    if (constexpr std::string_view more = "_plus_1"; name.ends_with(more)) {
      if (found == 0) misused(dataset_path, fmt::format("empty, {} has at least one row", dataset.shape));
      name.resize(name.size() - more.size());
      --found;
    }
    if (name.front() == '*') name = std::string(snapshot) + name;
    if (const auto [known, fresh] = extents.emplace(name, found); !fresh && known->second != found)
      misused(dataset_path, fmt::format("{} is {} here and {} elsewhere", name, found, known->second));
  }
}

FileWriter::FileWriter(const std::string& path, FileKind kind, std::string_view creator)
    : state_(std::make_unique<State>()) {
  refuse_special_file("output", path, OutputKind::binary);
  state_->path = path;
  state_->target = output_target(path);
  state_->partial = state_->target + ".partial";
  state_->kind = kind;
  state_->creator = creator;
  remove_stale_partial(state_->partial);
  prepare_hdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  state_->file = Handle(H5Fcreate(state_->partial.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (!state_->file) state_->storage_failed("the file");
  const std::string kind_name(kinds[static_cast<std::size_t>(kind)].name);
  if (write_text_attribute(state_->file, attribute::schema_version, schema_version) < 0 ||
      write_text_attribute(state_->file, attribute::file_kind, kind_name) < 0 ||
      write_text_attribute(state_->file, attribute::creator, creator) < 0)
    state_->storage_failed("the root attributes");
}

FileWriter::~FileWriter() {
  if (state_->complete) return;
  state_->file.reset();
  std::remove(state_->partial.c_str());
}

void FileWriter::write_values(const DatasetDescription& dataset, const void* values, std::size_t count,
                              std::size_t rows, std::string_view snapshot) {
  const std::string path = path_of(dataset, snapshot);
  state_->check_call(dataset, path, snapshot);
  const Extents extent = extents_for(dataset, path, count, rows);
  state_->check_named_extents(dataset, path, extent, snapshot);
  const std::size_t bytes = count * H5Tget_size(memory_type(dataset.type));
  const Handle set = create_dataset(state_->file, dataset, path, extent, bytes);
  if (!set) state_->storage_failed(path);
  const std::string checksum =
      checksum_of_dataset(dataset, path, dataset.unit, {extent.begin(), extent.begin() + dataset.rank}, values);
  if (write_text_attribute(set, attribute::unit, dataset.unit) < 0 ||
      write_text_attribute(set, attribute::description, dataset.description) < 0 ||
      write_text_attribute(set, attribute::checksum, checksum) < 0)
    state_->storage_failed(path);
  state_->checksums.emplace(path, checksum);
  if (bytes >= left_out_from && dataset.type != ElementType::string) state_->large.push_back(path);
  if (count > 0 && write_elements(set, dataset.type, values, count) < 0) state_->storage_failed(path);
}

void FileWriter::begin_values(const DatasetDescription& dataset, std::size_t count, std::size_t rows,
                              std::string_view snapshot) {
  const std::string path = path_of(dataset, snapshot);
  state_->check_call(dataset, path, snapshot);
  const Extents extent = extents_for(dataset, path, count, rows);
  state_->check_named_extents(dataset, path, extent, snapshot);
  const std::size_t bytes = count * H5Tget_size(memory_type(dataset.type));
  Handle set = create_dataset(state_->file, dataset, path, extent, bytes);
  if (!set) state_->storage_failed(path);
  if (write_text_attribute(set, attribute::unit, dataset.unit) < 0 ||
      write_text_attribute(set, attribute::description, dataset.description) < 0)
    state_->storage_failed(path);
  if (bytes >= left_out_from) state_->large.push_back(path);
  state_->open.emplace(
      OpenArray{std::move(set), path, dataset.type, extent, 0,
                DatasetChecksum(dataset, path, dataset.unit, {extent.begin(), extent.begin() + dataset.rank})});
  if (count == 0) end_values();
}

void FileWriter::append_values(const void* values, std::size_t count, std::size_t size) {
  if (!state_->open) misused(state_->path, "append() without begin()");
  OpenArray& open = *state_->open;
  const Handle memory = memory_type(open.type);
  const hsize_t rows = count / open.extent[1];
  if (H5Tget_size(memory) != size || rows * open.extent[1] != count || open.rows_written + rows > open.extent[0])
    misused(open.path, fmt::format("{} values of {} bytes do not fit the rows still missing", count, size));
  if (count == 0) return;
  open.checksum.update({static_cast<const std::byte*>(values), count * size});
  const Handle place(H5Dget_space(open.set), H5Sclose);
  const Extents first{open.rows_written, 0}, block{rows, open.extent[1]};
  const Handle room(H5Screate_simple(H5Sget_simple_extent_ndims(place), block.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(place, H5S_SELECT_SET, first.data(), nullptr, block.data(), nullptr) < 0 ||
      H5Dwrite(open.set, memory, room, place, H5P_DEFAULT, values) < 0)
    state_->storage_failed(open.path);
  open.rows_written += rows;
  if (open.rows_written == open.extent[0]) end_values();
}

void FileWriter::end_values() {
  const OpenArray& open = *state_->open;
  const std::string checksum = open.checksum.text();
  if (write_text_attribute(open.set, attribute::checksum, checksum) < 0) state_->storage_failed(open.path);
  state_->checksums.emplace(open.path, checksum);
  state_->open.reset();
}

void FileWriter::copy_snapshot(const FileReader& from, std::string_view source, std::string_view target) {
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(state_->kind)].datasets) {
    if (!dataset.of_snapshot() || (!dataset.required && !from.has(dataset, source))) continue;
    with_element(dataset.type, [&](auto element) {
      using T = decltype(element);
      const std::size_t rows = from.rows(dataset, source);
      if constexpr (std::is_arithmetic_v<T>) {
        if (dataset.rank > 0) {
          begin_values(dataset, from.count(dataset, source), rows, target);
          from.read_pieces<T>(dataset, source, [this](std::size_t, std::span<const T> piece) { append(piece); });
          return;
        }
      }
      const auto values = from.read_all<T>(dataset, source);
      write_values(dataset, values.data(), values.size(), rows, target);
    });
  }
}

void FileWriter::commit() {
  if (!state_->file) throw std::logic_error(state_->path + ": commit() called twice");
  if (state_->open) misused(state_->open->path, "not complete at commit()");
  const std::string list = checksum_of_list(kinds[static_cast<std::size_t>(state_->kind)].name, schema_version,
                                            state_->creator, state_->checksums);
  if (write_text_attribute(state_->file, attribute::checksums, list) < 0) state_->storage_failed("the root attributes");
  if (H5Fflush(state_->file, H5F_SCOPE_GLOBAL) < 0) state_->storage_failed("the file");
  std::vector<ByteRange> left_out;
  for (const std::string& path : state_->large) {
    const Handle set(H5Dopen2(state_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
    for (const ByteRange& place : places_of_values(set)) left_out.push_back(place);
  }
  if (!state_->file.reset()) state_->storage_failed("the file");
  append_seal(state_->partial, left_out);
  if (check_seal(state_->partial) != Seal::intact) state_->storage_failed("the file");
  state_->complete = true;
  replace_file(state_->partial, state_->target);
}

} // namespace mpfem::schema
