#include "solver/run/plan_text.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mpfem {

std::string wall_time_text(double seconds) {
  constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
  if (seconds < minute) return fmt::format("{:.3g} s", seconds);
  if (seconds < 10 * minute) return fmt::format("{:.2g} min", seconds / minute);
  const double minutes = std::round(seconds / minute);
  if (minutes < 60) return fmt::format("{:.0f} min", minutes);
  if (seconds < 2 * day) return fmt::format("{:.0f} h {:.0f} min", std::floor(minutes / 60), std::fmod(minutes, 60));
  return fmt::format("{:.3g} days", seconds / day);
}

std::string mass_scaling_text(const Scenario& scenario, const Model& model) {
  std::string text;
  if (const double factor = scenario.numerics.mass_scaling; factor != 1)
    text = fmt::format("all masses multiplied by {:g}: steps are {:.3g} times as long, inertia is as large as at "
                       "{:.3g} times the speed",
                       factor, std::sqrt(factor), std::sqrt(factor));
  if (model.added_mass != 0)
    text += fmt::format(
        "{}mass scaling to the step changes the packing's mass by {:+.3g} %, a grain's by at most {:+.3g} %",
        text.empty() ? "" : "; ", 100 * model.added_mass, 100 * model.largest_added_mass);
  return text;
}

std::string earlier_bonds_text(const Contact& contact) {
  if (contact.bond_laws.size() < 2) return {};
  const auto law_text = [](const BondLaw& law) {
    return fmt::format("tensile and shear strength {:g} and {:g} MPa, fracture energy {:g} N/mm, {} softening",
                       law.tensile_strength, law.shear_strength, law.fracture_energy, name_of(law.softening));
  };
  std::vector<std::int64_t> formed(contact.bond_laws.size(), 0);
  for (const PointBond& bond : contact.bond)
    if (bond.exists()) ++formed[static_cast<std::size_t>(bond.law)];
  std::string text;
  for (std::size_t i = 0; i + 1 < formed.size(); ++i)
    text += fmt::format("{}{} bonds formed earlier keep their law ({})", i == 0 ? "" : ", ", formed[i],
                        law_text(contact.bond_laws[i]));
  return text + fmt::format("; new bonds have {}", law_text(contact.bond_laws.back()));
}

} // namespace mpfem
