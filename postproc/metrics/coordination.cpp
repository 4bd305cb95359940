#include "postproc/metrics/coordination.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/snapshot_window.hpp"

namespace mpfem {

namespace {

std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

/// Mean over the counted grains, 0 without grains, and half of its 95 % interval.
Ratio mean_of(const std::vector<double>& contacts, const std::vector<bool>& counted) {
  std::vector<double> values, ones;
  for (std::size_t grain = 0; grain < contacts.size(); ++grain)
    if (counted[grain]) values.push_back(contacts[grain]);
  ones.assign(values.size(), 1.0);
  return values.empty() ? Ratio() : ratio_of_sums(values, ones);
}

} // namespace

std::vector<double> contacts_of(const ContactGraph& graph, const std::vector<bool>& counted, bool with_walls) {
  std::vector<double> contacts(graph.walls.size(), 0.0);
  for (const ContactGraph::Pair& pair : graph.pairs)
    if (counted[at(pair.grains[0])] && counted[at(pair.grains[1])])
      for (const std::int32_t grain : pair.grains) contacts[at(grain)] += 1;
  for (std::size_t grain = 0; with_walls && grain < contacts.size(); ++grain)
    if (counted[grain]) contacts[grain] += graph.walls[grain];
  return contacts;
}

std::vector<bool> find_rattlers(const ContactGraph& graph, int fewest) {
  std::vector<bool> held(graph.walls.size(), false), kept(graph.walls.size(), true);
  for (const ContactGraph::Pair& pair : graph.pairs)
    if (pair.bonded) held[at(pair.grains[0])] = held[at(pair.grains[1])] = true;
  for (bool found = true; found;) {
    found = false;
    const std::vector<double> contacts = contacts_of(graph, kept, true);
    for (std::size_t grain = 0; grain < kept.size(); ++grain)
      if (kept[grain] && !held[grain] && contacts[grain] < fewest) {
        kept[grain] = false;
        found = true;
      }
  }
  kept.flip();
  return kept;
}

ContactGraph contact_graph(const schema::FileReader& file, int snapshot) {
  namespace run = schema::run;
  const std::string name = snapshot_name(file, snapshot);
  if (!file.has(run::snapshots_wall_force, name))
    throw InputError(fmt::format("{}: snapshot {} has no forces of walls, allowed: a run of this version",
                                 one_line(file.path()), name));
  const auto grains = file.read(run::snapshots_pair_grains, name);
  const auto area = file.read(run::snapshots_pair_area, name);
  const bool bonds = file.has(run::snapshots_pair_bonded_area, name);
  const auto bonded = bonds ? file.read(run::snapshots_pair_bonded_area, name) : std::vector<double>(area.size(), 0.0);
  const auto push = file.read(run::snapshots_wall_force, name);
  ContactGraph graph;
  for (std::size_t pair = 0; pair < area.size(); ++pair)
    if (area[pair] > 0 || bonded.at(pair) > 0)
      graph.pairs.push_back({{grains.at(2 * pair), grains.at(2 * pair + 1)}, bonded[pair] > 0});
  for (std::size_t i = 0; i < push.size(); i += 6)
    graph.walls.push_back(static_cast<int>(std::count_if(push.begin() + static_cast<std::ptrdiff_t>(i),
                                                         push.begin() + static_cast<std::ptrdiff_t>(i + 6),
                                                         [](double force) { return force > 0; })));
  return graph;
}

Measurement measure_coordination(const schema::FileReader& file, int snapshot, int fewest) {
  const ContactGraph graph = contact_graph(file, snapshot);
  const std::vector<bool> all(graph.walls.size(), true);
  std::vector<bool> backbone = find_rattlers(graph, fewest);
  const auto rattlers = std::count(backbone.begin(), backbone.end(), true);
  backbone.flip();
  const auto mean = [&](const std::vector<bool>& counted, bool with_walls) {
    return mean_of(contacts_of(graph, counted, with_walls), counted);
  };
  Measurement m;
  m.metric = "coordination";
  const Ratio value = mean(backbone, true);
  m.value = value.value;
  m.uncertainty = value.half_width;
  m.uncertainty_meaning = "half of the 95 % interval of a mean over the grains, taken as independent";
  m.method = fmt::format("mean contacts, walls included, without rattlers, grains with fewer than {} "
                         "contacts and no intact bond, removed until none is left",
                         fewest);
  m.snapshot = snapshot_window(file, snapshot);
  const auto add = [&](const std::string& key, Ratio ratio) {
    m.details[key] = ratio.value;
    m.details[key + "_uncertainty"] = ratio.half_width;
  };
  add("coordination_number", mean(all, false));
  add("coordination_number_with_walls", mean(all, true));
  add("coordination_number_without_rattlers", mean(backbone, false));
  add("coordination_number_with_walls_without_rattlers", value);
  m.details["grains"] = graph.walls.size();
  m.details["rattlers"] = rattlers;
  m.details["contacts_between_grains"] = graph.pairs.size();
  m.details["contacts_with_walls"] = std::accumulate(graph.walls.begin(), graph.walls.end(), 0);
  m.brief = fmt::format("without rattlers ({} of {} grains), with walls; {:.3g} between grains only, with rattlers",
                        rattlers, graph.walls.size(), m.details["coordination_number"].get<double>());
  return m;
}

} // namespace mpfem
