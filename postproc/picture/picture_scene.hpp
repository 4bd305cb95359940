#pragma once
// The content of a picture in three dimensions of a snapshot, in numbers; nothing here draws.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "postproc/drawing/colour_scale.hpp"
#include "postproc/drawing/cut_solid.hpp"
#include "postproc/drawing/raster_picture.hpp"

namespace mpfem {

/// What a picture shows.
struct SceneRequest {
  std::string colour = "von-mises";      ///< one of colour_names()
  std::string cut = "octant";            ///< one of cut_names()
  double cut_at = 0.5;                   ///< place of the cut, as a fraction of the box
  std::array<double, 2> camera{-55, 25}; ///< azimuth from the x axis towards y, elevation above the x-y plane; degrees
  /// Ends of the colour scale; default: range_of.
  std::optional<std::pair<double, double>> range;
  std::string title; ///< default: relative density and mean stress
  bool bonds = false, contacts = false;
  bool tools = true; ///< draw the rigid tools that are in place
};

/// What grains can be coloured by, as on the command line.
const std::vector<std::string>& colour_names();
/// What can be cut away, as on the command line.
const std::vector<std::string>& cut_names();

/// Unit vector from the box towards the camera.
Eigen::Vector3d towards_camera(const std::array<double, 2>& angles);

/// The part that is cut away: for an axis the camera's side of the plane, for the octant that of all three planes. Of
/// damage, a field of surfaces, whole grains are taken away: those whose centres lie in this part.
CutAway cut_away(const Snapshot& snapshot, const SceneRequest& request);

/// The part of the tools that is cut away so that grains can be seen: with an octant of the grains the whole quarter
/// above and below it, without a cut the half towards the camera, otherwise the same part; always slightly more than of
/// the grains.
CutAway tool_cut_away(const Snapshot& snapshot, const SceneRequest& request);

/// Kinds of rods: a bond whose mean damage is at most one half, a bond with more, a bond that is broken all over, and a
/// contact that carries a force.
enum class RodKind { intact, damaged, broken, contact };

/// Two grains that touch, or are or were bonded, drawn as a rod from centre to centre.
struct PairRod {
  Eigen::Vector3d from, to; ///< mm
  double radius = 0; ///< mm; bond: of a circle of a tenth of its intact area; contact: grows as the root of its force
  RodKind kind = RodKind::intact;
};

/// Rods for the contacts that carry a force and whose middles lie in the part cut away; all of them where `away` is
/// empty.
std::vector<PairRod> contact_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away);

/// Rods for the bonds whose middles lie in the part cut away; all of them where `away` is empty. Throws InputError
/// where the run has no bonds.
std::vector<PairRod> bond_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away);

/// Colours of a triangle's corners.
using CornerColours = std::array<Colour, 3>;

/// A colour and what it means.
struct KeyEntry {
  Colour colour{};
  std::string text;
};

/// The colour of rods of a kind: of Okabe and Ito (2008), distinct for all kinds of colour vision.
Colour rod_colour(RodKind kind);

/// What the colours of bonds mean, and that of contacts.
std::vector<KeyEntry> bond_key();
std::vector<KeyEntry> contact_key();

/// Everything that a picture shows, in numbers.
struct PictureScene {
  std::vector<SolidTriangle> triangles; ///< of grains, then of tools, which are numbered after the grains
  std::vector<CornerColours> colours;   ///< [triangles]
  std::size_t first_of_tools = 0;       ///< index of the first triangle of a tool
  std::vector<PairRod> rods;
  Eigen::Vector3d box_low, box_high; ///< mm
  std::array<double, 2> camera{};    ///< of the request
  std::string title, note;           ///< note: size of the box
  std::vector<KeyEntry> key;         ///< of the rods' colours
  std::optional<ColourBar> bar;
};

/// Default ends of the colour scale: 0 (or the 0.5th percentile where that is lower) and the 99.5th percentile of what
/// is drawn, by area; for damage 0 and 1.
std::pair<double, double> range_of(const std::vector<SolidTriangle>& triangles, const ShownField& field);

/// The scene without rods. Throws InputError where the snapshot has no such field, or everything is cut away.
PictureScene make_scene(const Snapshot& snapshot, const SceneRequest& request);

/// A box, mm.
struct ShownBox {
  Eigen::Vector3d low, high;
};

/// The box around the scene's box, its grains and its tools. Grains count up to 0.3 of the box's lengths outside it,
/// because grains of a failing sample fly off.
ShownBox bounds_of(const PictureScene& scene);
/// The smallest box around both.
ShownBox united(const ShownBox& a, const ShownBox& b);

} // namespace mpfem
