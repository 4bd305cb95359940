#pragma once
// The inputs of `mpfem bond`: the law of the point and the way points of the programme.

#include <string>
#include <vector>

#include "solver/run/bonded_point.hpp"

namespace mpfem {

class CsvReader;
class TomlDocument;

/// The next separation of a programme, reached from the one before in a straight line and equal steps.
struct WayPoint {
  Separation separation;
  int increments = 0;
};

/// Reads `stiffness` (MPa/mm) and [bond]. Throws InputError, also if the fracture energy is too small for a softening
/// branch at this stiffness (strength^2/(2 K), as for a run).
BondedPointLaw read_bonded_point_law(const TomlDocument& document);

/// Reads way points from a CSV file with the heading "opening,shear1,shear2" (mm) and, optionally, ",increments" (a
/// whole number; empty: `increments`). '#' begins a comment. Throws InputError "FILE:LINE: column …".
std::vector<WayPoint> read_bond_programme(const std::string& path, int increments);
/// The same for a table that is already open.
std::vector<WayPoint> read_bond_programme(CsvReader reader, int increments);

} // namespace mpfem
