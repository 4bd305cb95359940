#pragma once
// Files held to the results schema.

#include <string>

namespace mpfem {

/// What is wrong with one file, a line a finding, each beginning with its name; or that it is valid, with its kind.
struct Verdict {
  bool valid = false;
  std::string text;
};

/// A file that cannot be read at all is a finding too, so that others can still be looked at.
Verdict verdict_on(const std::string& path);

} // namespace mpfem
