#pragma once
// A device that a test may lose.

#include <string>

#include <sys/stat.h>
#include <sys/sysmacros.h>

namespace mpfem::test {

/// Makes a device like /dev/null; false where this user cannot (only the superuser can).
inline bool make_null_device(const std::string& path) {
  return mknod(path.c_str(), S_IFCHR | 0600, makedev(1, 3)) == 0;
}

} // namespace mpfem::test
