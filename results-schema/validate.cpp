#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "common/child_process.hpp"
#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "results-schema/file_reader.hpp"

namespace mpfem::schema {

namespace {

/// Reports what is wrong with one file. Keeps the named extents, each with the dataset in which it was found first.
class Examination {
public:
  using Report = std::function<void(const std::string& finding)>;
  Examination(const FileReader::State& state, Report report)
      : state_(state), file_(state.file), report_(std::move(report)), failed_(failed_snapshot()) {}

  void check(const DatasetDescription& dataset, const std::string& snapshot) {
    const std::string path = path_of(dataset, snapshot);
    if (!path_exists(file_, path)) {
      if (dataset.required) finding(path, "is missing");
      return;
    }
    known_.insert(path);
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) return finding(path, "is not a dataset");
    for (const auto& [name, wanted] :
         {std::pair{attribute::unit, dataset.unit}, std::pair{attribute::description, dataset.description}})
      if (const std::string found = read_text_attribute(set, name); found != wanted)
        finding(path, fmt::format("attribute {} is '{}', allowed: '{}'", name, found, wanted));
    if (!has_type(set, dataset.type)) return finding(path, fmt::format("is not of type {}", type_name(dataset.type)));
    const auto extents = extents_of(set);
    if (extents.size() != static_cast<std::size_t>(dataset.rank))
      return finding(path, fmt::format("has the shape {}, allowed: {}", extents_text(extents), dataset.shape));
    for (std::size_t i = 0; i < extents.size(); ++i)
      if (!check_extent(dataset, path, snapshot, i, extents[i])) return;
    if (const std::string problem = state_.implausible_size(set); !problem.empty()) return finding(path, problem);
    check_values(dataset, path, extents);
  }

  /// Checks ranges of indices, once all extents are known.
  void check_integers() {
    for (const auto& [dataset, path, least, most, rises] : integers_) {
      const std::string name(dataset->indexes.empty() ? dataset->partitions : dataset->indexes);
      const auto extent = extents_.find(name);
      if (extent == extents_.end()) continue;
      const auto limit = static_cast<std::int64_t>(extent->second.first);
      if (!dataset->indexes.empty()) {
        if (least < 0 || most >= limit)
          finding(path, fmt::format("holds the index {}, allowed: 0 … {}", least < 0 ? least : most, limit - 1));
      } else if (least != 0 || most != limit || !rises) {
        finding(path, fmt::format("does not rise from 0 to {} ({})", limit, name));
      }
    }
  }

  /// Reports datasets that are not in the schema.
  void check_unknown() {
    std::pair<Examination*, int> data{this, 0};
    const auto visit = [](hid_t, const char* name, const H5O_info_t* info, void* at) -> herr_t {
      auto* self = static_cast<std::pair<Examination*, int>*>(at)->first;
      const std::string path = std::string("/") + name;
      if (info->type == H5O_TYPE_DATASET && !self->known_.contains(path)) self->finding(path, "is not in the schema");
      return 0;
    };
    H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, visit, &data, H5O_INFO_BASIC);
  }

  void check_list() {
    if (state_.checksums.empty()) {
      if (state_.checked()) report_("root attribute checksums is missing, though the file has a seal");
    } else if (const std::string wrong = wrong_list(state_); !wrong.empty()) {
      report_(wrong);
    }
  }

private:
  /// Group of the last snapshot of a run that failed, which is that of its failed state; otherwise empty.
  std::string failed_snapshot() const {
    const std::string path = path_of(run::provenance_status, "");
    if (state_.kind != FileKind::run || !path_exists(file_, path)) return "";
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
    std::string status;
    if (!set || !has_type(set, ElementType::string) || !extents_of(set).empty() ||
        !state_.read(run::provenance_status, path, &status).empty())
      return "";
    const auto snapshots = snapshots_in(file_);
    return status.starts_with("failed") && !snapshots.empty() ? "/snapshots/" + snapshots.back() + "/" : "";
  }

  void finding(const std::string& path, const std::string& what) { report_(one_line(path + " " + what)); }

  /// False if the extent is wrong in itself.
  bool check_extent(const DatasetDescription& dataset, const std::string& path, const std::string& snapshot,
                    std::size_t i, hsize_t found) {
    const Extent& wanted = dataset.extent[i];
    if (wanted.name.empty()) {
      if (wanted.fixed != found) finding(path, fmt::format("has extent {}, allowed: {}", found, dataset.shape));
      return wanted.fixed == found;
    }
    std::string name(wanted.name);
    std::size_t value = found;
    if (constexpr std::string_view more = "_plus_1"; name.ends_with(more)) {
      name.resize(name.size() - more.size());
      if (found == 0) {
        finding(path, "is empty");
        return false;
      }
      --value;
    }
    if (name.front() == '*') name = snapshot + name;
    if (const auto [known, fresh] = extents_.emplace(name, std::pair{value, path});
        !fresh && known->second.first != value)
      finding(path, fmt::format("has {} {}, {} has {}", value, wanted.name, known->second.second, known->second.first));
    return true;
  }

