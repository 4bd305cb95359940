#pragma once
// Values that each rank has for its own grains, brought to all ranks or, in the order of grains, to the first.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/index.hpp"
#include "solver/parallel/communicator.hpp"
#include "solver/parallel/ownership.hpp"

namespace mpfem {

/// Collective. `values` ([grains * width]) is set for the rank's own grains; afterwards it is set for all.
template <class T>
void share_of_grains(const Communicator& ranks, const Ownership& ownership, std::span<T> values,
                     std::size_t width = 1) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (ranks.alone() || width == 0) return;
  std::vector<T> own;
  own.reserve(width * ownership.own.size());
  for (const std::int32_t g : ownership.own)
    own.insert(own.end(), values.begin() + static_cast<std::ptrdiff_t>(width * at(g)),
               values.begin() + static_cast<std::ptrdiff_t>(width * at(g) + width));
  std::vector<std::size_t> first(static_cast<std::size_t>(ranks.size()) + 1, 0), bytes(first.size() - 1);
  for (const std::int32_t owner : ownership.owner) first[at(owner) + 1] += width;
  for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
    bytes[rank] = first[rank + 1] * sizeof(T);
    first[rank + 1] += first[rank];
  }
  std::vector<T> all(values.size());
  ranks.all_of(std::as_bytes(std::span<const T>(own)), bytes, std::as_writable_bytes(std::span<T>(all)));
  for (std::size_t g = 0; g < ownership.owner.size(); ++g) {
    std::size_t& from = first[at(ownership.owner[g])];
    std::copy_n(all.data() + from, width, values.data() + width * g);
    from += width;
  }
}

/// Collective. Brings `counts[g]` values of each grain to the first rank, in the order of grains and a few megabytes at
/// a time, so that no rank ever holds all of them. `counts` ([grains]) is the same on all ranks. `fill(grain, values)`
/// is called for the rank's own grains and sets counts[grain] values; `take(values)` is called on the first rank alone,
/// for one piece after another.
template <class T, class Fill, class Take>
void gather_at_root(const Communicator& ranks, const Ownership& ownership, std::span<const std::int64_t> counts,
                    Fill&& fill, Take&& take) {
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t piece_bytes = std::size_t{4} << 20;
  std::vector<T> piece, part;
  for (std::size_t begin = 0, end = 0; begin < counts.size(); begin = end) {
    std::size_t size = 0;
    for (end = begin; end < counts.size() && (end == begin || size * sizeof(T) < piece_bytes); ++end)
      size += static_cast<std::size_t>(counts[end]);
    piece.resize(size);
    // Own grains first; what belongs to other ranks comes from each in one message.
    std::vector<std::size_t> of_rank(static_cast<std::size_t>(ranks.size()), 0);
    std::size_t place = 0;
    for (std::size_t g = begin; g < end; ++g) {
      const auto count = static_cast<std::size_t>(counts[g]);
      of_rank[at(ownership.owner[g])] += count;
      if (ownership.owns(static_cast<std::int32_t>(g)) && count > 0)
        fill(static_cast<std::int32_t>(g), std::span<T>(piece.data() + place, count));
      place += count;
    }
    if (!ranks.is_root()) {
      part.clear();
      place = 0;
      for (std::size_t g = begin; g < end; ++g) {
        const auto count = static_cast<std::size_t>(counts[g]);
        if (ownership.owns(static_cast<std::int32_t>(g)))
          part.insert(part.end(), piece.data() + place, piece.data() + place + count);
        place += count;
      }
      if (!part.empty()) ranks.send(0, std::as_bytes(std::span<const T>(part)));
      continue;
    }
    for (int rank = 1; rank < ranks.size(); ++rank) {
      if (of_rank[at(rank)] == 0) continue;
      part.resize(of_rank[at(rank)]);
      ranks.receive(rank, std::as_writable_bytes(std::span<T>(part)));
      std::size_t from = 0;
      place = 0;
      for (std::size_t g = begin; g < end; ++g) {
        const auto count = static_cast<std::size_t>(counts[g]);
        if (ownership.owner[g] == rank) {
          std::copy_n(part.data() + from, count, piece.data() + place);
          from += count;
        }
        place += count;
      }
    }
    take(std::span<const T>(piece));
  }
}

} // namespace mpfem
