#pragma once
// The container that tools form: the cell between two punches and inside a die along z, which may be a bore, an STL
// surface of constant cross-section, or four planes.

#include <array>
#include <cstddef>
#include <optional>

#include "solver/boundary/cell.hpp"
#include "solver/boundary/tools.hpp"
#include "surfaces/prism.hpp"

namespace mpfem {

/// Computes the cell and the forces on its faces from the tools that form it.
class Container {
public:
  /// Indices of tools.
  struct Parts {
    std::array<std::size_t, 4> wall{}; ///< at the faces -x, +x, -y, +y: four planes, or the same die four times
    std::size_t lower = 0, upper = 0;
  };
  /// The tools stand where the run begins. Throws InputError where the cross-section of a die of triangles changes
  /// between the punches.
  Container(const Parts& parts, const Tools& tools);
  /// The cell where the tools stand now; if a punch is away, the cell keeps the height of `last`.
  Cell cell(const Tools& tools, const Cell& last) const;
  bool punch_is_away(const Tools& tools) const;
  /// N of each face, -x, +x, …: the forces on the punches and, at the four lateral faces, the forces on the planes or
  /// that which drives the halves of the die apart.
  std::array<double, 6> face_forces(const Tools& tools) const;

private:
  Parts parts_;
  std::optional<CrossSection> die_; ///< none: four planes
  double section_share_ = 1;        ///< of the bounding rectangle
  /// Perimeter of the die over its width along y (for the x faces), and along x. The pressure s of a die of height H
  /// pushes on its wall with s H times the perimeter, and drives its halves apart with s H times that width.
  std::array<double, 2> perimeter_over_width_{};
};

} // namespace mpfem
