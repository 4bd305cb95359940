#pragma once
// The tets of a model one by one, whatever blocks they lie in.

#include <cstddef>
#include <cstdint>

#include "solver/model/model.hpp"

namespace mpfem {

/// Calls f(block, lane, tet) for every tet of the rank's own grains, in the order of the blocks: its values are block.NAME[lane],
/// its number is `tet`.
template <class ModelType, class F>
void for_each_tet(ModelType& model, F&& f) {
  with_tet_numbers(model, [&](auto number) {
    using Real = decltype(number);
    for (const std::int32_t grain : model.own()) {
      const auto g = static_cast<std::size_t>(grain);
      for (std::int32_t b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b)
        for (int lane = 0; lane < model.template tets_in_block<Real>(grain, b); ++lane)
          f(model.template block<Real>(b), lane,
            static_cast<std::size_t>(model.tet_offset[g] + (b - model.block_offset[g]) * TetBlock<Real>::lanes + lane));
    }
  });
}

/// Unused lanes of a grain's last block repeat the state of its last tet. To be called after the tets were set one by
/// one.
void fill_unused_lanes(Model& model);

} // namespace mpfem
