#include "solver/run/bond_programme.hpp"

#include <fmt/format.h>

#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "common/table_reader.hpp"
#include "solver/run/bond_table.hpp"
#include "solver/run/read_bond_programme.hpp"

namespace mpfem {

void run_bond_programme(const BondProgrammeOptions& options) {
  TomlDocument document = TomlDocument::from_file(options.law);
  for (const std::string& assignment : options.assignments) document.set(assignment);
  const BondedPointLaw law = read_bonded_point_law(document);
  const std::vector<WayPoint> programme = read_bond_programme(options.programme, options.increments);
  check_output_path("--output", options.output, OutputKind::text);
  refuse_overwriting("--output", options.output, options.law);
  refuse_overwriting("--output", options.output, options.programme);

  BondTable table(options.output, law);
  for (std::size_t i = 0; i < programme.size(); ++i) table.walk_to(programme[i], i + 1);
  table.complete();
  if (!options.quiet) fmt::print("{}: {}\n", one_line(options.output), table.summary());
}

} // namespace mpfem
