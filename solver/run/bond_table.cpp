#include "solver/run/bond_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mpfem {

namespace {

/// A point on the straight line between two separations; exact at both ends.
Separation between(const Separation& from, const Separation& to, int part, int parts) {
  if (part == parts) return to;
  const double t = static_cast<double>(part) / parts;
  return {from.opening + t * (to.opening - from.opening), from.shear1 + t * (to.shear1 - from.shear1),
          from.shear2 + t * (to.shear2 - from.shear2)};
}

/// Work of the tractions from one separation to the next by the trapezoidal rule, N/mm.
double trapezoid(const Separation& a, const BondedPoint::Response& at_a, const Separation& b,
                 const BondedPoint::Response& at_b) {
  return 0.5 *
         ((at_a.normal + at_b.normal) * (b.opening - a.opening) + (at_a.shear1 + at_b.shear1) * (b.shear1 - a.shear1) +
          (at_a.shear2 + at_b.shear2) * (b.shear2 - a.shear2));
}

} // namespace

BondTable::BondTable(const std::string& path, const BondedPointLaw& law)
    : file_(path), point_(law), response_(point_.move_to(here_)) {
  fmt::format_to(std::back_inserter(text_),
                 "way_point,opening_mm,shear1_mm,shear2_mm,normal_traction_MPa,shear1_traction_MPa,shear2_traction_MPa,"
                 "effective_separation_mm,damage,stored_N_per_mm,dissipated_N_per_mm,work_N_per_mm,"
                 "trapezoidal_work_N_per_mm,state\n");
  write_row(0);
}

void BondTable::walk_to(const WayPoint& way_point, std::size_t number) {
  const Separation from = here_;
  for (int k = 1; k <= way_point.increments; ++k) {
    const Separation next = between(from, way_point.separation, k, way_point.increments);
    const BondedPoint::Response there = point_.move_to(next);
    work_ += trapezoid(here_, response_, next, there);
    here_ = next;
    response_ = there;
    peak_normal_ = std::max(peak_normal_, response_.normal);
    peak_shear_ = std::max(peak_shear_, std::hypot(response_.shear1, response_.shear2));
    write_row(number);
  }
}

void BondTable::complete() {
  write_out();
  file_.complete();
}

std::string BondTable::summary() const {
  return fmt::format("{} at the end, damage {:.6g}; largest traction {:.6g} MPa in tension, {:.6g} MPa in shear; "
                     "dissipated {:.6g} N/mm, stored {:.6g} N/mm",
                     response_.state, response_.damage, peak_normal_, peak_shear_, response_.dissipated,
                     response_.stored);
}

void BondTable::write_row(std::size_t way_point) {
  constexpr std::size_t buffered = 1 << 16; // bytes
  const BondedPoint::Response& r = response_;
  fmt::format_to(std::back_inserter(text_), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", way_point, here_.opening,
                 here_.shear1, here_.shear2, r.normal, r.shear1, r.shear2, r.effective, r.damage, r.stored,
                 r.dissipated, r.stored + r.dissipated, work_, r.state);
  if (text_.size() > buffered) write_out();
}

void BondTable::write_out() {
  file_.write({text_.data(), text_.size()});
  text_.clear();
}

} // namespace mpfem
