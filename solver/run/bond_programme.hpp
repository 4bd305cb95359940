#pragma once
// `mpfem bond`: one contact point with a bond, driven along a sequence of separations.

#include <string>
#include <vector>

namespace mpfem {

/// Options of `mpfem bond`.
struct BondProgrammeOptions {
  std::string law;                      ///< TOML file: `stiffness` in MPa/mm and the table [bond]
  std::vector<std::string> assignments; ///< KEY=VALUE, which override the law
  std::string programme;                ///< CSV file of way points
  std::string output;                   ///< CSV file to write
  int increments = 200;                 ///< for way points whose row gives no number
  bool quiet = false;                   ///< no summary
};

/// Walks a point through the programme and writes a row for the start and for each increment; prints where it ended.
/// Nothing is written when an input is refused. Throws InputError, StorageError.
void run_bond_programme(const BondProgrammeOptions& options);

} // namespace mpfem
