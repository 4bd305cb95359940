#include "postproc/vtk.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/progress.hpp"
#include "postproc/text_file.hpp"
#include "postproc/tool_surface.hpp"

namespace mpfem {

namespace {

/// Collects arrays for the appended section and gives their offsets.
class Appended {
public:
  /// `expected`: bytes to set aside, so that hundreds of MB are not moved about as they grow.
  explicit Appended(std::size_t expected) { bytes_.reserve(expected); }
  /// A DataArray element that refers to the appended bytes.
  template <class T>
  std::string array(std::string_view name, std::string_view type, int components, std::span<const T> values) {
    const std::string element =
        fmt::format(R"(        <DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)"
                    "\n",
                    type, name, components, bytes_.size());
    const std::uint64_t size = values.size_bytes();
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof size + size);
    std::memcpy(bytes_.data() + at, &size, sizeof size);
    if (size > 0) std::memcpy(bytes_.data() + at + sizeof size, values.data(), size);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

private:
  std::string bytes_;
};

std::string with_unit(const Field& field) {
  return field.unit == "1" ? field.name : fmt::format("{} [{}]", field.name, field.unit);
}

} // namespace

std::string vtu_text(const Snapshot& s) {
  using Floats = std::span<const float>;
  constexpr std::uint8_t vtk_tetra = 10;
  const std::vector<std::uint8_t> types(s.tets(), vtk_tetra);
  std::vector<std::int64_t> ends(s.tets());
  for (std::size_t t = 0; t < s.tets(); ++t) ends[t] = 4 * static_cast<std::int64_t>(t + 1);

  constexpr std::size_t bytes_per_node = 28, bytes_per_tet = 16 + 8 + 1 + 4 + 4 * 3; // as written below
  Appended appended(bytes_per_node * s.nodes() + bytes_per_tet * s.tets() + 1024);
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <!-- units: mm, N, MPa, s; relative density and time of this state in FieldData -->\n"
      "  <UnstructuredGrid>\n    <FieldData>\n";
  const double time[] = {s.time}, density[] = {s.relative_density};
  xml +=
      fmt::format(R"(      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)"
                  "\n",
                  time[0]);
  xml += fmt::format(
      R"(      <DataArray type="Float64" Name="relative_density" NumberOfTuples="1" format="ascii">{}</DataArray>)"
      "\n",
      density[0]);
  xml += fmt::format("    </FieldData>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <Points>\n",
                     s.nodes(), s.tets());
  xml += appended.array("position [mm]", "Float32", 3, Floats(s.node));
  xml += "      </Points>\n      <Cells>\n";
  xml += appended.array("connectivity", "Int32", 1, std::span<const std::int32_t>(s.tet));
  xml += appended.array("offsets", "Int64", 1, std::span<const std::int64_t>(ends));
  xml += appended.array("types", "UInt8", 1, std::span<const std::uint8_t>(types));
  xml += "      </Cells>\n      <PointData>\n";
  if (!s.velocity.empty()) xml += appended.array("velocity [mm/s]", "Float32", 3, Floats(s.velocity));
  for (const Field& field : s.node_fields) xml += appended.array(with_unit(field), "Float32", 1, Floats(field.values));
  xml += "      </PointData>\n      <CellData>\n";
  for (const Field& field : s.tet_fields)
    if (field.name != "grain") xml += appended.array(with_unit(field), "Float32", 1, Floats(field.values));
  xml += appended.array("grain", "Int32", 1, std::span<const std::int32_t>(s.tet_grain));
  xml += "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  constexpr std::string_view end = "\n  </AppendedData>\n</VTKFile>\n";
  xml.reserve(xml.size() + appended.bytes().size() + end.size());
  return xml.append(appended.bytes()).append(end);
}

std::string tools_vtp_text(const Snapshot& s, const std::vector<std::string>& names) {
  const DrawnExtent extent = drawn_extent(s);
  const std::vector<ToolBody> bodies = tool_bodies(s, extent);
  std::vector<float> position, normal;
  std::vector<std::int32_t> connectivity, ends, tool;
  for (const SolidTriangle& t : tool_surface(bodies, extent, {})) {
    for (const SolidVertex& vertex : t.corner) {
      connectivity.push_back(static_cast<std::int32_t>(connectivity.size()));
      for (const double x : vertex.position) position.push_back(static_cast<float>(x));
      for (const double x : vertex.normal) normal.push_back(static_cast<float>(x));
    }
    ends.push_back(static_cast<std::int32_t>(connectivity.size()));
    const auto found = std::find(names.begin(), names.end(), bodies[static_cast<std::size_t>(t.grain)].name);
    tool.push_back(static_cast<std::int32_t>(found - names.begin()));
  }
  using Floats = std::span<const float>;
  using Integers = std::span<const std::int32_t>;
  Appended appended(8 * sizeof(float) * position.size() + 1024);
  std::string xml = "<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
                    "  <!-- mm; tools by number: ";
  for (std::size_t i = 0; i < names.size(); ++i) xml += fmt::format("{}{} {}", i > 0 ? ", " : "", i, names[i]);
  xml += fmt::format(" -->\n  <PolyData>\n    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" "
                     "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n    </FieldData>\n"
                     "    <Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n      <Points>\n",
                     s.time, connectivity.size(), tool.size());
  xml += appended.array("position [mm]", "Float32", 3, Floats(position));
  xml += "      </Points>\n      <Polys>\n";
  xml += appended.array("connectivity", "Int32", 1, Integers(connectivity));
  xml += appended.array("offsets", "Int32", 1, Integers(ends));
  xml += "      </Polys>\n      <PointData Normals=\"normal\">\n";
  xml += appended.array("normal", "Float32", 3, Floats(normal));
  xml += "      </PointData>\n      <CellData>\n";
  xml += appended.array("tool", "Int32", 1, Integers(tool));
  xml += "      </CellData>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
  return xml.append(appended.bytes()).append("\n  </AppendedData>\n</VTKFile>\n");
}

std::string pvd_text(const std::vector<Frame>& frames) {
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                    "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const Frame& frame : frames)
    xml += fmt::format(R"(    <DataSet timestep="{}" part="0" file="{}"/>)"
                       "\n",
                       frame.time, frame.file);
  return xml + "  </Collection>\n</VTKFile>\n";
}

std::vector<std::string> write_run_as_vtk(const schema::FileReader& file, const std::string& folder, bool quiet) {
  const int count = static_cast<int>(file.snapshots().size());
  snapshot_name(file, 0); // refuses a run without snapshots
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw StorageError(fmt::format("{}: cannot be made: {}", folder, error.message()));
  Progress progress("postproc", quiet);
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    files.push_back((std::filesystem::path(folder) / name).string());
    write_file(files.back(), text);
  };
  // Where all tools are withdrawn their file is empty: without one, ParaView would go on showing the last.
  const std::vector<std::string> tools = file.members(schema::run::tools_shape);
  std::vector<Frame> frames, tool_frames;
  for (int i = 0; i < count; ++i) {
    const Snapshot snapshot = read_snapshot(file, i);
    frames.push_back({snapshot.name + ".vtu", snapshot.time});
    write(frames.back().file, vtu_text(snapshot));
    if (!tools.empty()) {
      tool_frames.push_back({snapshot.name + "-tools.vtp", snapshot.time});
      write(tool_frames.back().file, tools_vtp_text(snapshot, tools));
    }
    progress.update((i + 1.0) / count, frames.back().file);
  }
  if (!tools.empty()) write("tools.pvd", pvd_text(tool_frames));
  write("run.pvd", pvd_text(frames));
  progress.finish(files.back());
  return files;
}

} // namespace mpfem
