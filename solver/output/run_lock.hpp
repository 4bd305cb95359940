#pragma once
// One process at a time writes a run's files.

#include <string>

namespace mpfem {

/// Holds RUN.lock while it lives; for a symbolic link, that of the file to which it leads. The system releases it with
/// the process, however that ends: a lock file that is left behind blocks nobody. Throws InputError if another process
/// holds it, or if the file is not empty and so no lock. On file systems without locks nothing is locked.
class RunLock {
public:
  explicit RunLock(const std::string& run_file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

private:
  std::string path_;
  int file_ = -1;
};

} // namespace mpfem
