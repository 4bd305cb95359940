#include "solver/parallel/share_of_cores.hpp"

#include <sched.h>

#include <algorithm>
#include <string>

#include "common/available_cores.hpp"
#include "common/physical_host.hpp"

namespace mpfem {

int share_of_cores(const Communicator& ranks) {
  cpu_set_t own;
  if (ranks.alone() || sched_getaffinity(0, sizeof own, &own) != 0) return available_cores();
  const std::string host = physical_host();
  Bytes message;
  append(message, own);
  append(message, std::span<const char>(host));
  double share = 0;
  const std::vector<Bytes> all = ranks.all_of(message);
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (!CPU_ISSET(core, &own)) continue;
    int users = 0;
    for (const Bytes& bytes : all) {
      MessageReader reader(bytes);
      const auto cores = reader.take<cpu_set_t>();
      std::string where(bytes.size() - sizeof cores, ' ');
      reader.take(std::span<char>(where));
      if (where == host && CPU_ISSET(core, &cores)) ++users;
    }
    share += 1.0 / users;
  }
  return std::max(1, static_cast<int>(share + 1e-6));
}

} // namespace mpfem
