// mpfem bench as a command.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

namespace {

/// The number behind "KEY" in JSON.
double number_in(const std::string& json, const std::string& key) {
  CAPTURE(key, json);
  const auto at = json.find("\"" + key + "\": ");
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + key.size() + 4));
}

} // namespace

TEST_CASE("bench prints one object with what a step costs") {
  const auto bench = mpfem_command("bench --tets 3000 --grains 6 --steps 6 --threads 2 --element tet4-anp --json");
  REQUIRE(bench.exit_code == 0);
  for (const std::string key : {"threads", "tets", "element_pass_ns_per_tet_step", "contact_ns_per_tet_step",
                                "search_ns_per_tet_step", "whole_step_ns_per_tet_step", "output_ns_per_tet_step",
                                "integration_GB_per_s", "triad_GB_per_s", "fma_GFlop_per_s"})
    CHECK(number_in(bench.output, key) > 0);
  CHECK(bench.output.front() == '{');
  CHECK(mpfem_command("bench --tets 3000 --grains 6 --steps 6 --no-bonds --friction 0.3 --quiet").exit_code == 0);
  CHECK(mpfem_command("bench --friction -0.1").exit_code == 2);
  CHECK(mpfem_command("bench --element brick").exit_code == 2);
  CHECK(mpfem_command("bench --from /nowhere").exit_code == 2);
}

TEST_CASE("the memory that bench prints is that of the packing, without the arrays that measure the machine") {
  const auto bench = mpfem_command("bench --tets 3000 --grains 6 --steps 6 --threads 2 --json");
  REQUIRE(bench.exit_code == 0);
  // Three arrays of 64 MiB for each of two threads, 134 kB a tetrahedron here; the packing itself takes less than 1 kB.
  const double arrays = 2 * 3 * 64.0 * 1048576;
  CHECK(number_in(bench.output, "memory_bytes_per_tet") * number_in(bench.output, "tets") < arrays);
}
