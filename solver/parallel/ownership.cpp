#include "solver/parallel/ownership.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "common/index.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;

struct Grains {
  std::span<const std::array<double, 3>> centre;
  std::span<const double> weight;
};

/// The axis along which the centres of some grains extend furthest.
std::size_t longest_axis(const Grains& grains, std::span<const Index> some) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index g : some) {
      low = std::min(low, grains.centre[at(g)][axis]);
      high = std::max(high, grains.centre[at(g)][axis]);
    }
    if (high - low > length) length = high - low, longest = axis;
  }
  return longest;
}

/// How many of the sorted grains go to the first side: those whose weight comes closest to `share` of all, and at least
/// one for each rank on either side if there are enough.
std::size_t grains_of_first_side(const Grains& grains, std::span<const Index> sorted, double share, int first_ranks,
                                 int other_ranks) {
  double all = 0;
  for (const Index g : sorted) all += grains.weight[at(g)];
  std::size_t count = 0;
  double sum = 0;
  while (count < sorted.size() && sum + 0.5 * grains.weight[at(sorted[count])] < share * all)
    sum += grains.weight[at(sorted[count++])];
  const auto least = std::min(static_cast<std::size_t>(first_ranks), sorted.size());
  const auto most = sorted.size() - std::min(static_cast<std::size_t>(other_ranks), sorted.size() - least);
  return std::clamp(count, least, std::max(least, most));
}

void divide(const Grains& grains, std::span<Index> some, int first_rank, int ranks, std::vector<Index>& owner) {
  if (ranks == 1) {
    for (const Index g : some) owner[at(g)] = first_rank;
    return;
  }
  const std::size_t axis = longest_axis(grains, some);
  std::sort(some.begin(), some.end(), [&](Index a, Index b) {
    return std::pair(grains.centre[at(a)][axis], a) < std::pair(grains.centre[at(b)][axis], b);
  });
  const int first_ranks = ranks / 2, other_ranks = ranks - first_ranks;
  const std::size_t count =
      grains_of_first_side(grains, some, static_cast<double>(first_ranks) / ranks, first_ranks, other_ranks);
  divide(grains, some.first(count), first_rank, first_ranks, owner);
  divide(grains, some.subspan(count), first_rank + first_ranks, other_ranks, owner);
}

} // namespace

Ownership ownership_of(std::vector<Index> owner, int rank) {
  Ownership ownership;
  ownership.rank = rank;
  ownership.owner = std::move(owner);
  for (std::size_t g = 0; g < ownership.owner.size(); ++g)
    if (ownership.owner[g] == rank) ownership.own.push_back(static_cast<Index>(g));
  return ownership;
}

Ownership sole_ownership(int grains) {
  return ownership_of(std::vector<Index>(static_cast<std::size_t>(grains), 0), 0);
}

std::vector<Index> divide_among_ranks(std::span<const std::array<double, 3>> centre, std::span<const double> weight,
                                      int ranks) {
  std::vector<Index> owner(centre.size(), 0), all(centre.size());
  std::iota(all.begin(), all.end(), 0);
  divide({centre, weight}, all, 0, ranks, owner);
  return owner;
}

} // namespace mpfem
