// Values of --set: a line each, laid over a document and read as a scenario. What was laid over must be written as
// text that reads as the same document: checkpoints keep it.

#include "common/table_reader.hpp"
#include "common/toml_difference.hpp"
#include "refusal.hpp"
#include "solver/scenario/read_scenario.hpp"

namespace {

constexpr std::string_view document_text = R"(packing = 'p.h5'
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
law = 'elastic'
[[stages]]
type = 'hold'
duration = 1e-3
)";

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] {
    TomlDocument document = TomlDocument::from_text(document_text, "scenario.toml");
    std::string_view lines = fuzz::text_of(data, size);
    while (!lines.empty()) {
      const std::size_t end = std::min(lines.find('\n'), lines.size());
      document.set(lines.substr(0, end));
      lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    read_scenario(document);
    const TomlDocument again = TomlDocument::from_text(document.text(), "again.toml");
    if (first_difference(document.root(), again.root())) std::abort();
  });
  return 0;
}
