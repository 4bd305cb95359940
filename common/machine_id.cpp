#include "common/machine_id.hpp"

#include <unistd.h>

#include <array>
#include <fstream>

namespace mpfem {

std::string machine_id() {
  std::string id;
  if (std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, id) && !id.empty()) return id;
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

} // namespace mpfem
