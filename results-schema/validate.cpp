#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "common/one_line.hpp"
#include "results-schema/file_reader.hpp"

namespace mpfem::schema {

namespace {

/// Findings of one file, and the extents met so far with the place where each was met first.
class Validation {
public:
  explicit Validation(hid_t file) : file_(file) {}

  void check(const DatasetDescription& dataset, const std::string& snapshot) {
    const std::string path = path_of(dataset, snapshot);
    if (!path_exists(file_, path)) {
      if (dataset.required) finding(path, "is missing");
      return;
    }
    known_.insert(path);
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) return finding(path, "is not a dataset");
    for (const auto& [name, wanted] : {std::pair{"unit", dataset.unit}, std::pair{"description", dataset.description}})
      if (const std::string found = read_text_attribute(set, name); found != wanted)
        finding(path, fmt::format("attribute {} is '{}', expected '{}'", name, found, wanted));
    if (!has_type(set, dataset.type)) return finding(path, fmt::format("is not of type {}", type_name(dataset.type)));
    const auto extents = extents_of(set);
    if (extents.size() != static_cast<std::size_t>(dataset.rank))
      return finding(path, fmt::format("has the shape {}, expected {}", extents_text(extents), dataset.shape));
    for (std::size_t i = 0; i < extents.size(); ++i) check_extent(dataset, path, snapshot, i, extents[i]);
    if (dataset.type == ElementType::float64 || dataset.type == ElementType::float32) check_finite(set, path);
    if (!dataset.indexes.empty() || !dataset.partitions.empty()) integers_.push_back({&dataset, path});
  }

  /// Ranges of indices, once all extents are known.
  void check_integers() {
    for (const auto& [dataset, path] : integers_) {
      const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
      std::size_t count = 1;
      for (const hsize_t extent : extents_of(set)) count *= extent;
      std::vector<std::int64_t> values(count);
      if (count == 0) continue;
      if (H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
        finding(path, "cannot be read");
        continue;
      }
      const std::string name(dataset->indexes.empty() ? dataset->partitions : dataset->indexes);
      const auto extent = extents_.find(name);
      if (extent == extents_.end()) continue;
      const auto limit = static_cast<std::int64_t>(extent->second.first);
      if (!dataset->indexes.empty()) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        if (*least < 0 || *most >= limit)
          finding(path, fmt::format("holds the index {}, allowed 0 … {}", *least < 0 ? *least : *most, limit - 1));
      } else if (values.front() != 0 || values.back() != limit || !std::is_sorted(values.begin(), values.end())) {
        finding(path, fmt::format("does not rise from 0 to {} ({})", limit, name));
      }
    }
  }

  /// Everything in the file that the schema does not know.
  void check_unknown() {
    std::pair<Validation*, int> data{this, 0};
    const auto visit = [](hid_t, const char* name, const H5O_info_t* info, void* at) -> herr_t {
      auto* self = static_cast<std::pair<Validation*, int>*>(at)->first;
      const std::string path = std::string("/") + name;
      if (info->type == H5O_TYPE_DATASET && !self->known_.contains(path)) self->finding(path, "is not in the schema");
      return 0;
    };
    H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, visit, &data, H5O_INFO_BASIC);
  }

  std::vector<std::string> findings;

private:
  void finding(const std::string& path, const std::string& what) { findings.push_back(one_line(path + " " + what)); }

  void check_extent(const DatasetDescription& dataset, const std::string& path, const std::string& snapshot,
                    std::size_t i, hsize_t found) {
    const Extent& wanted = dataset.extent[i];
    if (wanted.name.empty()) {
      if (wanted.fixed != found) finding(path, fmt::format("has extent {}, expected {}", found, dataset.shape));
      return;
    }
    std::string name(wanted.name);
    std::size_t value = found;
    if (constexpr std::string_view more = "_plus_1"; name.ends_with(more)) {
      name.resize(name.size() - more.size());
      if (found == 0) return finding(path, "is empty");
      --value;
    }
    if (name.front() == '*') name = snapshot + name;
    if (const auto [known, fresh] = extents_.emplace(name, std::pair{value, path});
        !fresh && known->second.first != value)
      finding(path, fmt::format("has {} {}, {} has {}", value, wanted.name, known->second.second, known->second.first));
  }

  void check_finite(hid_t set, const std::string& path) {
    std::size_t count = 1;
    for (const hsize_t extent : extents_of(set)) count *= extent;
    std::vector<double> values(count);
    if (count == 0) return;
    if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      return finding(path, "cannot be read");
    for (std::size_t i = 0; i < count; ++i)
      if (!std::isfinite(values[i])) return finding(path, fmt::format("holds {} at value {}", values[i], i));
  }

  struct Integers {
    const DatasetDescription* dataset;
    std::string path;
  };

  hid_t file_;
  std::set<std::string> known_;
  std::map<std::string, std::pair<std::size_t, std::string>> extents_;
  std::vector<Integers> integers_;
};

} // namespace

std::vector<std::string> validate(const std::string& path) {
  const FileReader file(path);
  Validation validation(file.state_->file);
  const auto snapshots = file.snapshots();
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(file.kind())].datasets) {
    if (!dataset.of_snapshot())
      validation.check(dataset, "");
    else
      for (const std::string& snapshot : snapshots) validation.check(dataset, snapshot);
  }
  validation.check_integers();
  validation.check_unknown();
  if (file.creator().empty()) validation.findings.emplace_back("root attribute creator is missing");
  return validation.findings;
}

} // namespace mpfem::schema
