#include "postproc/run_data/bond_table.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

namespace {

constexpr std::size_t law_columns = 6, fracture_energy_column = 2; // of /snapshots/*/bond_laws

/// The grain of a node; `offset` holds the first node of each grain, then the number of nodes.
std::int32_t grain_of_node(const std::vector<std::int32_t>& offset, std::int32_t node) {
  return static_cast<std::int32_t>(std::upper_bound(offset.begin(), offset.end(), node) - offset.begin()) - 1;
}

/// Refuses numbers of nodes or grains, in /snapshots/*/`dataset`, that are not 0 … count - 1.
void check_numbers(const std::vector<std::int32_t>& numbers, std::size_t count, const char* dataset, const char* what,
                   const std::string& path) {
  for (const std::int32_t number : numbers)
    if (number < 0 || static_cast<std::size_t>(number) >= count)
      throw InputError(fmt::format("{}: {} names {} {}, allowed: 0 … {}", path, dataset, what, number,
                                   static_cast<std::int64_t>(count) - 1));
}

/// G^c of each bond (N/mm): by its law where the file has bond laws, otherwise from the scenario.
std::vector<std::optional<double>> fracture_energies(const schema::FileReader& file, const std::string& name,
                                                     std::size_t bonds) {
  namespace run = schema::run;
  if (!file.has(run::snapshots_bond_law, name))
    return std::vector<std::optional<double>>(bonds, scenario_facts(file).fracture_energy);
  const auto law = file.read(run::snapshots_bond_law, name);
  const auto laws = file.read(run::snapshots_bond_laws, name);
  std::vector<std::optional<double>> energy;
  for (const std::int32_t number : law)
    energy.emplace_back(laws.at(law_columns * static_cast<std::size_t>(number) + fracture_energy_column));
  return energy;
}

} // namespace

std::vector<BondRow> read_bond_table(const schema::FileReader& file, int snapshot) {
  namespace run = schema::run;
  const std::string name = snapshot_name(file, snapshot), path = one_line(file.path());
  if (!file.has(run::snapshots_bond_node, name))
    throw InputError(fmt::format("{}: snapshot {} has no bonds, allowed: a run with bonds", path, name));
  const auto node = file.read(run::snapshots_bond_node, name), grain = file.read(run::snapshots_bond_grain, name);
  const auto damage = file.read(run::snapshots_bond_damage, name);
  const auto area = file.read(run::snapshots_bond_area, name);
  const std::size_t nodes = file.rows(run::snapshots_node, name);
  const auto offset = grain_node_offsets(file, nodes);
  check_numbers(node, nodes, "bond_node", "node", path);
  check_numbers(grain, offset.size() - 1, "bond_grain", "grain", path);
  const bool told = file.has(run::snapshots_bond_dissipation, name);
  const auto dissipation = told ? file.read(run::snapshots_bond_dissipation, name) : std::vector<double>();
  const auto fracture_energy = fracture_energies(file, name, node.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> number_of_pair;
  std::vector<BondRow> bonds;
  for (std::size_t b = 0; b < node.size(); ++b) {
    if (!(area.at(b) > 0)) continue;
    const auto pair = std::minmax({grain_of_node(offset, node[b]), grain.at(b)});
    const std::size_t number = number_of_pair.try_emplace(pair, number_of_pair.size()).first->second;
    bonds.push_back({node[b], grain[b], number, area[b], static_cast<double>(damage.at(b)), fracture_energy.at(b),
                     told ? std::optional(dissipation.at(b)) : std::nullopt});
  }
  if (bonds.empty())
    throw InputError(fmt::format("{}: no bond was formed by snapshot {}, allowed: a later --snapshot", path, name));
  return bonds;
}

std::size_t pairs_of(const std::vector<BondRow>& bonds) {
  std::size_t pairs = 0;
  for (const BondRow& bond : bonds) pairs = std::max(pairs, bond.pair + 1);
  return pairs;
}

} // namespace mpfem
