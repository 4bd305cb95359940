#include "solver/parallel/same_build.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

void refuse_different_builds(const Communicator& ranks, const std::string& own) {
  if (ranks.alone()) return;
  const std::vector<Bytes> all = ranks.all_of(bytes_of(std::span<const char>(own)));
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    if (all[rank] == all[0]) continue;
    const auto text = [&](std::size_t of) {
      return std::string(reinterpret_cast<const char*>(all[of].data()), all[of].size());
    };
    throw InputError(fmt::format("found {} on rank 0 and {} on rank {}, allowed: one build on all ranks; "
                                 "MPFEM_INSTRUCTION_SET=v2, v3 or v4 selects one that all machines can run",
                                 text(0), text(rank), rank));
  }
}

} // namespace mpfem