  /// Reads the values once: checks their checksum and that they are finite (but not of a failed state), and keeps what
  /// check_integers() needs.
  void check_values(const DatasetDescription& dataset, const std::string& path, const std::vector<hsize_t>& extents) {
    std::size_t count = 1;
    for (const hsize_t extent : extents) count *= extent;
    with_element(dataset.type, [&](auto element) {
      using T = decltype(element);
      std::vector<T> values(count);
      if (const std::string wrong = state_.read(dataset, path, values.data()); !wrong.empty())
        return finding(path, wrong);
      if constexpr (std::is_floating_point_v<T>) {
        if (!failed_.empty() && path.starts_with(failed_)) return;
        const auto bad = std::find_if_not(values.begin(), values.end(), [](T value) { return std::isfinite(value); });
        if (bad != values.end()) finding(path, fmt::format("holds {} at value {}", *bad, bad - values.begin()));
      }
      if constexpr (std::is_integral_v<T>)
        if (count > 0 && !(dataset.indexes.empty() && dataset.partitions.empty())) {
          const bool rises = std::is_sorted(values.begin(), values.end());
          const auto [least, most] = std::minmax_element(values.begin(), values.end());
          integers_.push_back({&dataset, path, *least, *most, rises && values.front() == *least});
        }
    });
  }

  struct Integers {
    const DatasetDescription* dataset;
    std::string path;
    std::int64_t least, most;
    bool rises;
  };

  const FileReader::State& state_;
  hid_t file_;
  Report report_;
  std::string failed_;
  std::set<std::string> known_;
  std::map<std::string, std::pair<std::size_t, std::string>> extents_;
  std::vector<Integers> integers_;
};

void examine(const FileReader::State& state, const Examination::Report& report) {
  Examination examination(state, report);
  for (const DatasetDescription& dataset : kinds[static_cast<std::size_t>(state.kind)].datasets) {
    if (!dataset.of_member())
      examination.check(dataset, "");
    else
      for (const std::string& member : members_in(state.file, std::string(dataset.group())))
        examination.check(dataset, member);
  }
  examination.check_integers();
  examination.check_unknown();
  examination.check_list();
  if (read_text_attribute(state.file, attribute::creator).empty()) report("root attribute creator is missing");
}

/// First characters of the lines that the child process writes.
constexpr char told_finding = 'F', told_kind = 'K', told_unchecked = 'U', told_refusal = 'R', told_end = 'E';

void tell(const std::string& path, const std::function<void(std::string_view)>& write) {
  const auto line = [&](char what, std::string_view text = {}) { write(fmt::format("{}{}\n", what, text)); };
  const auto report = [&](const std::string& finding) { line(told_finding, finding); };
  try {
    std::error_code ignored;
    const Seal seal = std::filesystem::is_regular_file(path, ignored) ? check_seal(path) : Seal::absent;
    const auto state = open_unchecked(path);
    state->seal = seal;
    line(told_kind, kinds[static_cast<std::size_t>(state->kind)].name);
    if (!state->checked()) line(told_unchecked);
    if (seal == Seal::broken) report("the file is damaged: its structure does not match its checksum");
    examine(*state, report);
  } catch (const InputError& error) {
    line(told_refusal, error.what());
  }
  line(told_end);
}

/// Time limit (s), far more than any file needs: a minute, plus a second per 5 MB.
double longest_time(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return 60.0 + (error ? 0.0 : static_cast<double>(size) / 5e6);
}

} // namespace

Validation validate(const std::string& path) {
  const ChildEnd child = run_in_child([&](const auto& write) { tell(path, write); }, longest_time(path));
  Validation validation;
  validation.checked = true;
  bool ended = false;
  std::istringstream lines(child.output);
  for (std::string line; std::getline(lines, line);) {
    const std::string text = line.substr(std::min<std::size_t>(line.size(), 1));
    if (line.starts_with(told_finding)) validation.findings.push_back(text);
    if (line.starts_with(told_kind)) validation.kind = text;
    if (line.starts_with(told_unchecked)) validation.checked = false;
    if (line.starts_with(told_refusal)) throw InputError(text);
    ended = line.starts_with(told_end);
  }
  if (!ended)
    validation.findings.push_back(
        child.out_of_time   ? std::string("cannot be read: the HDF5 library did not finish in time")
        : child.signal != 0 ? fmt::format("cannot be read: the HDF5 library ended by signal {} ({})", child.signal,
                                          strsignal(child.signal))
                            : std::string("cannot be read: the HDF5 library ended the program (out of memory?)"));
  return validation;
}

} // namespace mpfem::schema
