#include "postproc/metrics/round_die.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "results-schema/descriptors.hpp"

namespace mpfem {

void refuse_other_than_round_dies(const schema::FileReader& run, bool required) {
  constexpr double of_circle = std::numbers::pi / 4, rounding = 1e-9;
  if (!run.has(schema::run::history_section_share)) {
    if (!required) return;
    throw InputError(fmt::format("{}: the run has no [container], allowed: a run whose scenario has a round die",
                                 one_line(run.path())));
  }
  const auto share = run.read(schema::run::history_section_share);
  for (const double s : share)
    if (!(std::abs(s - of_circle) < rounding))
      throw InputError(fmt::format("{}: found a die that fills {:.4g} of the rectangle around it, allowed: a round one",
                                   one_line(run.path()), s));
}

} // namespace mpfem
