#include "postproc/metrics/summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/run_quality.hpp"
#include "postproc/metrics/energy.hpp"
#include "postproc/metrics/inertia.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

void add_provenance(Summary& s, const schema::FileReader& file) {
  s.status = file.read_scalar(run::provenance_status);
  s.version = file.read_scalar(run::provenance_version);
  s.host = file.read_scalar(run::provenance_host);
  s.threads = file.read_scalar(run::provenance_threads);
  s.wall_time = file.read_scalar(run::provenance_wall_time);
  s.tets = static_cast<std::int64_t>(file.rows(run::mesh_tet));
  s.grains = static_cast<std::int64_t>(file.rows(run::mesh_grain_tet_offset)) - 1;
  s.profile_name = file.read(run::provenance_profile_name);
  s.profile_share = file.read(run::provenance_profile_seconds);
  for (double& share : s.profile_share) share = s.wall_time > 0 ? share / s.wall_time : 0;
}

/// Empty where the run never had any.
std::optional<Summary::Bonds> bonds_at_end(const HistoryTable& history) {
  const auto ever = [&](std::string_view name) {
    return std::any_of(history[name].begin(), history[name].end(), [](double value) { return value > 0; });
  };
  // Bonds that all broke between two rows are in no row, but their dissipation is.
  if (!ever("bonds") && !ever("damage_dissipation")) return {};
  return Summary::Bonds{static_cast<std::int64_t>(history["bonds"].back()), history["bonded_area"].back(),
                        history["mean_damage"].back()};
}

/// The last step of a run. A run that failed ends with a snapshot of its failed state, and has no row of it.
double last_step(const schema::FileReader& file, const HistoryTable& history) {
  double last = history["step"].back();
  for (const std::string& name : file.snapshots())
    last = std::max(last, static_cast<double>(file.read_scalar(run::snapshots_step, name)));
  return last;
}

void add_state_at_end(Summary& s, const schema::FileReader& file, const HistoryTable& history) {
  const double last = last_step(file, history);
  s.steps = static_cast<std::int64_t>(last);
  // A branch continues the step count of the run from which it started.
  if (const double steps = last - history["step"].front(); steps > 0 && s.tets > 0)
    s.nanoseconds_per_tet_step = 1e9 * s.wall_time / (steps * static_cast<double>(s.tets));
  s.relative_density = history["relative_density"].back();
  s.mean_stress = history["mean_stress"].back();
  s.deviatoric_stress = history["deviatoric_stress"].back();
  for (const Column& term : energy_ledger(history))
    if (term.unit == "mJ") s.energies.emplace_back(term.name, term.values.back());
  s.coordination_number = history["coordination_number"].back();
  if (const double area = history["surface_area"].back(); area > 0)
    s.contact_area_ratio = history["contact_area"].back() / area;
  s.bonds = bonds_at_end(history);
}

/// Rows whose mean stress is above a tenth of its largest.
std::vector<bool> loaded_rows(const HistoryTable& history) {
  const auto& stress = history["mean_stress"];
  const double loaded = 0.1 * *std::max_element(stress.begin(), stress.end());
  std::vector<bool> rows;
  for (const double p : stress) rows.push_back(loaded > 0 && p >= loaded);
  return rows;
}

void add_kinetic_share(Summary& s, const HistoryTable& history, const std::vector<bool>& loaded) {
  const std::vector<double> internal_of_row = internal_energy(history);
  s.loaded_from_density = s.relative_density;
  double largest_kinetic = 0, largest_internal = 0;
  bool small = true; // from this row to the end
  for (std::size_t row = history.rows(); row-- > 0;) {
    const double internal = internal_of_row[row], kinetic = history["kinetic_energy"][row];
    largest_kinetic = std::max(largest_kinetic, kinetic);
    largest_internal = std::max(largest_internal, internal);
    if (internal > 0 && loaded[row]) {
      s.kinetic_over_internal = std::max(s.kinetic_over_internal, kinetic / internal);
      s.loaded_from_density = std::min(s.loaded_from_density, history["relative_density"][row]);
    }
    small = small && kinetic <= 0.01 * internal;
    if (small) s.kinetic_small_from_density = history["relative_density"][row];
  }
  s.kinetic_over_largest_internal = largest_internal > 0 ? largest_kinetic / largest_internal : 0;
}

