#include "postproc/figure/run_graph.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

namespace mpfem {

namespace {

void combine(const CaseBlock& block, std::size_t next, Case& current, std::vector<Case>& all) {
  if (next == block.values.size()) {
    all.push_back(current);
    return;
  }
  const auto& [key, list] = block.values[next];
  for (const Value& value : list) {
    current.values[key] = value;
    combine(block, next + 1, current, all);
  }
}

/// Adds the values that follow directly from those that a case has.
void add_one_link(const Figure& figure, Case& row) {
  for (const auto& [name, of_text] : figure.follows) {
    const auto value = row.values.find(name);
    const auto found = value == row.values.end() ? of_text.end() : of_text.find(value->second.text);
    if (found == of_text.end()) continue;
    for (const auto& [key, entry] : found->second)
      if (!row.lists.contains(key)) row.values[key] = entry;
  }
}

/// Adds the values that follow from others, as the fracture energy of the sample "g0.5"; a value may follow from one
/// that follows from another. Values that the case itself gives take precedence.
void add_what_follows(const Figure& figure, Case& row) {
  for (std::size_t links = 0; links < figure.follows.size(); ++links) add_one_link(figure, row);
}

/// Fills in values that are patterns of the others.
void fill_values(Case& row, const Place& place) {
  for (auto& [key, value] : row.values)
    if (!value.number && value.text.find('{') != std::string::npos)
      value = Value::of_text(filled_at(place, value.text, row.values));
}

/// The stage at whose end a run begins: the one that `from` names, or the last. `parent` is the run before it.
std::string stage_to_begin_at(const RunTemplate& run, const RunTemplate& parent, const std::string& named) {
  const std::vector<std::string> names = stage_names(parent.programme);
  if (named.empty() && names.back().empty())
    throw InputError(
        fmt::format("{}: the last stage has no name; runs that begin at its checkpoint need one", parent.programme));
  if (named.empty()) return names.back();
  if (std::find(names.begin(), names.end(), named) == names.end())
    run.place.fail(fmt::format("from: {} has no stage '{}'{}", parent.programme, named, suggestion(named, names)));
  return named;
}

Settings filled_settings(const RunTemplate& run, const Case& row) {
  Settings result;
  const auto add = [&](const Settings& settings) {
    for (const auto& [key, pattern] : settings) {
      const std::string text = filled_at(run.place, pattern, row.values);
      if (text.find_first_of("'\"$#\\\n ") != std::string::npos)
        run.place.fail(fmt::format("setting {}: found '{}', allowed: no blanks, quotes, $, # and \\", key, text));
      result.emplace_back(key, text);
    }
  };
  add(run.settings);
  for (const auto& [name, settings] : run.settings_unless_zero) {
    const auto value = row.values.find(name);
    if (value == row.values.end()) run.place.fail(fmt::format("settings_unless_zero: no case has a value '{}'", name));
    if (!(value->second.number && *value->second.number == 0)) add(settings);
  }
  return result;
}

/// The relative density after the "@" of `from`.
double density_of(const std::string& text, const Place& place) {
  double density = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), density);
  if (error != std::errc() || stop != text.data() + text.size() || !(density > 0 && density < 1.2))
    place.fail(fmt::format("from: found '@{}', allowed: a relative density", text));
  return density;
}

/// The case with the previous value in a chain's list; empty for the first value.
std::optional<Case> before_in_chain(const RunTemplate& run, const Case& row) {
  const auto list = row.lists.find(run.chain);
  if (list == row.lists.end()) run.place.fail(fmt::format("chain: no case has a list '{}'", run.chain));
  const auto at = std::find(list->second.begin(), list->second.end(), row.values.find(run.chain)->second);
  if (at == list->second.begin() || at == list->second.end()) return {};
  Case before = row;
  before.values[run.chain] = *(at - 1);
  return before;
}

/// Refuses a run's folder outside that of the results.
void refuse_outside(const std::filesystem::path& folder, const Place& place) {
  const auto is_up = [](const std::filesystem::path& part) { return part == ".."; };
  if (folder.is_absolute() || std::ranges::any_of(folder, is_up))
    place.fail(fmt::format("folder: found '{}', allowed: a folder below that of the results", folder.string()));
}

