// Scenario files: TOML text -> read_scenario.

#include "solver/scenario/scenario.hpp"
#include "common/table_reader.hpp"
#include "refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] { read_scenario(TomlDocument::from_text(fuzz::text_of(data, size), "scenario.toml")); });
  return 0;
}
