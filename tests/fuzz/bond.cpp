// Bond laws and programmes: the text before a line "---" is the law (TOML), the text after it the programme (CSV).
// If both are accepted, a point is driven through the first rows and must give finite numbers.

#include <algorithm>
#include <cmath>

#include "common/csv_reader.hpp"
#include "common/table_reader.hpp"
#include "refusal.hpp"
#include "solver/run/read_bond_programme.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  constexpr std::string_view mark = "---\n";
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t at = std::min(text.find(mark), text.size());
  fuzz::read_or_refuse([&] {
    const BondedPointLaw law = read_bonded_point_law(TomlDocument::from_text(text.substr(0, at), "law.toml"));
    const std::string programme(text.substr(std::min(at + mark.size(), text.size())));
    BondedPoint point(law);
    for (const WayPoint& way : read_bond_programme(CsvReader::from_text(programme, "programme.csv"), 1)) {
      const BondedPoint::Response response = point.move_to(way.separation);
      if (!std::isfinite(response.normal + response.shear1 + response.shear2 + response.stored + response.dissipated))
        std::abort();
    }
  });
  return 0;
}
