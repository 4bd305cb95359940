#pragma once
// The TOML file that describes a packing: PACK.toml of `pack-gen spheres`.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/table_reader.hpp"
#include "pack-gen/packing.hpp"
#include "pack-gen/size_distribution.hpp"

namespace mpfem {

/// What is to be packed, in mm.
struct PackingDescription {
  int count = 0;
  double relative_density = 0;
  PackingContainer container;          ///< a box, a cylinder, or a surface
  std::optional<StlSize> surface_size; ///< of a surface, for messages
  double smallest_gap = 0;
  std::uint64_t seed = 1;
  double size_scale_tolerance = 0; ///< largest distance from 1 of the factor on sizes that fits count to density
  std::unique_ptr<SizeDistribution> distribution;
  std::vector<double> table_diameters; ///< mm, of a distribution of kind table; empty for others
  KeyPlaces places;                    ///< of its keys
  std::string text;                    ///< the file's text with the assignments
  std::vector<std::string> files;      ///< that it names and that were read: of sizes, of a surface
};

/// Reads a description; keys and defaults are in packing_description.cpp only. `without_box`: its key `box` is ignored,
/// as the command line gives another container. Throws InputError.
PackingDescription read_packing_description(const TomlDocument& document, bool without_box = false);

/// Radii for a description.
struct DrawnSizes {
  std::vector<double> radius; ///< mm
  double scale = 1;           ///< factor on the sizes of the distribution
};
/// The distribution's quantiles, scaled so that the spheres have the relative density of the description. Throws
/// InputError if the scale is farther from 1 than the description allows.
DrawnSizes draw_sizes(const PackingDescription& description);

} // namespace mpfem
