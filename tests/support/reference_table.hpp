#pragma once
// Reads the CSV tables in tests/reference.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpfem::test {

/// Rows of a CSV file without its header line; quoted fields may hold commas.
inline std::vector<std::vector<std::string>> read_reference(const std::string& name) {
  std::ifstream file(std::string(MPFEM_TEST_REFERENCE) + "/" + name);
  if (!file) throw std::runtime_error("missing reference table " + name);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        fields.emplace_back();
      else
        fields.back() += c;
    }
    rows.push_back(fields);
  }
  return rows;
}

} // namespace mpfem::test
