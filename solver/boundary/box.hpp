#pragma once
// The box: a cell with a rigid plane at each of its six faces, a wall. Only the box says how large the packing's cell
// is and which stress it bears; another kind of cell would answer the same questions.

#include <array>
#include <span>

#include "solver/boundary/cell.hpp"
#include "solver/boundary/plane.hpp"

namespace mpfem {

/// What the walls do to one grain. Side 0 … 5: -x, +x, -y, +y, -z, +z.
struct BoxSums {
  std::array<SurfaceLoad, 6> wall{};
  double energy = 0; ///< mJ, of all walls
  double penetration() const;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    for (auto& load : s.wall) SurfaceLoad::for_each_term(load, visit);
    visit.sum(s.energy);
  }
};

/// The six walls, or those of them that are there, and the forces on them.
class Box {
public:
  /// `withdrawn`: axes whose two walls are away; there the cell has bare faces.
  Box(const Cell& cell, const std::array<bool, 3>& withdrawn) : cell_(cell), withdrawn_(withdrawn) {}

  // ---- geometry
  const Cell& cell() const { return cell_; }
  /// Whether the two walls across an axis are there.
  bool has_walls(std::size_t axis) const { return !withdrawn_[axis]; }
  Plane wall(std::size_t side) const;

  // ---- a step
  /// mm, inward movement of a wall in the step that led to the present; 0 after take_loads().
  double movement(std::size_t side) const { return movement_[side]; }
  /// Adds the walls' forces on a grain to model.force. `bounds`: the current bounding box of the grain's surface.
  BoxSums add_forces(Model& model, const Bounds& bounds, int grain) const;
  /// N, the push of all walls on the contact point of a surface node.
  double wall_force_on_node(const Model& model, std::size_t node, int grain) const;
  /// N, the push of each wall on a grain.
  std::array<double, 6> wall_forces_on_grain(const Model& model, int grain) const;
  /// Adds K A/m (1/s^2) of the walls that each node touches to `rate` [nodes].
  void add_stiffness_rate(const Model& model, const Bounds& bounds, int grain, std::span<double> rate) const;
  /// Records what the faces bear at this time level: `contact` (N), the push of each wall, and `grip` (N), that of
  /// grips at the faces. Returns the work (mJ) of each wall since the level before, by the trapezoidal rule, which
  /// central differences conserve.
  std::array<double, 6> take_loads(const std::array<double, 6>& contact, const std::array<double, 6>& grip);
  /// Sets the cell after a step; the walls move with its faces.
  void move_to(const Cell& next);
  /// Sets the cell to where its tools stand (tools.hpp); this does not move walls.
  void set_cell(const Cell& cell) { cell_ = cell; }

  // ---- stress, compression positive
  /// N, of each face at the last time level.
  const std::array<double, 6>& force() const { return force_; }
  /// N, mean of the two faces across each axis.
  std::array<double, 3> axis_force() const;
  /// MPa, of each face.
  std::array<double, 6> stress() const;
  /// MPa, mean over the faces at the last take_loads().
  double mean_stress() const { return mean_stress_; }

  // ---- walls that leave and return
  void withdraw(const std::array<bool, 3>& axes) { withdrawn_ = axes; }
  /// Moves the faces across an axis outwards until they touch no grain, so that walls may stand there again.
  void move_clear(std::size_t axis, std::span<const Bounds> grains);

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("box.low", s.cell_.low), visit("box.high", s.cell_.high), visit("box.withdrawn", s.withdrawn_);
    visit("box.section_share", s.cell_.section_share);
    visit("box.force", s.force_), visit("box.movement", s.movement_), visit("box.mean_stress", s.mean_stress_);
  }

private:
  Cell cell_;
  std::array<bool, 3> withdrawn_;
  std::array<double, 6> force_{};    ///< N, at the last time level
  std::array<double, 6> movement_{}; ///< mm inward, of the walls in the step that followed it
  double mean_stress_ = 0;           ///< MPa
};

} // namespace mpfem
