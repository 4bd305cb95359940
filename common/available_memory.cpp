#include "common/available_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace mpfem {

namespace {

namespace fs = std::filesystem;

/// The number after a word at the start of a line, or the file's first number if the word is empty.
std::optional<double> number_in(const fs::path& path, const std::string& word = {}) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string first;
    if (!word.empty() && (!(fields >> first) || first != word)) continue;
    double value = 0;
    if (fields >> value) return value;
    return std::nullopt; // "max": no limit
  }
  return std::nullopt;
}

/// Bytes that a control group leaves. Files that it has read count as used, but can be dropped.
double left_by_group(const fs::path& group, const char* limit_name, const char* usage_name, const char* files_name) {
  const auto limit = number_in(group / limit_name), usage = number_in(group / usage_name);
  if (!limit || !usage) return std::numeric_limits<double>::infinity();
  return std::max(*limit - *usage + number_in(group / "memory.stat", files_name).value_or(0), 0.0);
}

} // namespace

double available_memory(const fs::path& processes, const fs::path& control_groups) {
  double available = std::numeric_limits<double>::infinity();
  if (const auto kilobytes = number_in(processes / "meminfo", "MemAvailable:")) available = 1024 * *kilobytes;
  // Lines "NUMBER:CONTROLLERS:/GROUP"; no controllers: version 2.
  std::ifstream groups(processes / "self" / "cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers != "memory") continue;
    const bool version1 = !controllers.empty();
    const fs::path root = version1 ? control_groups / "memory" : control_groups;
    // Limits hold for all groups inside. In a container the group's own path may be missing; only the root is there.
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path();; group = group.parent_path()) {
      available =
          std::min(available, version1 ? left_by_group(root / group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                                       "total_inactive_file")
                                       : left_by_group(root / group, "memory.max", "memory.current", "inactive_file"));
      if (group.empty()) break;
    }
  }
  return available;
}

} // namespace mpfem
