#pragma once
// Tables of numbers as text: comma-separated, '#' begins a comment, one optional heading.

#include <string>
#include <vector>

namespace mpfem {

/// Rows of a CSV file with exactly these columns, in this order. A first line that is no numbers is the heading and must
/// name the columns (a unit in brackets may follow each name). Throws InputError "FILE:LINE: …".
std::vector<std::vector<double>> read_csv(const std::string& path, const std::vector<std::string>& columns);

} // namespace mpfem
