#pragma once
// The grains of several snapshots, small enough for a page: places and fields as whole numbers of 16 and 8 bits.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "postproc/snapshot.hpp"

namespace mpfem {

/// A field of all snapshots, from 0 (low) to 255 (high) on one scale.
struct QuantisedField {
  std::string name, unit;
  std::pair<double, double> range;
};

/// One snapshot.
struct ViewState {
  double relative_density = 0, mean_stress = 0; ///< 1, MPa
  std::array<double, 3> box_low{}, box_high{};  ///< mm
  std::vector<std::uint16_t> position;          ///< [nodes * 3], 0 … 65535 from low to high of ViewData
  std::vector<std::vector<std::uint8_t>> value; ///< of every field, [nodes]
  /// Of the triangles of rigid tools' surfaces, [corners * 3]: places from tool_low to tool_high, normals times 127.
  std::vector<std::uint16_t> tool_position;
  std::vector<std::int8_t> tool_normal;
};

struct ViewData {
  std::array<double, 3> low{}, high{};           ///< mm: what positions are fractions of; around all snapshots
  std::array<double, 3> tool_low{}, tool_high{}; ///< mm, around all tools; 0 where there are none
  std::vector<std::uint32_t> facet;              ///< [facets * 3], nodes of the surface, counter-clockwise from outside
  std::vector<std::uint32_t> tet;                ///< [tets * 4], nodes: what the page cuts
  std::vector<std::uint16_t> grain;              ///< [nodes], modulo 65536: colours repeat
  std::vector<QuantisedField> fields;            ///< von_mises, plastic_strain, pressure
  std::vector<ViewState> states;

  std::size_t nodes() const { return grain.size(); }
};

/// Fields of tets are averaged around nodes (shown_field). The upper end of a field's range is the 99.5th percentile of
/// the nodes of the snapshot where that is largest, the lower end 0 or the smallest 0.5th percentile. Throws InputError
/// where there is no snapshot.
ViewData view_data(const std::vector<Snapshot>& snapshots);

} // namespace mpfem
