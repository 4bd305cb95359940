#pragma once
// The tets of a model one by one, whatever blocks they lie in.

#include <cstddef>
#include <cstdint>

#include "solver/model/model.hpp"

namespace mpfem {

/// Calls f(block, lane, tet) for the tets [first, end) of a grain, in the order of the blocks: the values of tet number
/// `tet` are block.NAME[lane].
template <class ModelType, class F>
void for_tets_of(ModelType& model, std::int32_t grain, std::int32_t first, std::int32_t end, F&& f) {
  with_tet_numbers(model, [&](auto number) {
    using Real = decltype(number);
    constexpr std::int32_t lanes = TetBlock<Real>::lanes;
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t tet = first; tet < end; ++tet) {
      const std::int32_t place = tet - model.tet_offset[g];
      f(model.template block<Real>(model.block_offset[g] + place / lanes), place % lanes,
        static_cast<std::size_t>(tet));
    }
  });
}

/// The same for all tets of the rank's own grains.
template <class ModelType, class F>
void for_each_tet(ModelType& model, F&& f) {
  for (const std::int32_t grain : model.own()) {
    const auto g = static_cast<std::size_t>(grain);
    for_tets_of(model, grain, model.tet_offset[g], model.tet_offset[g + 1], f);
  }
}

/// Unused lanes of a grain's last block repeat the state of its last tet. To be called after the tets were set one by
/// one.
void fill_unused_lanes(Model& model);

} // namespace mpfem
