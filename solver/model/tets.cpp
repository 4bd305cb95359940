#include "solver/model/tets.hpp"

namespace mpfem {

void fill_unused_lanes(Model& model) {
  with_tet_numbers(model, [&](auto number) {
    using Real = decltype(number);
    for (const std::int32_t grain : model.own()) {
      const std::int32_t last = model.block_offset[static_cast<std::size_t>(grain) + 1] - 1;
      TetBlock<Real>& block = model.block<Real>(last);
      const int used = model.tets_in_block<Real>(grain, last);
      for (int lane = used; lane < TetBlock<Real>::lanes; ++lane) {
        for (auto& component : block.deviator) component[lane] = component[used - 1];
        block.flow_stress[lane] = block.flow_stress[used - 1];
        block.plastic_strain[lane] = block.plastic_strain[used - 1];
        block.length[lane] = block.length[used - 1];
      }
    }
  });
}

} // namespace mpfem
