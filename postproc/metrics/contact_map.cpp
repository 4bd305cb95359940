#include "postproc/metrics/contact_map.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/files/text_file.hpp"
#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

/// Row of the pair in pair_grains. Throws InputError that lists the grains which the first one touches.
std::size_t row_of_pair(const std::vector<std::int32_t>& pair_grains, std::pair<int, int> grains,
                        const std::string& path, const std::string& snapshot) {
  std::vector<std::int32_t> neighbours;
  for (std::size_t row = 0; 2 * row < pair_grains.size(); ++row) {
    const std::int32_t a = pair_grains[2 * row], b = pair_grains[2 * row + 1];
    if (a == grains.first && b == grains.second) return row;
    if (a == grains.first || b == grains.first) neighbours.push_back(a == grains.first ? b : a);
  }
  throw InputError(fmt::format("{}: grains {} and {} are not in contact in snapshot {}; grain {} touches {}", path,
                               grains.first, grains.second, snapshot, grains.first,
                               neighbours.empty() ? "no other" : fmt::format("{}", fmt::join(neighbours, ", "))));
}

/// The nodes of a snapshot, by grain.
struct GrainNodes {
  std::vector<std::int32_t> offset; ///< [grains + 1]
  std::vector<float> node;          ///< [nodes * 3], mm
  int grains() const { return static_cast<int>(offset.size()) - 1; }
  bool belongs_to(std::int32_t n, std::int32_t grain) const {
    const auto g = static_cast<std::size_t>(grain);
    return n >= offset[g] && n < offset[g + 1];
  }
  std::array<double, 3> position(std::int32_t n) const {
    const auto i = 3 * static_cast<std::size_t>(n);
    return {static_cast<double>(node[i]), static_cast<double>(node[i + 1]), static_cast<double>(node[i + 2])};
  }
};

/// Throws InputError where the offsets do not fit the nodes.
GrainNodes read_nodes(const schema::FileReader& file, const std::string& snapshot) {
  std::vector<float> node = file.read(run::snapshots_node, snapshot);
  std::vector<std::int32_t> offset = grain_node_offsets(file, node.size() / 3);
  return {std::move(offset), std::move(node)};
}

/// Mean position of a grain's nodes, mm.
std::array<double, 3> centre(const GrainNodes& nodes, std::int32_t grain) {
  std::array<double, 3> sum{};
  const auto g = static_cast<std::size_t>(grain);
  const auto first = static_cast<std::size_t>(nodes.offset[g]), end = static_cast<std::size_t>(nodes.offset[g + 1]);
  for (std::size_t n = first; n < end; ++n)
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += static_cast<double>(nodes.node[3 * n + k]) / static_cast<double>(end - first);
  return sum;
}

/// The smaller number first. Throws InputError where they are not two different grains of 0 … count - 1.
std::pair<std::int32_t, std::int32_t> in_order(std::pair<int, int> grains, int count, const std::string& path) {
  if (grains.first > grains.second) std::swap(grains.first, grains.second);
  if (grains.first < 0 || grains.second >= count || grains.first == grains.second)
    throw InputError(fmt::format("{}: --pair names the grains {} and {}, allowed: two different ones of 0 … {}", path,
                                 grains.first, grains.second, count - 1));
  return grains;
}

void need_bonds(const schema::FileReader& file, const std::string& snapshot) {
  for (const schema::DatasetDescription& line :
       {schema::DatasetDescription(run::snapshots_bond_node), schema::DatasetDescription(run::snapshots_pair_damage)})
    if (!file.has(line, snapshot))
      throw InputError(
          fmt::format("{}: snapshot {} has no bonds; --pair needs a run with bonds", one_line(file.path()), snapshot));
}

/// Adds what the snapshot holds for the pair as a whole.
void add_pair(ContactMap& map, const schema::FileReader& file) {
  const std::string& name = map.snapshot;
  const std::size_t row =
      row_of_pair(file.read(run::snapshots_pair_grains, name), map.grains, one_line(file.path()), name);
  map.relative_density = file.read_scalar(run::snapshots_relative_density, name);
  map.mean_stress = file.read_scalar(run::snapshots_mean_stress, name);
  const auto number = [&](const schema::Dataset<double, 1>& dataset) { return file.read(dataset, name).at(row); };
  const auto force = file.read(run::snapshots_pair_force, name);
  for (std::size_t k = 0; k < 3; ++k) map.force[k] = force.at(3 * row + k);
  map.area = number(run::snapshots_pair_area);
  map.bonded_area = number(run::snapshots_pair_bonded_area);
  map.damage = number(run::snapshots_pair_damage);
  map.bond_energy = number(run::snapshots_pair_bond_energy);
  map.damage_dissipation = number(run::snapshots_pair_damage_dissipation);
}

