#include "solver/run/bonded_point.hpp"

#include <cmath>

namespace mpfem {

BondedPoint::Response BondedPoint::move_to(const Separation& separation) {
  const BondLaw& law = law_.bond;
  const bool closed = separation.opening < 0;
  if (closed && gone_) {
    dissipated_before_ += law.fracture_energy;
    state_ = {};
    attached_ = separation;
    gone_ = false;
  }
  const double shear1 = separation.shear1 - attached_.shear1, shear2 = separation.shear2 - attached_.shear2;
  const BondTraction traction = bond_traction(law, state_, separation.opening, shear1, shear2);
  const bool broken = is_broken(law, state_);
  gone_ = law_.rebond_on_contact && broken && !closed;

  Response response;
  const double penetration = closed ? separation.opening : 0.0;
  response.normal = traction.normal + law_.penalty * penetration;
  response.shear1 = traction.shear[0];
  response.shear2 = traction.shear[1];
  const double open = closed ? 0.0 : separation.opening;
  response.effective = law.normal_only ? open : std::sqrt(open * open + shear1 * shear1 + shear2 * shear2);
  response.damage = 1 - remaining_stiffness(law, state_);
  response.stored = traction.stored + 0.5 * law_.penalty * penetration * penetration;
  response.dissipated = dissipated_before_ + damage_dissipation(law, state_);
  response.state = broken ? "broken" : state_.initiation > 0 ? "damaged" : "intact";
  return response;
}

} // namespace mpfem
