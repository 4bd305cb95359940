#pragma once
// Checks files against the results schema.

#include <string>

namespace mpfem {

/// Either the findings about one file, one per line, each beginning with its name; or that it is valid, with its kind.
struct Verdict {
  bool valid = false;
  std::string text;
};

/// A file that cannot be read at all counts as a finding, so that further files can still be checked.
Verdict verdict_on(const std::string& path);

} // namespace mpfem