void collect_names(std::string_view pattern, std::set<std::string>& names) {
  for (std::size_t begin = pattern.find('{'); begin != std::string_view::npos; begin = pattern.find('{', begin + 1))
    names.emplace(pattern.substr(begin + 1, pattern.find_first_of(":}", begin) - begin - 1));
}

/// Names of the values on which a run, or the run at which it begins, depends.
std::set<std::string> values_used(const Figure& figure, const RunTemplate& run) {
  std::set<std::string> names;
  for (const auto& [key, pattern] : run.settings) collect_names(pattern, names);
  for (const auto& [name, settings] : run.settings_unless_zero) {
    names.insert(name);
    for (const auto& [key, pattern] : settings) collect_names(pattern, names);
  }
  for (const std::string& pattern : {run.folder, run.size, run.command, run.mesh}) collect_names(pattern, names);
  if (!run.packing.empty()) names.merge(values_used(figure, figure.run(run.packing, run.place)));
  if (!run.chain.empty()) names.insert(run.chain);
  for (std::size_t before = 0; before != names.size();) { // see add_what_follows
    before = names.size();
    for (const auto& [name, of_text] : figure.follows)
      for (const auto& [text, words] : of_text)
        for (const auto& [key, value] : words)
          if (names.contains(key)) names.insert(name);
  }
  if (run.from.empty()) return names;
  collect_names(run.from, names);
  const RunTemplate& parent = figure.run(run.from.substr(0, run.from.find_first_of("@:")), run.place);
  if (&parent != &run) names.merge(values_used(figure, parent));
  return names;
}

/// The settings that a branch inherits from the first run of its chain: grains, bonds, element. Every run has its own
/// stages and output.
Settings inherited(const Settings& settings) {
  Settings result;
  for (const auto& setting : settings)
    if (!setting.first.starts_with("stages.") && !setting.first.starts_with("output.")) result.push_back(setting);
  return result;
}

/// Sets where a run begins: its packing, or its parent with the checkpoint. Adds these to the graph.
void add_origin(RunGraph& graph, const Figure& figure, const RunTemplate& run, const Case& row, RunInstance& instance) {
  std::string from = filled_at(run.place, run.from, row.values);
  const auto before = run.chain.empty() ? std::nullopt : before_in_chain(run, row);
  if (before) from = run.name;
  if (from.empty()) {
    if (!run.packing.empty()) instance.packing = add_run(graph, figure, figure.run(run.packing, run.place), row).folder;
    return;
  }
  const std::size_t end = from.find_first_of("@:");
  const RunTemplate& parent_template = figure.run(from.substr(0, end), run.place);
  if (&parent_template == &run && !before) run.place.fail("from: a run cannot begin at itself");
  const RunInstance& parent = add_run(graph, figure, parent_template, before ? *before : row);
  instance.parent = parent.folder;
  instance.packing = parent.packing;
  instance.common_settings = parent.common_settings;
  const RunInstance* root = &parent;
  while (!root->parent.empty()) root = &graph.at(root->parent);
  instance.settings = inherited(root->settings);
  const std::string at = end == std::string::npos ? "" : from.substr(end + 1);
  if (end != std::string::npos && from[end] == '@') {
    const double density = density_of(at, run.place);
    graph.at(instance.parent).densities.insert(density);
    instance.checkpoint = fmt::format("D{:.3f}", density);
  } else {
    instance.checkpoint = stage_to_begin_at(run, parent_template, at);
  }
}

} // namespace

bool same_run(const RunInstance& a, const RunInstance& b) {
  return a.packing == b.packing && a.size == b.size && a.command == b.command && a.parent == b.parent &&
         a.checkpoint == b.checkpoint && a.programme == b.programme && a.settings == b.settings &&
         a.common_settings == b.common_settings;
}

std::vector<std::string> stage_names(const std::string& programme) {
  const TomlDocument document = TomlDocument::from_file(programme);
  const toml::array* stages = document.root()["stages"].as_array();
  if (stages == nullptr || stages->empty())
    throw InputError(fmt::format("{}: found no [[stages]], allowed: at least one", programme));
  std::vector<std::string> names;
  for (const toml::node& stage : *stages)
    names.push_back(stage.is_table() ? (*stage.as_table())["name"].value_or(std::string()) : std::string());
  return names;
}

