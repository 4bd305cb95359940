#pragma once
// Solid fraction in a die over radius and height.

#include <string>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// How the die is divided into cells.
struct DensityMapRule {
  int rings = 4;  ///< of equal width, from the axis to the wall
  int layers = 4; ///< of equal height, from the lower punch to the upper
};

/// A ring of one layer.
struct DensityCell {
  double inner = 0, outer = 0; ///< mm, from the axis
  double low = 0, high = 0;    ///< mm, from the lower punch
  double density = 0;          ///< solid fraction from current volumes
  double uncertainty = 0;      ///< half of the 95 % interval of the mean over sectors
};

/// Solid fraction of every cell and of the whole.
struct DensityMap {
  std::string snapshot;
  double radius = 0, height = 0; ///< mm, of the container
  double density = 0;            ///< solid fraction of the whole, from current volumes
  DensityMapRule rule;
  std::vector<DensityCell> cells; ///< layer by layer from below, in each from the axis outwards
};

/// Map of a container along z: the cylinder that fills the snapshot's box. Solid beyond its faces (penalty contact lets
/// grains overlap with tools) counts for the adjacent cell. Throws InputError where the box is not square across z.
DensityMap density_map(const Snapshot& snapshot, const DensityMapRule& rule);

/// One row per cell.
std::string density_map_csv(const DensityMap& map);

/// Writes the PNG: radius to the right, height upwards. Throws SimulationError where gnuplot is missing or fails,
/// StorageError where the file cannot be written.
void write_density_picture(const std::string& path, const DensityMap& map, const std::string& title, int pixels);

} // namespace mpfem
