#pragma once
// Mean stress of a region of a packing: from the forces between grains, and from the pressure in the grains' solid.

#include <span>

#include <Eigen/Core>

namespace mpfem {

/// A box, mm.
struct Region {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  double volume() const { return (high - low).prod(); }
  bool contains(const Eigen::Vector3d& x) const {
    return (x.array() >= low.array()).all() && (x.array() < high.array()).all();
  }
};

/// The region with the same centre and `share` of its lengths.
Region inner_region(const Region& whole, double share);

/// Share (0 … 1) of the straight line between two points (mm) that lies in a region.
double share_inside(const Region& region, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// A force between two points: the centres of two grains, or the centre of a grain and the wall's plane next to it.
struct ForceLine {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero(); ///< mm
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< N, on the grain at `from` by the grain or wall at `to`
};

/// Mean stress of a region by Love and Weber (MPa, compression positive): -1/V sum of force (x) line, each line
/// weighted by its share inside the region (Love 1927; Weber 1966; lines as in Goldhirsch, Granular Matter 12 (2010)
/// 239, with the region as the averaging function). For a region that holds all grains, with the forces of its walls,
/// it equals what the walls carry, exactly in equilibrium.
Eigen::Matrix3d love_weber_stress(const Region& region, std::span<const ForceLine> lines);

/// Part of a solid with one pressure.
struct PressedVolume {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< mm
  double volume = 0;                                ///< mm^3
  double pressure = 0;                              ///< MPa, compression positive
};

/// Mean stress (MPa) of a region from its solid; pores carry nothing. Sum of volume times pressure of the parts that
/// are centred in the region, over the region's volume.
double solid_mean_stress(const Region& region, std::span<const PressedVolume> solid);

} // namespace mpfem
