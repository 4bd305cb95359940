#pragma once
// The grains of several snapshots in compact form for a page: positions and fields as whole numbers of 16 and 8 bits.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "postproc/picture/picture_scene.hpp"

namespace mpfem {

/// A field of all snapshots, from 0 (low) to 255 (high) on one scale. In a sparse field 0 means no value, and low is 1.
struct QuantisedField {
  std::string name, unit;
  std::pair<double, double> range;
  bool sparse = false;
  std::array<std::string, 2> ends{}; ///< what is written at the ends of the scale (ColourBar)
};

/// One snapshot.
struct ViewState {
  double relative_density = 0, mean_stress = 0; ///< 1, MPa
  std::array<double, 3> box_low{}, box_high{};  ///< mm
  std::vector<std::uint16_t> position;          ///< [nodes * 3], 0 … 65535 from low to high of ViewData
  std::vector<std::vector<std::uint8_t>> value; ///< [fields][nodes]
  /// Triangles of rigid tools' surfaces, [corners * 3]: positions from tool_low to tool_high, normals times 127.
  std::vector<std::uint16_t> tool_position;
  std::vector<std::int8_t> tool_normal;
  /// Rods between grains that touch, or are or were bonded.
  std::vector<std::uint16_t> rod_end;  ///< [rods * 6], both ends, scaled as `position`
  std::vector<std::uint8_t> rod_kind;  ///< [rods], RodKind
  std::vector<std::uint8_t> rod_width; ///< [rods], radius, 0 … 255 from 0 to widest_rod of ViewData
};

/// The grains of all snapshots, as the page holds them.
struct ViewData {
  std::array<double, 3> low{}, high{};           ///< mm: box of the positions, around all snapshots
  std::array<double, 3> tool_low{}, tool_high{}; ///< mm, around all tools; 0 where there are none
  std::vector<std::uint32_t> facet;              ///< [facets * 3], surface nodes, counter-clockwise from outside
  std::vector<std::uint32_t> tet;                ///< [tets * 4], nodes; the page cuts these
  std::vector<std::uint16_t> grain;              ///< [nodes], modulo 65536: colours repeat
  std::vector<QuantisedField> fields;            ///< von_mises, plastic_strain, pressure, with bonds damage
  double widest_rod = 0;                         ///< mm, radius
  std::vector<ViewState> states;

  std::size_t nodes() const { return grain.size(); }
};

/// Fields of tets are averaged around nodes (shown_field). A field's range covers those of all snapshots, each by the
/// rule of pictures (colour_range) over the grains' surfaces; for damage it is 0 … 1. `rods`: [snapshots], or empty for
/// none. Throws InputError where there is no snapshot.
ViewData view_data(const std::vector<Snapshot>& snapshots, const std::vector<std::vector<PairRod>>& rods = {});

/// Rods between grains in each snapshot: contacts and, where the run has them, bonds.
std::vector<std::vector<PairRod>> rods_of(const schema::FileReader& file, const std::vector<Snapshot>& snapshots);

} // namespace mpfem
