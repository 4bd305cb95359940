#pragma once
// What a user must know before using a result, on standard error.

#include <string>
#include <vector>

namespace mpfem {

/// Prints to standard error, one line each.
void print_notes(const std::vector<std::string>& notes);

} // namespace mpfem
