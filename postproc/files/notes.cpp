#include "postproc/files/notes.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace mpfem {

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print(stderr, "postproc: note: {}\n", note);
}

} // namespace mpfem