void add_inertial_number(Summary& s, const HistoryTable& history, const std::vector<bool>& loaded,
                         const std::optional<GrainInertia>& grains) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < loaded.size(); ++row)
    if (loaded[row]) rows.push_back(row);
  const Inertia inertia = inertia_of_rows(history, rows, grains);
  s.inertial_number = inertia.inertial_number;
  s.largest_inertial_number = inertia.largest_inertial_number;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

void add_extremes(Summary& s, const HistoryTable& history) {
  const double work = largest_magnitude(history["external_work"]);
  s.largest_residual = work > 0 ? largest_magnitude(history["energy_residual"]) / work : 0;
  for (const double penetration : history["max_penetration"])
    s.largest_penetration = std::max(s.largest_penetration, penetration);
  for (const double density : history["relative_density_current"])
    s.largest_current_density = std::max(s.largest_current_density, density);
  for (const double step : history["time_step"]) {
    if (!(step > 0)) continue;
    s.smallest_time_step = s.smallest_time_step > 0 ? std::min(s.smallest_time_step, step) : step;
    s.largest_time_step = std::max(s.largest_time_step, step);
  }
}

std::vector<QualityRow> quality_rows(const HistoryTable& history) {
  const std::vector<double> internal_of_row = internal_energy(history);
  std::vector<QualityRow> rows;
  for (std::size_t row = 0; row < history.rows(); ++row)
    rows.push_back({history["external_work"][row], history["energy_residual"][row], history["kinetic_energy"][row],
                    internal_of_row[row], history["mean_stress"][row], history["max_penetration"][row],
                    history["relative_density_current"][row], history["time_step"][row]});
  return rows;
}

} // namespace

Summary summarise(const schema::FileReader& file) {
  const HistoryTable history(file, NotFinite::kept); // a run that diverged is summarised too
  Summary s;
  add_provenance(s, file);
  add_state_at_end(s, file, history);
  const std::vector<bool> loaded = loaded_rows(history);
  add_kinetic_share(s, history, loaded);
  add_inertial_number(s, history, loaded, grain_inertia(file, history));
  add_extremes(s, history);
  s.warnings = quality_warnings(quality_rows(history));
  if (!history.not_finite().empty())
    s.warnings.push_back(fmt::format("{}: numbers here do not count it, or are not finite", history.not_finite()));
  return s;
}

nlohmann::ordered_json to_json(const Summary& s) {
  nlohmann::ordered_json json = {{"status", s.status},
                                 {"version", s.version},
                                 {"host", s.host},
                                 {"threads", s.threads},
                                 {"grains", s.grains},
                                 {"tets", s.tets},
                                 {"steps", s.steps},
                                 {"wall_time_s", s.wall_time},
                                 {"ns_per_tet_step", s.nanoseconds_per_tet_step},
                                 {"relative_density", s.relative_density},
                                 {"mean_stress_MPa", s.mean_stress},
                                 {"deviatoric_stress_MPa", s.deviatoric_stress},
                                 {"largest_energy_residual_over_work", s.largest_residual},
                                 {"largest_kinetic_over_internal_under_load", s.kinetic_over_internal},
                                 {"relative_density_of_first_load", s.loaded_from_density},
                                 {"largest_kinetic_over_largest_internal", s.kinetic_over_largest_internal},
                                 {"relative_density_from_which_kinetic_below_1_percent", nullptr},
                                 {"inertial_number_under_load", number_or_null(s.inertial_number)},
                                 {"largest_inertial_number_under_load", number_or_null(s.largest_inertial_number)},
                                 {"largest_penetration_over_h", s.largest_penetration},
                                 {"largest_current_relative_density", s.largest_current_density},
                                 {"smallest_time_step_s", s.smallest_time_step},
                                 {"largest_time_step_s", s.largest_time_step},
                                 {"coordination_number", s.coordination_number},
                                 {"contact_area_over_surface_area", s.contact_area_ratio}};
  if (s.kinetic_small_from_density)
    json["relative_density_from_which_kinetic_below_1_percent"] = *s.kinetic_small_from_density;
  if (s.bonds) {
    json["unbroken_bonds"] = s.bonds->unbroken;
    json["bonded_area_mm2"] = s.bonds->area;
    json["mean_damage"] = s.bonds->mean_damage;
  }
  json["warnings"] = s.warnings;
  for (const auto& [name, energy] : s.energies) json["energies_mJ"][name] = energy;
  for (std::size_t i = 0; i < s.profile_name.size(); ++i)
    json["wall_time_share"][s.profile_name[i]] = s.profile_share[i];
  return json;
}

