#pragma once
// One state of the grains: a snapshot of a run, or a meshed packing before any run.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "postproc/run_data/tool_geometry.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

/// A named number per tet or per node.
struct Field {
  std::string name, unit;
  std::vector<float> values;
};

/// The grains at one time: nodes, tets and fields.
struct Snapshot {
  std::string name;                                       ///< "0003", "packing"
  double time = 0, relative_density = 0, mean_stress = 0; ///< s, 1, MPa
  std::array<double, 3> box_low{}, box_high{};            ///< mm
  std::vector<float> node;                                ///< [nodes * 3], mm
  std::vector<std::int32_t> tet;                          ///< [tets * 4]
  std::vector<std::int32_t> tet_grain;                    ///< [tets]
  std::vector<Field> tet_fields, node_fields;
  std::vector<float> velocity;     ///< [nodes * 3], mm/s; empty for a packing
  std::vector<ToolGeometry> tools; ///< rigid tools that are in place

  std::size_t nodes() const { return node.size() / 3; }
  std::size_t tets() const { return tet.size() / 4; }
  /// Throws InputError that lists the fields where there is none of this name.
  const Field& tet_field(const std::string& field_name) const;
  /// Throws InputError where there is none of this name.
  const Field& node_field(const std::string& field_name) const;
};

/// Reads snapshot `number` of a run file: 0 the first, -1 the last, other negative numbers from the end. Throws
/// InputError.
Snapshot read_snapshot(const schema::FileReader& file, int number);
/// The mesh of a packing file. Throws InputError where it is not meshed.
Snapshot read_packing_snapshot(const std::string& path);

/// The name of snapshot `number` of a run file. Throws InputError where there is none.
std::string snapshot_name(const schema::FileReader& file, int number);

/// [grains + 1]: the first node of each grain, then `nodes`. Throws InputError if the file's do not rise so.
std::vector<std::int32_t> grain_node_offsets(const schema::FileReader& file, std::size_t nodes);
/// The grain of each node or tetrahedron, from offsets of grains that rise from 0 to the number of these.
std::vector<std::int32_t> grain_of_each(const std::vector<std::int32_t>& offset);

} // namespace mpfem