/// The bonds between two grains, in the file's order; u and v are not yet set.
std::vector<ContactBond> read_bonds_between(std::pair<std::int32_t, std::int32_t> grains, const GrainNodes& nodes,
                                            const schema::FileReader& file, const std::string& name) {
  const auto bond_node = file.read(run::snapshots_bond_node, name),
             bond_grain = file.read(run::snapshots_bond_grain, name);
  const auto damage = file.read(run::snapshots_bond_damage, name),
             separation = file.read(run::snapshots_bond_separation, name);
  const auto area = file.read(run::snapshots_bond_area, name);
  std::vector<ContactBond> bonds;
  for (std::size_t b = 0; b < bond_node.size(); ++b) {
    const std::int32_t n = bond_node[b], other = bond_grain.at(b);
    const bool of_first = other == grains.second && nodes.belongs_to(n, grains.first);
    if (!of_first && !(other == grains.first && nodes.belongs_to(n, grains.second))) continue;
    ContactBond bond;
    bond.node = n;
    bond.grain = of_first ? grains.first : grains.second;
    bond.x = nodes.position(n);
    bond.damage = static_cast<double>(damage.at(b));
    bond.area = area.at(b);
    bond.opening = static_cast<double>(separation.at(2 * b));
    bond.sliding = static_cast<double>(separation.at(2 * b + 1));
    bonds.push_back(bond);
  }
  return bonds;
}

ContactPlane plane_of(const ContactMap& map, const GrainNodes& nodes) {
  std::vector<AreaPoint> points;
  for (const ContactBond& bond : map.bonds) points.push_back({bond.x, bond.area});
  const auto from = centre(nodes, map.grains.first), to = centre(nodes, map.grains.second);
  return contact_plane(points, map.force, {to[0] - from[0], to[1] - from[1], to[2] - from[2]});
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace

ContactMap contact_map(const schema::FileReader& file, int snapshot, std::pair<int, int> grains) {
  ContactMap map;
  map.snapshot = snapshot_name(file, snapshot);
  const GrainNodes nodes = read_nodes(file, map.snapshot);
  map.grains = in_order(grains, nodes.grains(), one_line(file.path()));
  need_bonds(file, map.snapshot);
  add_pair(map, file);
  map.bonds = read_bonds_between(map.grains, nodes, file, map.snapshot);
  map.plane = plane_of(map, nodes);
  for (ContactBond& bond : map.bonds) {
    const auto position = in_plane(map.plane, bond.x);
    bond.u = position[0];
    bond.v = position[1];
  }
  return map;
}

nlohmann::ordered_json to_json(const ContactMap& map) {
  constexpr const char* source[] = {"pair force", "principal axes of the bonds", "centres of the grains"};
  const double pushing = -dot(map.force, map.plane.normal); // the second grain pushes the first against the normal
  const auto unbroken = std::count_if(map.bonds.begin(), map.bonds.end(), [](const auto& b) { return b.damage < 1; });
  nlohmann::ordered_json json = {{"snapshot", map.snapshot},
                                 {"relative_density", map.relative_density},
                                 {"mean_stress_MPa", map.mean_stress},
                                 {"grains", {map.grains.first, map.grains.second}},
                                 {"force_on_first_N", map.force},
                                 {"normal_force_N", pushing},
                                 {"normal", map.plane.normal},
                                 {"normal_from", source[static_cast<std::size_t>(map.plane.from)]},
                                 {"area_mm2", map.area},
                                 {"bonded_area_mm2", map.bonded_area},
                                 {"mean_damage", nullptr},
                                 {"bond_energy_mJ", map.bond_energy},
                                 {"damage_dissipation_mJ", map.damage_dissipation},
                                 {"bonds", map.bonds.size()},
                                 {"unbroken_bonds", unbroken},
                                 {"centroid_mm", nullptr},
                                 {"u_direction", map.plane.u},
                                 {"v_direction", map.plane.v}};
  if (map.damage >= 0) json["mean_damage"] = map.damage;
  if (!map.bonds.empty()) json["centroid_mm"] = map.plane.origin;
  return json;
}

std::string contact_points_csv(const ContactMap& map) {
  std::vector<Column> columns = {{"node", "1", {}},    {"grain", "1", {}},    {"x", "mm", {}},      {"y", "mm", {}},
                                 {"z", "mm", {}},      {"u", "mm", {}},       {"v", "mm", {}},      {"damage", "1", {}},
                                 {"area", "mm^2", {}}, {"opening", "mm", {}}, {"sliding", "mm", {}}};
  for (const ContactBond& b : map.bonds) {
    const double row[] = {static_cast<double>(b.node),
                          static_cast<double>(b.grain),
                          b.x[0],
                          b.x[1],
                          b.x[2],
                          b.u,
                          b.v,
                          b.damage,
                          b.area,
                          b.opening,
                          b.sliding};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
  }
  return csv_text(columns);
}

} // namespace mpfem
