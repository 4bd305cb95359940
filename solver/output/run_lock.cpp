#include "solver/output/run_lock.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/run_stem.hpp"

namespace mpfem {

namespace {

/// Whether the open file holds anything: locks are empty.
bool holds_something(int file) {
  struct stat open {};
  return fstat(file, &open) == 0 && open.st_size > 0;
}

/// Whether the open file still exists under its name: if not, its previous holder has removed it.
bool stands(int file, const std::string& path) {
  struct stat open {
  }, named{};
  return fstat(file, &open) == 0 && stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

} // namespace

RunLock::RunLock(const std::string& run_file) : path_(name_of_lock(output_target(run_file))) {
  for (;;) {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw StorageError(fmt::format("{}: cannot be written", one_line(path_)));
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return;
      close(file_);
      throw InputError(fmt::format("--output {}: another mpfem is writing this run and holds the lock {}: wait for it, "
                                   "or end it (kill, scancel)",
                                   one_line(run_file), one_line(path_)));
    }
    if (holds_something(file_)) {
      close(file_);
      throw InputError(fmt::format("--output {}: its lock would replace {}, which is not empty, allowed: another "
                                   "--output",
                                   one_line(run_file), one_line(path_)));
    }
    if (stands(file_, path_)) return;
    close(file_);
  }
}

RunLock::~RunLock() {
  if (stands(file_, path_)) unlink(path_.c_str());
  close(file_);
}

} // namespace mpfem
