#pragma once
// The table that `mpfem bond` writes while it drives a point along a programme.

#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "common/output_file.hpp"
#include "solver/run/bonded_point.hpp"
#include "solver/run/read_bond_programme.hpp"

namespace mpfem {

/// A CSV file with a row for the start and for each increment, and a summary of where the point ended. What writes
/// throws StorageError.
class BondTable {
public:
  BondTable(const std::string& path, const BondedPointLaw& law);

  /// Walks to a way point, the `number`-th from 1, with a row for each increment.
  void walk_to(const WayPoint& way_point, std::size_t number);
  /// Writes what is left and gives the file its name.
  void complete();
  /// One line: the state, the largest tractions (MPa) and the energies (N/mm).
  std::string summary() const;

private:
  void write_row(std::size_t way_point);
  void write_out();

  TextFile file_;
  fmt::memory_buffer text_; ///< not yet written
  BondedPoint point_;
  Separation here_;
  BondedPoint::Response response_;
  double work_ = 0;                         ///< N/mm, of the tractions so far
  double peak_normal_ = 0, peak_shear_ = 0; ///< MPa
};

} // namespace mpfem
