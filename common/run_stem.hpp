#pragma once
// The name that the files of a run begin with.

#include <string>

namespace mpfem {

/// RUN of RUN.h5: checkpoints, snapshots and the lock of a run have names that begin so. Another ending stays.
inline std::string run_stem(const std::string& run_file) {
  return run_file.ends_with(".h5") ? run_file.substr(0, run_file.size() - 3) : run_file;
}

} // namespace mpfem
