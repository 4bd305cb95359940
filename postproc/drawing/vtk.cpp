#include "postproc/drawing/vtk.hpp"

#include <algorithm>
#include <cstring>
#include <deque>
#include <filesystem>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/progress.hpp"
#include "postproc/drawing/tool_surface.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/run_data/tet_geometry.hpp"

namespace mpfem {

namespace {

/// XML allows no "--" within a comment, but a tool's name may have it.
std::string within_comment(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '-' && result.ends_with('-')) result += ' ';
    result += c;
  }
  return result;
}

/// Collects arrays for the appended section, with their offsets.
class Appended {
public:
  /// `expected`: bytes to reserve, so that hundreds of MB are not copied while they grow.
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
  for (const Field& field : s.node_fields)
    xml += appended.array(name_with_unit(field.name, field.unit), "Float32", 1, Floats(field.values));
  xml += "      </PointData>\n      <CellData>\n";
  for (const Field& field : s.tet_fields)
    if (field.name != "grain")
      xml += appended.array(name_with_unit(field.name, field.unit), "Float32", 1, Floats(field.values));
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
  for (std::size_t i = 0; i < names.size(); ++i)
    xml += fmt::format("{}{} {}", i > 0 ? ", " : "", i, within_comment(names[i]));
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

namespace {

/// A .vtp file of points with vertices or lines over them, and arrays of numbers or vectors for these cells.
class PointFile {
public:
  PointFile(const Snapshot& snapshot, const std::string& comment) : snapshot_(snapshot), comment_(comment) {}

  void point(const Eigen::Vector3d& x) {
    for (const double xk : x) position_.push_back(static_cast<float>(xk));
  }
  std::vector<float>& array(const std::string& name, int components = 1) {
    arrays_.push_back({name, components, {}});
    return arrays_.back().values;
  }
  /// `points_each`: 1 for vertices, 2 for lines; each takes the next points in order.
  std::string text(int points_each) const {
    const std::size_t points = position_.size() / 3, cells = points / static_cast<std::size_t>(points_each);
    std::vector<std::int32_t> connectivity(points), ends;
    std::iota(connectivity.begin(), connectivity.end(), 0);
    for (std::size_t c = 1; c <= cells; ++c) ends.push_back(points_each * static_cast<std::int32_t>(c));
    Appended appended(64 * points + 1024);
    const char* kind = points_each == 1 ? "Verts" : "Lines";
    std::string xml = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "  <!-- {} -->\n  <PolyData>\n    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" "
        "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n    </FieldData>\n"
        "    <Piece NumberOfPoints=\"{}\" NumberOf{}=\"{}\">\n      <Points>\n",
        comment_, snapshot_.time, points, kind, cells);
    xml += appended.array("position [mm]", "Float32", 3, std::span<const float>(position_));
    xml += fmt::format("      </Points>\n      <{}>\n", kind);
    xml += appended.array("connectivity", "Int32", 1, std::span<const std::int32_t>(connectivity));
    xml += appended.array("offsets", "Int32", 1, std::span<const std::int32_t>(ends));
    xml += fmt::format("      </{}>\n      <CellData>\n", kind);
    for (const Array& array : arrays_)
      xml += appended.array(array.name, "Float32", array.components, std::span<const float>(array.values));
    xml += "      </CellData>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
    return xml.append(appended.bytes()).append("\n  </AppendedData>\n</VTKFile>\n");
  }

private:
  struct Array {
    std::string name;
    int components;
    std::vector<float> values;
  };
  const Snapshot& snapshot_;
  std::string comment_;
  std::vector<float> position_;
  std::deque<Array> arrays_; // a deque, so that references to values stay valid
};

} // namespace

