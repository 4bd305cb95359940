// The page in docs is made by the target results_schema_docs; here it is held to what the schema would make today.

#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"

namespace {

std::string content_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("The committed page of the schema is the generated one") {
  // Fails after a change of schema.toml: build the target results_schema_docs and commit docs/results-schema.md.
  CHECK((content_of(MPFEM_TEST_COMMITTED_PAGE) == content_of(MPFEM_TEST_GENERATED_PAGE)));
}

TEST_CASE("The page names every dataset of every kind") {
  const std::string page = content_of(MPFEM_TEST_GENERATED_PAGE);
  for (const auto& kind : mpfem::schema::kinds)
    for (const auto& dataset : kind.datasets) {
      CAPTURE(kind.name, dataset.path);
      CHECK(page.find(fmt::format("| `{}` | {} |", dataset.path, mpfem::schema::type_name(dataset.type))) !=
            std::string::npos);
    }
}
