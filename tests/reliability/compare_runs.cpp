// compare-runs A B: whether two run files or checkpoints are the same (tests/support/same_files.hpp). Exit code 0: they
// are.

#include <string>

#include "common/errors.hpp"
#include "tests/support/same_files.hpp"

namespace {

int body(int argc, char** argv) {
  if (argc != 3) throw mpfem::InputError("found other than two files, allowed: compare-runs A B");
  const std::string difference = mpfem::test::first_difference(argv[1], argv[2]);
  if (!difference.empty()) throw mpfem::SimulationError(difference);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("compare-runs", body, argc, argv);
}
