// Packings, runs and cases of a figure's file.

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "postproc/figure/read_specs.hpp"
#include "postproc/figure/shell_words.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

/// A value in the syntax of `mpfem run --set`: numbers and words as they are, lists in brackets.
std::string setting_text(const toml::node& node, const Place& place) {
  if (const toml::array* list = node.as_array()) {
    std::vector<std::string> parts;
    for (const toml::node& element : *list) parts.push_back(setting_text(element, place));
    return fmt::format("[{}]", fmt::join(parts, ","));
  }
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return value_of(node, place).text;
}

Settings read_settings(TableReader reader) {
  Settings settings;
  for (const std::string& key : reader.keys())
    settings.emplace_back(key, setting_text(*reader.value(key), Place(reader, key)));
  return settings;
}

/// Whether a file is a scenario: the folder of programmes has parts of figures too.
bool is_scenario(const filesystem::path& file) {
  if (file.extension() != ".toml") return false;
  try {
    return TomlDocument::from_file(file.string()).root().contains("stages");
  } catch (const InputError&) {
    return false; // no TOML
  }
}

std::string programme_path(TableReader& r, const std::string& name, const filesystem::path& folder,
                           const std::string& programmes) {
  filesystem::path path = name.ends_with(".toml") ? folder / name : filesystem::path(programmes) / (name + ".toml");
  path = path.lexically_normal();
  if (!filesystem::exists(path)) {
    std::vector<std::string> known;
    std::error_code ignored;
    for (const auto& entry : filesystem::directory_iterator(programmes, ignored))
      if (is_scenario(entry.path())) known.push_back(entry.path().stem().string());
    std::sort(known.begin(), known.end());
    r.fail("programme", fmt::format("found '{}', but there is no {}{}", name, path.string(), suggestion(name, known)));
  }
  return path.string();
}

/// A value that stands twice in a list would make rows twice, and a chain without end.
void refuse_repeated(const std::vector<Value>& values, const Place& place) {
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::find(values.begin(), value, *value) != value)
      place.fail(fmt::format("found {} twice, allowed: every value once", value->text));
}

} // namespace

RunTemplate read_packing(TableReader& r) {
  RunTemplate packing;
  packing.place = Place(r, "name");
  packing.is_packing = true;
  packing.name = checked_name(r, "name", r.string("name"));
  packing.size = r.string_or("size", "");
  packing.command = r.string_or("command", "");
  packing.series = r.strings_or("series", {});
  try {
    shell_words(packing.command);
  } catch (const InputError& error) {
    r.fail("command", error.what());
  }
  if (!packing.size.empty() && !packing.command.empty())
    r.fail("command", "cannot be used with 'size', allowed: one of both");
  r.finish();
  return packing;
}

RunTemplate read_run(TableReader& r, const std::filesystem::path& folder, const std::string& programmes) {
  RunTemplate run;
  run.place = Place(r, "name");
  run.name = checked_name(r, "name", r.string("name"));
  run.folder = r.string_or("folder", "");
  run.from = r.string_or("from", "");
  run.chain = r.string_or("chain", "");
  run.packing = r.string_or("packing", "");
  run.mesh = r.string_or("mesh", "");
  run.series = r.strings_or("series", {});
  run.programme = programme_path(r, r.string("programme"), folder, programmes);
  run.common_settings = r.boolean_or("common_settings", true);
  if (auto settings = r.optional_table("settings")) run.settings = read_settings(*settings);
  if (auto groups = r.optional_table("settings_unless_zero"))
    for (const std::string& key : groups->keys())
      run.settings_unless_zero.emplace_back(key, read_settings(groups->table(key)));
  if (!run.mesh.empty() && run.folder.empty()) r.fail("mesh", "found without 'folder', the folder of that run");
  r.finish();
  return run;
}

CaseBlock read_case(Texts& t) {
  CaseBlock block;
  block.place = Place(t.reader(), "series");
  block.series = t.optional("series");
  block.meshes = t.list("meshes");
  block.only = t.filters("only");
  for (const std::string& key : t.reader().keys()) {
    if (key == "series" || key == "meshes" || key == "only" || key == "for_each") continue;
    block.values.emplace_back(key, t.values(key));
    refuse_repeated(block.values.back().second, Place(t.reader(), key));
  }
  return block;
}

} // namespace mpfem