std::string to_text(const Summary& s) {
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<40}{}\n", name, value);
  };
  line("status", s.status);
  for (const std::string& warning : s.warnings) line("warning", warning);
  line("grains, tetrahedra, steps", fmt::format("{}  {}  {}", s.grains, s.tets, s.steps));
  line("wall time", fmt::format("{:.1f} s on {} threads, {:.1f} ns per tetrahedron and step", s.wall_time, s.threads,
                                s.nanoseconds_per_tet_step));
  line("relative density at the end", fmt::format("{:.4f}", s.relative_density));
  line("mean stress, deviatoric stress", fmt::format("{:.4g} MPa, {:.3g} MPa", s.mean_stress, s.deviatoric_stress));
  for (std::size_t i = 0; i < s.energies.size(); ++i) {
    std::string name = s.energies[i].first;
    std::replace(name.begin(), name.end(), '_', ' ');
    line(i == 0 ? "energies at the end" : "", fmt::format("{:11.4g} mJ  {}", s.energies[i].second, name));
  }
  line("energy residual, largest over work", fmt::format("{:.2e}", s.largest_residual));
  line("kinetic over internal energy, largest",
       fmt::format("{:.2e} while p is above a tenth of its largest (relative density >= {:.3f})",
                   s.kinetic_over_internal, s.loaded_from_density));
  line("  ratio of both maxima", fmt::format("{:.2e}", s.kinetic_over_largest_internal));
  line("  at most 1 %", s.kinetic_small_from_density
                            ? fmt::format("from a relative density of {:.3f} to the end", *s.kinetic_small_from_density)
                            : std::string("it is larger at the end of the run"));
  line("inertial number under load", s.inertial_number ? fmt::format("{:.2e} in the median, {:.2e} at its largest",
                                                                     *s.inertial_number, *s.largest_inertial_number)
                                                       : std::string("not known"));
  line("penetration over element size, largest", fmt::format("{:.4f}", s.largest_penetration));
  line("current relative density, largest", fmt::format("{:.4f}", s.largest_current_density));
  line("time step", fmt::format("{:.4g} … {:.4g} s", s.smallest_time_step, s.largest_time_step));
  line("coordination number, touching grains", fmt::format("{:.2f}", s.coordination_number));
  line("contact area over surface", fmt::format("{:.3f}", s.contact_area_ratio));
  if (s.bonds) {
    line("intact bonds, area", fmt::format("{}  {:.4g} mm^2", s.bonds->unbroken, s.bonds->area));
    line("mean damage of bonds", fmt::format("{:.4f}", s.bonds->mean_damage));
  }
  for (std::size_t i = 0; i < s.profile_name.size(); ++i)
    line(i == 0 ? "wall time in" : "", fmt::format("{:5.1f} %  {}", 100 * s.profile_share[i], s.profile_name[i]));
  return text;
}

std::string to_csv(const Summary& summary) {
  std::string text = "name,value\n";
  const auto json = to_json(summary);
  for (const auto& [name, value] : json.items())
    if (value.is_number() && std::isfinite(value.get<double>())) text += fmt::format("{},{}\n", name, value.dump());
  return text;
}

std::string cost_of_runs(const std::vector<Summary>& runs) {
  double steps = 0, wall = 0, core = 0;
  for (const Summary& run : runs) {
    steps += run.nanoseconds_per_tet_step > 0 ? run.wall_time / run.nanoseconds_per_tet_step * 1e9 : 0;
    wall += run.wall_time;
    core += run.wall_time * run.threads;
  }
  return fmt::format("{},{:.4g},{:.1f},{:.1f}\n", runs.size(), steps, wall, core);
}

} // namespace mpfem
