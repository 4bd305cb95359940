#pragma once
// How much memory this process may still take.

#include <filesystem>

namespace mpfem {

/// Bytes of memory that this process may still take: what the system has available, or less if a control group (a batch
/// system, a container) allows less. Infinite if the system does not tell. The folders hold the system's own files.
double available_memory(const std::filesystem::path& processes = "/proc",
                        const std::filesystem::path& control_groups = "/sys/fs/cgroup");

} // namespace mpfem
