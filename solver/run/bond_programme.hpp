#pragma once
// One contact point with a bond, driven along a sequence of separations: the traction-separation law by itself.

#include <string>
#include <string_view>
#include <vector>

#include "solver/physics/bond.hpp"

namespace mpfem {

class CsvReader;
class TomlDocument;

/// Separation of the two sides of a contact point, mm.
struct Separation {
  double opening = 0;            ///< positive: apart; negative: closed
  double shear1 = 0, shear2 = 0; ///< two tangential directions at right angles
  bool operator==(const Separation&) const = default;
};

/// The next separation of a programme, reached from the one before in a straight line and equal steps.
struct WayPoint {
  Separation separation;
  int increments = 0;
};

/// What the point is made of.
struct BondedPointLaw {
  BondLaw bond;
  double penalty = 0;             ///< MPa/mm, of the closed contact
  bool rebond_on_contact = false; ///< a broken bond that has opened forms again when the point closes
};

/// A contact point: its bond, and the undamaged penalty while it is closed. It begins bonded, at zero separation.
/// Tractions are positive in tension and along the shear separation.
class BondedPoint {
public:
  struct Response {
    double normal = 0, shear1 = 0, shear2 = 0; ///< tractions, MPa; normal < 0: compression
    double effective = 0;                      ///< effective separation sqrt(<opening>^2 + shear^2), mm
    double damage = 0;                         ///< D, 0 … 1
    double stored = 0;                         ///< N/mm: bond, and penalty where closed
    double dissipated = 0;                     ///< N/mm lost to damage since the beginning
    std::string_view state;                    ///< "intact", "damaged" or "broken"
  };

  explicit BondedPoint(const BondedPointLaw& law) : law_(law) {}

  /// Moves the point to a separation.
  Response move_to(const Separation& separation);

private:
  BondedPointLaw law_;
  BondState state_;
  bool gone_ = false;            ///< the broken bond has opened, so the point may bond again
  Separation attached_;          ///< where the bond was made: its shear counts from there
  double dissipated_before_ = 0; ///< N/mm, dissipated by earlier bonds of the point
};

/// Options of `mpfem bond`.
struct BondProgrammeOptions {
  std::string law;                      ///< TOML file: `stiffness` in MPa/mm and the table [bond]
  std::vector<std::string> assignments; ///< KEY=VALUE, which override the law
  std::string programme;                ///< CSV file of way points
  std::string output;                   ///< CSV file to write
  int increments = 200;                 ///< for way points whose row gives no number
  bool quiet = false;                   ///< no summary
};

/// Reads `stiffness` (MPa/mm) and [bond]. Throws InputError, also if the fracture energy is too small for a softening
/// branch at this stiffness (strength^2/(2 K), as for a run).
BondedPointLaw read_bonded_point_law(const TomlDocument& document);

/// Reads way points from a CSV file with the heading "opening,shear1,shear2" (mm) and, optionally, ",increments" (a
/// whole number; empty: `increments`). '#' begins a comment. Throws InputError "FILE:LINE: column …".
std::vector<WayPoint> read_bond_programme(const std::string& path, int increments);
/// The same for a table that is already open.
std::vector<WayPoint> read_bond_programme(CsvReader reader, int increments);

/// Walks a point through the programme and writes a row for the start and for each increment; prints where it ended.
/// Nothing is written when an input is refused. Throws InputError, StorageError.
void run_bond_programme(const BondProgrammeOptions& options);

} // namespace mpfem
