#include "postproc/figure/named_files.hpp"

#include <filesystem>
#include <vector>

#include "common/errors.hpp"
#include "postproc/figure/shell_words.hpp"

namespace mpfem {

namespace {

/// Whether make can take a file as a prerequisite: it exists, and no character of its name means something to make.
bool can_be_prerequisite(const std::string& file) {
  std::error_code ignored; // names that are too long
  return file.find_first_of(" \t$#:;|%*?[]~\\'\"") == std::string::npos &&
         std::filesystem::is_regular_file(file, ignored);
}

/// What a packing's description names: the STL file of its container and the list of sizes, relative to its folder. A
/// description that cannot be read names nothing here; pack-gen will refuse it.
std::vector<std::string> files_in_description(const std::string& description) {
  std::vector<std::string> files;
  try {
    const TomlDocument document = TomlDocument::from_file(description);
    const std::filesystem::path folder = std::filesystem::path(description).parent_path();
    for (const char* key : {"surface_file", "size_distribution.file"})
      if (const auto name = document.root().at_path(key).value<std::string>())
        files.push_back((folder / *name).lexically_normal().string());
  } catch (const InputError&) {
    return {};
  }
  return files;
}

} // namespace

std::string files_in_command(const std::string& command, const std::string& results) {
  std::string files;
  for (const std::string& word : shell_words(command).value_or(std::vector<std::string>()))
    if (!word.starts_with(results + "/") && can_be_prerequisite(word)) {
      files += ' ' + word;
      if (!word.ends_with(".toml")) continue;
      for (const std::string& file : files_in_description(word))
        if (can_be_prerequisite(file)) files += ' ' + file;
    }
  return files;
}

std::string surfaces_of_tools(const RunInstance& run, const TomlDocument& scenario) {
  std::vector<std::string> names;
  if (const toml::array* tools = scenario.root()["tools"].as_array())
    for (const toml::node& tool : *tools)
      if (tool.is_table()) names.push_back((*tool.as_table())["file"].value_or(std::string()));
  for (const auto& [key, value] : run.settings)
    if (key.starts_with("tools.") && key.ends_with(".file")) names.push_back(value);
  std::string files;
  for (const std::string& name : names) {
    const std::string file = (std::filesystem::path(run.programme).parent_path() / name).lexically_normal().string();
    if (std::filesystem::is_regular_file(file)) files += ' ' + file;
  }
  return files;
}

} // namespace mpfem