std::vector<Case> cases_of(const Figure& figure, const std::vector<std::string>& series,
                           const std::vector<Filter>& where, const std::string& mesh, const Place& place) {
  std::vector<Case> all;
  bool known = figure.cases.empty();
  for (const CaseBlock& block : figure.cases) {
    if (!series.empty() && std::find(series.begin(), series.end(), block.series) == series.end()) continue;
    known = true;
    if (!block.meshes.empty() && std::find(block.meshes.begin(), block.meshes.end(), mesh) == block.meshes.end())
      continue;
    Case first;
    first.series = block.series;
    first.block = &block;
    first.values = figure.defaults;
    first.mesh = mesh;
    first.values["series"] = {block.series, {}};
    first.values["MESH"] = {mesh, {}};
    for (const auto& [key, list] : block.values) first.lists[key] = list;
    combine(block, 0, first, all);
  }
  if (!known) place.fail("there are no [[cases]] of this series");
  for (Case& row : all) {
    add_what_follows(figure, row);
    fill_values(row, row.block->place);
  }
  std::erase_if(all, [](const Case& row) {
    return std::any_of(row.block->only.begin(), row.block->only.end(), [&](const Filter& filter) {
      const auto value = row.values.find(filter.name);
      return value == row.values.end() || !filter.accepts(value->second);
    });
  });
  std::erase_if(all, [&](const Case& row) {
    return std::any_of(where.begin(), where.end(), [&](const Filter& filter) {
      const auto value = row.values.find(filter.name);
      if (value == row.values.end()) place.fail(fmt::format("where: no case has a value '{}'", filter.name));
      return !filter.accepts(value->second);
    });
  });
  return all;
}

bool belongs_to(const RunTemplate& run, const Case& row) {
  return run.series.empty() || std::find(run.series.begin(), run.series.end(), row.series) != run.series.end();
}

std::string folder_of_file(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string folder_of(const Figure& figure, const RunTemplate& run, const Case& row) {
  if (!run.folder.empty()) {
    const std::string folder = filled_at(run.place, run.folder, row.values);
    refuse_outside(folder, run.place);
    const std::string mesh = run.mesh.empty() ? row.mesh : filled_at(run.place, run.mesh, row.values);
    return mesh == row.mesh ? folder : fmt::format("../{}/{}", mesh, folder);
  }
  // Packings shared by figures have one folder.
  if (run.is_packing && run.command.empty())
    return run.size.empty() ? "packing" : fmt::format("packing-{}", filled_at(run.place, run.size, row.values));
  std::string folder = fmt::format("{}/{}/{}", figure.name, run.is_packing ? "packings" : "runs", run.name);
  const std::set<std::string> used = values_used(figure, run);
  for (const auto& [key, list] : row.block->values)
    if (used.contains(key)) folder += fmt::format("-{}", row.values.find(key)->second.text);
  return folder;
}

const RunInstance& add_run(RunGraph& graph, const Figure& figure, const RunTemplate& run, const Case& row) {
  RunInstance instance;
  instance.folder = folder_of(figure, run, row);
  instance.programme = run.programme;
  instance.common_settings = run.common_settings;
  instance.is_packing = run.is_packing;
  instance.is_made = !instance.folder.starts_with("../");
  instance.size = filled_at(run.place, run.size, row.values);
  Words words = row.values;
  words["here"] = {folder_of_file(figure.path), {}};
  instance.command = filled_at(run.place, run.command, words);
  if (instance.folder.find_first_of(" '\"$#:\\%") != std::string::npos)
    run.place.fail(fmt::format("folder: found '{}', allowed: no blanks, quotes, $, #, :, % and \\", instance.folder));
  const Settings own = filled_settings(run, row);
  add_origin(graph, figure, run, row, instance);
  instance.settings.insert(instance.settings.end(), own.begin(), own.end());

  const auto [at, added] = graph.try_emplace(instance.folder, instance);
  if (!added && !same_run(at->second, instance))
    run.place.fail(fmt::format(
        "folder '{}' is that of two runs with different settings; the folder's name must differ between them",
        instance.folder));
  return at->second;
}

void add_runs(RunGraph& graph, const RunGraph& others, const std::string& name) {
  for (const auto& [folder, run] : others) {
    const auto [at, added] = graph.try_emplace(folder, run);
    if (!added && !same_run(at->second, run))
      throw InputError(fmt::format("{}: the run '{}' has other settings in another figure", name, folder));
    at->second.densities.insert(run.densities.begin(), run.densities.end());
  }
}

} // namespace mpfem
