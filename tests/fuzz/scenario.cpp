// Scenario files: TOML text -> read_scenario.

#include "common/table_reader.hpp"
#include "refusal.hpp"
#include "solver/scenario/read_scenario.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] { read_scenario(TomlDocument::from_text(fuzz::text_of(data, size), "scenario.toml")); });
  return 0;
}
