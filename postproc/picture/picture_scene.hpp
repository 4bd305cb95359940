#pragma once
// What a picture in three dimensions shows of a snapshot, in numbers: nothing here draws.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "postproc/colour_scale.hpp"
#include "postproc/picture/cut_solid.hpp"
#include "postproc/raster_picture.hpp"

namespace mpfem {

struct SceneRequest {
  std::string colour = "von-mises";      ///< one of colour_names()
  std::string cut = "octant";            ///< one of cut_names()
  double cut_at = 0.5;                   ///< where the cut stands, as a fraction of the box
  std::array<double, 2> camera{-55, 25}; ///< azimuth from the x axis towards y, elevation above the x-y plane; degrees
  /// Of the colour scale; default: see range_of.
  std::optional<std::pair<double, double>> range;
  std::string title; ///< default: relative density and mean stress
  bool bonds = false, contacts = false;
  bool tools = true; ///< draw rigid tools that are in place
};

const std::vector<std::string>& colour_names();
const std::vector<std::string>& cut_names();

/// Unit vector from the box towards the camera.
Eigen::Vector3d towards_camera(const std::array<double, 2>& angles);

/// What is cut away: of an axis the camera's side of the plane, of the octant that of all three planes.
CutAway cut_away(const Snapshot& snapshot, const SceneRequest& request);

/// What is cut away of tools, so that grains are seen: with an octant of the grains the whole quarter above and below
/// it, with nothing of them the half towards the camera; else the same.
CutAway tool_cut_away(const Snapshot& snapshot, const SceneRequest& request);

/// What a rod stands for: a bond of which some area is unbroken, one that is broken, a contact that carries a force.
enum class RodKind { whole, broken, contact };

/// Two grains that are bonded or have been, or that touch, drawn as a rod from centre to centre.
struct PairRod {
  Eigen::Vector3d from, to; ///< mm
  double radius = 0; ///< mm; of a whole bond that of a circle of a tenth of its area, of a contact as the root of force
  RodKind kind = RodKind::whole;
};

/// Contacts of the snapshot that carry a force, those whose middles lie in what is cut away.
std::vector<PairRod> contact_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away);

/// Rods whose middles lie in what is cut away. Throws InputError where the run has no bonds.
std::vector<PairRod> bond_rods(const schema::FileReader& file, const Snapshot& snapshot, const CutAway& away);

/// Colours of a triangle's corners.
using CornerColours = std::array<Colour, 3>;

struct PictureScene {
  std::vector<SolidTriangle> triangles; ///< of grains, then of tools, whose numbers follow those of the grains
  std::vector<CornerColours> colours;   ///< of the triangles
  std::size_t first_of_tools = 0;       ///< where the tools' triangles begin
  std::vector<PairRod> rods;
  Eigen::Vector3d box_low, box_high; ///< mm
  Eigen::Vector3d towards_camera;
  std::string title, note; ///< the note: what the box measures, and what the rods' colours mean
  std::optional<ColourBar> bar;
};

/// 0 (or, where lower, the 0.5th percentile) … the 99.5th percentile of what is drawn, by area; of damage 0 … 1.
std::pair<double, double> range_of(const std::vector<SolidTriangle>& triangles, const ShownField& field);

/// Without rods. Throws InputError where the file has no such field or everything is cut away.
PictureScene make_scene(const Snapshot& snapshot, const SceneRequest& request);

/// A box, mm.
struct ShownBox {
  Eigen::Vector3d low, high;
};

/// Around the scene's box and its grains, as far as these lie within 0.3 of the box's lengths: grains of a sample that
/// fails fly off. Around all that is drawn of tools.
ShownBox bounds_of(const PictureScene& scene);
ShownBox united(const ShownBox& a, const ShownBox& b);

/// Round values for the ticks of a scale, 1, 2 or 5 times a power of ten apart, at most `most` + 1 of them.
std::vector<double> round_ticks(std::pair<double, double> range, int most);

} // namespace mpfem
