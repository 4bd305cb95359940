#include "common/available_cores.hpp"

#include <algorithm>
#include <thread>

#include <sched.h>

namespace mpfem {

int available_cores() {
  cpu_set_t cores; // holds up to 1024; on larger machines the call fails
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return std::max(1, CPU_COUNT(&cores));
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

} // namespace mpfem
