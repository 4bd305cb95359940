#pragma once
// The names of the files of a run.

#include <string>

namespace mpfem {

/// RUN of RUN.h5: checkpoints, snapshots and the lock of a run have names that begin so. Another ending stays.
inline std::string run_stem(const std::string& run_file) {
  return run_file.ends_with(".h5") ? run_file.substr(0, run_file.size() - 3) : run_file;
}

/// RUN.checkpoint.h5, the newest checkpoint of a run.
inline std::string name_of_checkpoint(const std::string& run_file) {
  return run_stem(run_file) + ".checkpoint.h5";
}

/// RUN.checkpoint.previous.h5, the one before it. Between two renames only this one exists.
inline std::string name_of_previous_checkpoint(const std::string& run_file) {
  return run_stem(run_file) + ".checkpoint.previous.h5";
}

/// RUN.NAME.checkpoint.h5, at the end of the stage NAME or, as D0.850, at a relative density.
inline std::string name_of_kept_checkpoint(const std::string& run_file, const std::string& name) {
  return run_stem(run_file) + "." + name + ".checkpoint.h5";
}

/// RUN.lock, which a run holds as long as it works.
inline std::string name_of_lock(const std::string& run_file) {
  return run_stem(run_file) + ".lock";
}

} // namespace mpfem
