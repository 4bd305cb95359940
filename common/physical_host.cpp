#include "common/physical_host.hpp"

#include <fstream>
#include <optional>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "common/one_line.hpp"
#include "common/trimmed.hpp"

namespace mpfem {

namespace {

constexpr std::string_view around = " \t\"'"; // keys and values

/// The value of the first line "KEY<separator>VALUE" of a file.
std::optional<std::string> value_in_file(const char* path, std::string_view key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::string_view view = line;
    const auto at = view.find(separator);
    if (at != std::string_view::npos && trimmed(view.substr(0, at), around) == key)
      return std::string(trimmed(view.substr(at + 1), around));
  }
  return std::nullopt;
}

} // namespace

std::string physical_host() {
  utsname system{};
  const bool known = uname(&system) == 0;
  const std::string kernel =
      known ? fmt::format("{} {} {}", &system.sysname[0], &system.release[0], &system.machine[0]) : "unknown system";
  const auto distribution = value_in_file("/etc/os-release", "PRETTY_NAME", '=').value_or("unknown distribution");
  const auto processor = value_in_file("/proc/cpuinfo", "model name", ':').value_or("unknown processor");
  return one_line(fmt::format("{}, {}; {}, {} logical processors", distribution, kernel, processor,
                              std::thread::hardware_concurrency()));
}

} // namespace mpfem
