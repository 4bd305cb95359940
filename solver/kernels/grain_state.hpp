#pragma once
// What is observed of a grain's tets: energy, volume, fields for output, and the first tet that is not admissible.

#include <cstdint>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Elastic energy of a grain, mJ.
double elastic_energy(const Model& model, int grain);

/// Current volume of a grain, mm^3.
double current_volume(const Model& model, int grain);

/// A tet that is inverted or not finite.
struct BadTet {
  std::int32_t file_tet = -1; ///< index in the packing file; -1: none
  double volume_ratio = 0;    ///< J
};
/// The first inverted (or not finite) tet of a grain in the order of memory; none if all are good.
BadTet find_bad_tet(const Model& model, int grain);

/// Fields of a grain's tets for output, in their order in the packing file.
struct TetFields {
  std::vector<float> von_mises; ///< MPa
  std::vector<float> pressure;  ///< MPa, compression positive
  std::vector<float> plastic_strain;
};
/// Fields of all tets of a grain.
TetFields tet_fields(const Model& model, int grain);

} // namespace mpfem
