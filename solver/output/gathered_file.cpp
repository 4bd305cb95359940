#include "solver/output/gathered_file.hpp"

#include <fmt/format.h>

#include "common/version.hpp"
#include "solver/parallel/root.hpp"

namespace mpfem {

GatheredFile::GatheredFile(const Communicator& ranks, const Ownership& ownership, const std::string& path,
                           schema::FileKind kind)
    : ranks_(ranks), ownership_(ownership) {
  root_does(ranks, [&] { file_.emplace(path, kind, fmt::format("mpfem {}", version_and_commit())); });
}

void GatheredFile::commit() {
  root_does(ranks_, [this] {
    if (failure_) std::rethrow_exception(failure_);
    file_->commit();
  });
}

std::vector<std::int64_t> rows_of_grains(std::span<const std::int32_t> first) {
  std::vector<std::int64_t> rows(first.size() - 1);
  for (std::size_t g = 0; g < rows.size(); ++g) rows[g] = first[g + 1] - first[g];
  return rows;
}

} // namespace mpfem
