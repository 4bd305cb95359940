#pragma once
// Rigid tools of a scenario as plain structs: [[tools]] and [container]. Only read_tools.cpp knows the keywords of the
// TOML file.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/key_places.hpp"
#include "solver/scenario/bond_parameters.hpp"

namespace mpfem {

/// A plane; the grains are where its normal points.
struct PlaneShape {
  std::optional<std::size_t> face{}; ///< 0 … 5: at the face -x, +x, … of the packing's box; then the rest is unused
  std::array<double, 3> point{};     ///< mm, in the plane
  std::array<double, 3> normal{0, 0, 1}; ///< towards the grains, of any length
  bool operator==(const PlaneShape&) const = default;
};

/// A circular cylinder along a coordinate axis: a die (grains inside) or a rod (grains outside).
struct CylinderShape {
  std::size_t axis = 2;                          ///< 0 x, 1 y, 2 z
  std::optional<std::array<double, 3>> centre{}; ///< mm, a point of the axis; none: the middle of the packing's box
  std::optional<double> radius{};                ///< mm; none: half of the packing's box across the axis
  bool inside = true;                            ///< grains are inside
  std::optional<std::array<double, 2>> extent{}; ///< mm, along the axis from end to end; none: endless
  double rounding = 0;                           ///< mm, radius of the rounded edges at both ends
  bool operator==(const CylinderShape&) const = default;
};

/// A ball (grains outside) or a hollow of that shape (grains inside).
struct SphereShape {
  std::array<double, 3> centre{}; ///< mm
  double radius = 0;              ///< mm
  bool inside = false;            ///< grains are inside
  bool operator==(const SphereShape&) const = default;
};

/// An endless circular cone along a coordinate axis: a hopper (grains inside) or an indenter (grains outside).
struct ConeShape {
  std::size_t axis = 2;         ///< 0 x, 1 y, 2 z
  double direction = 1;         ///< 1: it opens towards +axis, -1: towards -axis
  std::array<double, 3> apex{}; ///< mm
  double half_angle = 0;        ///< rad, between axis and surface
  bool inside = true;           ///< grains are inside
  bool operator==(const ConeShape&) const = default;
};

/// A closed surface of triangles.
struct StlShape {
  std::string file;                                  ///< relative to the scenario's folder
  double scale = 1;                                  ///< mm per unit of length of the file
  bool inside = false;                               ///< grains are inside
  std::optional<std::array<double, 3>> low_corner{}; ///< mm, low corner of its bounding box; none: as in the file
  bool operator==(const StlShape&) const = default;
};

using ToolShape = std::variant<PlaneShape, CylinderShape, SphereShape, ConeShape, StlShape>;

/// One entry of [[tools]].
struct ToolParameters {
  std::string name;
  ToolShape shape;
  double friction = 0;                      ///< Coulomb's mu between grains and the tool
  std::optional<BondParameters> adhesion{}; ///< bonds of grains to the tool; none: nothing sticks to it
  KeyPlaces places{};
  KeyPlaces adhesion_places{};
};

/// The tools between which relative density and stresses are taken: a die along z and two punches across z. Indices
/// into the scenario's tools.
struct ContainerParameters {
  std::array<std::size_t, 4> wall{}; ///< at the faces -x, +x, -y, +y: four planes, or the same die four times
  std::size_t lower = 0, upper = 0;
  bool operator==(const ContainerParameters&) const = default;
};

/// Name of a shape in scenarios: plane, cylinder, sphere, cone, stl.
const char* shape_name(const ToolShape& shape);

/// Unit direction in which a tool pushes and is pushed: the normal of a plane, the axis of a cylinder or cone; none for
/// a sphere or a surface of triangles.
std::optional<std::array<double, 3>> direction_of(const ToolShape& shape);

/// What one tool does in a stage: it moves at a velocity, or holds its push along a direction: a force or, for a punch
/// of the container, a stress.
struct ToolDrive {
  std::size_t tool = 0;              ///< index into the scenario's tools
  std::array<double, 3> velocity{};  ///< mm/s, at full speed
  std::array<double, 3> direction{}; ///< unit vector: the stage's, or the tool's own; 0 where there is neither
  std::optional<double> force{};     ///< N, push on the grains along the direction, held instead of a velocity
  std::optional<double> stress{};    ///< MPa, that push over the container's section, instead of `force`
  double servo_speed = 0;            ///< mm/s, largest speed of a tool that holds its push

  bool holds_push() const { return force || stress; }
};

} // namespace mpfem
