#pragma once

#include <filesystem>

namespace mpfem {

/// Bytes of memory that this process may still take: what the system has available, or less where a control group (a
/// batch system, a container) allows less. Infinite where the system does not say. The folders are those of the
/// system's own files.
double available_memory(const std::filesystem::path& processes = "/proc",
                        const std::filesystem::path& control_groups = "/sys/fs/cgroup");

} // namespace mpfem
