#pragma once
// Which rank owns which grain. A whole grain belongs to one rank.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mpfem {

/// The division of grains as one rank sees it.
struct Ownership {
  int rank = 0;
  std::vector<std::int32_t> owner; ///< [grains]: rank
  std::vector<std::int32_t> own;   ///< grains of this rank, ascending

  bool owns(std::int32_t grain) const { return owner[static_cast<std::size_t>(grain)] == rank; }
};

/// One rank owns all.
Ownership sole_ownership(int grains);
/// The ownership given by `owner` ([grains]), as seen by `rank`.
Ownership ownership_of(std::vector<std::int32_t> owner, int rank);

/// Divides grains among ranks by recursive coordinate bisection: the set is cut across its longest extent so that both
/// sides have their share of the weight, and so on. `centre` in mm, `weight` > 0: what a grain's step costs. The result
/// depends on these numbers alone. Berger and Bokhari, IEEE Transactions on Computers C-36 (1987) 570.
std::vector<std::int32_t> divide_among_ranks(std::span<const std::array<double, 3>> centre,
                                             std::span<const double> weight, int ranks);

} // namespace mpfem
