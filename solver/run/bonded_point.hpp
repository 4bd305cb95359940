#pragma once
// One contact point with a bond, moved to any separation: the traction-separation law by itself.

#include <string_view>

#include "solver/physics/bond.hpp"

namespace mpfem {

/// Separation of the two sides of a contact point, mm.
struct Separation {
  double opening = 0;            ///< positive: apart; negative: closed
  double shear1 = 0, shear2 = 0; ///< two tangential directions at right angles
  bool operator==(const Separation&) const = default;
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

} // namespace mpfem
