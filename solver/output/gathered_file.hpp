#pragma once
// A file to which all ranks contribute, each the values of its own grains. Only the first rank has it open. It receives
// the values of the others in the order of grains, a few megabytes at a time. So the file is what one rank would have
// written, and no rank ever holds a whole array.
//
// Everything here is collective. If the first rank cannot write, it still receives what the others send, and all throw
// its error together when the file is committed.

#include <cstdint>
#include <exception>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results-schema/file.hpp"
#include "solver/model/model.hpp"
#include "solver/parallel/grain_values.hpp"

namespace mpfem {

/// A file that is being written.
class GatheredFile {
public:
  /// All arguments must outlive the file. Throws StorageError, and InputError if `path` is a folder or a device.
  GatheredFile(const Communicator& ranks, const Ownership& ownership, const std::string& path, schema::FileKind kind);

  const Communicator& ranks() const { return ranks_; }
  /// Calls write(file) on the first rank, for data that all ranks share.
  template <class Write>
  void at_root(Write&& write) {
    attempt([&] { write(*file_); });
  }
  /// The same for one array. `member`: what takes the place of '*' in the dataset's path.
  template <class Dataset, class Values>
  void write(const Dataset& dataset, const Values& values, std::size_t rows, std::string_view member = {}) {
    attempt([&] { file_->write(dataset, std::span<const typename Values::value_type>(values), rows, member); });
  }
  /// An array with `rows[g]` rows of each grain, the same on all ranks: fill(grain, values) sets those of an own grain.
  template <class T, int Rank, class Fill>
  void write_grains(const schema::Dataset<T, Rank>& dataset, std::span<const std::int64_t> rows, Fill&& fill,
                    std::string_view member = {}) {
    begin(dataset, std::accumulate(rows.begin(), rows.end(), std::int64_t{0}), member);
    append_grains(dataset, rows, fill);
  }
  /// The same for offsets, one for each part and one for the end: `start[g]` is the first of a grain, start.back() the
  /// end.
  template <class Fill>
  void write_running_numbers(const schema::Dataset<std::int32_t, 1>& dataset, std::span<const std::int64_t> rows,
                             std::int64_t end, Fill&& fill) {
    begin(dataset, std::accumulate(rows.begin(), rows.end(), std::int64_t{1}), {});
    append_grains(dataset, rows, fill);
    const auto last = static_cast<std::int32_t>(end);
    append(std::span<const std::int32_t>(&last, 1));
  }
  /// Throws StorageError.
  void commit();

private:
  /// On the first rank, unless something has failed before.
  template <class Write>
  void attempt(Write&& write) {
    if (!file_ || failure_) return;
    try {
      write();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
  template <class T, int Rank>
  static constexpr std::size_t columns(const schema::Dataset<T, Rank>& dataset) {
    return Rank == 2 ? dataset.extent[1].fixed : 1;
  }
  template <class T, int Rank>
  void begin(const schema::Dataset<T, Rank>& dataset, std::int64_t rows, std::string_view member) {
    attempt([&] { file_->begin(dataset, static_cast<std::size_t>(rows), columns(dataset), member); });
  }
  template <class T>
  void append(std::span<const T> values) {
    if (!values.empty()) attempt([&] { file_->append(values); });
  }
  template <class T, int Rank, class Fill>
  void append_grains(const schema::Dataset<T, Rank>& dataset, std::span<const std::int64_t> rows, Fill&& fill) {
    std::vector<std::int64_t> values(rows.begin(), rows.end());
    for (std::int64_t& count : values) count *= static_cast<std::int64_t>(columns(dataset));
    gather_at_root<T>(ranks_, ownership_, values, fill, [this](std::span<const T> piece) { append(piece); });
  }

  const Communicator& ranks_;
  const Ownership& ownership_;
  std::optional<schema::FileWriter> file_; ///< on the first rank
  std::exception_ptr failure_;             ///< the first one
};

/// Number of rows of each grain; first[g] ([grains + 1]) is its first row.
std::vector<std::int64_t> rows_of_grains(std::span<const std::int32_t> first);

/// Collective. The number of something in each grain: count(grain) for own grains; other ranks give the counts of
/// theirs.
template <class Count>
std::vector<std::int64_t> count_of_grains(const Communicator& ranks, const Model& model, Count&& count) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(model.grains), 0);
  for (const std::int32_t grain : model.own())
    counts[static_cast<std::size_t>(grain)] = static_cast<std::int64_t>(count(grain));
  share_of_grains(ranks, model.ownership, std::span<std::int64_t>(counts));
  return counts;
}

} // namespace mpfem