std::string grains_vtp_text(const Snapshot& s) {
  PointFile file(s, "grains: centres, volumes, and means by volume; mm, MPa");
  const std::vector<Eigen::Vector3d> centre = grain_centres(s);
  const std::size_t grains = centre.size();
  std::vector<double> volume(grains, 0.0);
  std::vector<std::vector<double>> sum(s.tet_fields.size(), std::vector<double>(grains, 0.0));
  for (std::size_t t = 0; t < s.tets(); ++t) {
    const auto g = static_cast<std::size_t>(s.tet_grain[t]);
    const double of_tet = std::abs(tet_geometry(s, t).volume);
    volume[g] += of_tet;
    for (std::size_t f = 0; f < sum.size(); ++f) sum[f][g] += of_tet * static_cast<double>(s.tet_fields[f].values[t]);
  }
  for (const Eigen::Vector3d& x : centre) file.point(x);
  std::vector<float>& number = file.array("grain");
  for (std::size_t g = 0; g < grains; ++g) number.push_back(static_cast<float>(g));
  std::vector<float>& volumes = file.array("volume [mm^3]");
  for (const double v : volume) volumes.push_back(static_cast<float>(v));
  for (std::size_t f = 0; f < sum.size(); ++f) {
    if (s.tet_fields[f].name == "grain") continue;
    std::vector<float>& mean = file.array(name_with_unit(s.tet_fields[f].name, s.tet_fields[f].unit));
    for (std::size_t g = 0; g < grains; ++g)
      mean.push_back(static_cast<float>(volume[g] > 0 ? sum[f][g] / volume[g] : 0));
  }
  return file.text(1);
}

std::string contacts_vtp_text(const schema::FileReader& run_file, const Snapshot& s) {
  namespace run = schema::run;
  PointFile file(s, "pairs of grains in contact or bonded, from centre to centre; mm, N, mJ; damage -1: never bonded");
  const std::vector<Eigen::Vector3d> centre = grain_centres(s);
  const auto grains = run_file.read(run::snapshots_pair_grains, s.name);
  for (const std::int32_t grain : grains) file.point(centre.at(static_cast<std::size_t>(grain)));
  for (const std::size_t side : {0U, 1U}) {
    std::vector<float>& number = file.array(side == 0 ? "first_grain" : "second_grain");
    for (std::size_t i = side; i < grains.size(); i += 2) number.push_back(static_cast<float>(grains[i]));
  }
  const auto add = [&](const auto& dataset, const char* name, int components = 1) {
    if (!run_file.has(dataset, s.name)) return;
    std::vector<float>& values = file.array(name, components);
    for (const double value : run_file.read(dataset, s.name)) values.push_back(static_cast<float>(value));
  };
  add(run::snapshots_pair_force, "force [N]", 3);
  add(run::snapshots_pair_area, "area [mm^2]");
  add(run::snapshots_pair_bonded_area, "bonded_area [mm^2]");
  add(run::snapshots_pair_damage, "damage");
  add(run::snapshots_pair_bond_energy, "bond_energy [mJ]");
  add(run::snapshots_pair_damage_dissipation, "damage_dissipation [mJ]");
  return file.text(2);
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
  snapshot_name(file, 0); // throws for a run without snapshots
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw StorageError(fmt::format("{}: cannot be made: {}", folder, error.message()));
  Progress progress("postproc", quiet);
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    files.push_back((std::filesystem::path(folder) / name).string());
    refuse_overwriting("--output", files.back(), file.path());
    write_file(files.back(), text);
  };
  // If all tools are withdrawn, an empty file is written: without one, ParaView would keep showing the last.
  const std::vector<std::string> tools = file.members(schema::run::tools_shape);
  std::vector<Frame> frames, tool_frames, grain_frames, contact_frames;
  for (int i = 0; i < count; ++i) {
    const Snapshot snapshot = read_snapshot(file, i);
    frames.push_back({snapshot.name + ".vtu", snapshot.time});
    write(frames.back().file, vtu_text(snapshot));
    grain_frames.push_back({snapshot.name + "-grains.vtp", snapshot.time});
    write(grain_frames.back().file, grains_vtp_text(snapshot));
    contact_frames.push_back({snapshot.name + "-contacts.vtp", snapshot.time});
    write(contact_frames.back().file, contacts_vtp_text(file, snapshot));
    if (!tools.empty()) {
      tool_frames.push_back({snapshot.name + "-tools.vtp", snapshot.time});
      write(tool_frames.back().file, tools_vtp_text(snapshot, tools));
    }
    progress.update((i + 1.0) / count, frames.back().file);
  }
  write("grains.pvd", pvd_text(grain_frames));
  write("contacts.pvd", pvd_text(contact_frames));
  if (!tools.empty()) write("tools.pvd", pvd_text(tool_frames));
  write("run.pvd", pvd_text(frames));
  progress.finish(files.back());
  return files;
}

} // namespace mpfem
