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

TEST_CASE("bench prints one object with what a step costs") {
  const auto bench = mpfem_command("bench --tets 3000 --grains 6 --steps 6 --threads 2 --element tet4-anp --json");
  REQUIRE(bench.exit_code == 0);
  for (const std::string key : {"threads", "tets", "element_pass_ns_per_tet_step", "contact_ns_per_tet_step",
                                "search_ns_per_tet_step", "whole_step_ns_per_tet_step", "output_ns_per_tet_step",
                                "integration_GB_per_s", "triad_GB_per_s", "fma_GFlop_per_s"}) {
    CAPTURE(key, bench.output);
    const auto at = bench.output.find("\"" + key + "\": ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(bench.output.substr(at + key.size() + 4)) > 0);
  }
  CHECK(bench.output.front() == '{');
  CHECK(mpfem_command("bench --tets 3000 --grains 6 --steps 6 --no-bonds --friction 0.3 --quiet").exit_code == 0);
  CHECK(mpfem_command("bench --friction -0.1").exit_code == 2);
  CHECK(mpfem_command("bench --element brick").exit_code == 2);
  CHECK(mpfem_command("bench --from /nowhere").exit_code == 2);
}
