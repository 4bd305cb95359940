#include "solver/run/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "common/run_quality.hpp"
#include "common/stage_energy.hpp"
#include "solver/run/energy_check.hpp"
#include "solver/run/energy_terms.hpp"

namespace mpfem {

namespace {

constexpr std::int64_t lines_of_stage = 20;
constexpr int lines_below_head = 20;

/// Internal energy (mJ) of the stage that each row belongs to.
std::vector<double> internal_energy(const std::vector<HistoryRow>& history) {
  std::vector<StageEnergyRow> rows;
  for (const HistoryRow& row : history) rows.push_back({row.stage, stored_energy(row), dissipated_energy(row)});
  return stage_internal_energy(rows);
}

/// "ended by axial strain 0.15; stresses held within 0.05 MPa (0.6 %)"
std::string stage_end_text(const StageResult& result) {
  std::string text = "ended by " + result.ended_by;
  if (result.overshoot > 0) text += fmt::format("; target stress exceeded by {:.3g} MPa", result.overshoot);
  if (result.hold_stress > 0 && result.missed.empty())
    text += fmt::format("; stresses held within {:.3g} MPa ({:.3g} %), {:.3g} MPa root mean square", result.hold_error,
                        100 * result.hold_error / result.hold_stress, result.hold_root_mean_square);
  return text;
}

/// What mass-proportional damping took in the stage of the last row, compared with the elastic energy, which it must
/// not touch. It gives energy when it drags grains along with the walls.
std::string damping_text(const std::vector<HistoryRow>& history) {
  const double stage = history.back().stage;
  double before = 0, elastic = 0;
  for (const HistoryRow& row : history) {
    if (row.stage < stage) before = row.damping_dissipation;
    if (row.stage == stage) elastic = std::max(elastic, row.elastic_energy);
  }
  const double taken = history.back().damping_dissipation - before;
  if (!(elastic > 0)) return {};
  return fmt::format("; damping {} {:.3g} % of the elastic energy", taken < 0 ? "added" : "removed",
                     100 * std::abs(taken) / elastic);
}

} // namespace

RunReport::RunReport(bool is_root, bool quiet)
    : is_root_(is_root), quiet_(quiet || !is_root), progress_("mpfem", quiet_) {}

void RunReport::note(const std::string& text) const {
  if (!quiet_) note_despite_quiet(text);
}

void RunReport::note_despite_quiet(const std::string& text) const {
  if (is_root_) fmt::print(stderr, "mpfem: {}\n", text);
}

void RunReport::warning(const std::string& text) const {
  if (is_root_) fmt::print(stderr, "mpfem: warning: {}\n", text);
}

void RunReport::head_of_rows() {
  constexpr const char* head = "{:>8} {:>10} {:>10} {:>8} {:>8} {:>9} {:>10} {:>8} {:>9} {:>11} {:>8}\n";
  fmt::print(stderr, head, "step", "time", "time step", "step set", "relative", "mean", "deviatoric", "kinetic/",
             "residual/", "penetration", "ns per");
  fmt::print(stderr, head, "", "µs", "ns", "by", "density", "p, MPa", "q, MPa", "internal", "work", "/ element",
             "tet-step");
}

void RunReport::row(const std::vector<HistoryRow>& history, const RowReport& about) {
  if (quiet_) return;
  const std::int64_t every = std::max<std::int64_t>(1, about.rows_expected / lines_of_stage);
  if ((about.rows_in_stage - 1) % every != 0 && !about.ends_stage) return;
  if (reported_lines_++ % lines_below_head == 0) head_of_rows();
  const HistoryRow& row = history.back();
  const double internal = internal_energy(history).back();
  fmt::print(
      stderr, "{:>8.0f} {:>10.4f} {:>10.4f} {:>8} {:>8.4f} {:>9.4g} {:>10.3g} {:>8} {:>9.2e} {:>11.4f} {:>8.1f}\n",
      row.step, row.time * 1e6, row.time_step * 1e9, about.controlled_by_contact ? "contact" : "element",
      row.relative_density, row.mean_stress, row.deviatoric_stress,
      row.kinetic_energy < 1e3 * internal ? fmt::format("{:.2e}", row.kinetic_energy / internal) : "-",
      row.external_work > 0 ? row.energy_residual / row.external_work : 0.0, row.max_penetration, about.nanoseconds);
}

void RunReport::stage_end(const StageResult& result, const std::vector<HistoryRow>& history, bool damped) const {
  note(fmt::format("stage '{}' {}{}", result.name, stage_end_text(result), damped ? damping_text(history) : ""));
  if (!result.missed.empty())
    warning(
        fmt::format("stage '{}' ended before these tools reached the force that they hold: {}; use a longer stage or "
                    "a larger servo_speed",
                    result.name, result.missed));
}

void RunReport::progress(double fraction, const RunPosition& position) {
  progress_.update(fraction, fmt::format("step {}  relative density {:.4f}  mean stress {:.4g} MPa", position.step,
                                         position.relative_density, position.mean_stress));
}

void RunReport::energy_error(double error, double step) {
  if (error <= EnergyCheck::warning_limit || warned_of_energy_) return;
  warned_of_energy_ = true;
  warning(fmt::format("the energy balance is off by {:.3g} % of its largest term at step {:.0f}", 100 * error, step));
}

void RunReport::stable_step(double stable_step) {
  if (first_stable_step_ == 0) first_stable_step_ = stable_step;
  if (stable_step >= doubtful_step_share * first_stable_step_ || warned_of_step_) return;
  warned_of_step_ = true;
  warning(fmt::format("the stable step fell from {:.3g} s to {:.3g} s: some elements are nearly flat, and the run "
                      "keeps slowing down",
                      first_stable_step_, stable_step));
}

void RunReport::slowest_speed(const std::string& stage, double relative_density) {
  if (warned_of_stage_ == stage) return;
  warned_of_stage_ = stage;
  warning(fmt::format("stage '{}', relative density {:.4f}: the tolerances of quasi_static are not met even at "
                      "slowest_speed",
                      stage, relative_density));
}

void RunReport::finish(const RunPosition& position, const std::string& output) {
  progress_.finish(fmt::format("{} steps, relative density {:.4f}, mean stress {:.4g} MPa, {}", position.step,
                               position.relative_density, position.mean_stress, output));
}

void RunReport::profile(std::span<const PartTime> parts, double wall_time, double tet_steps) const {
  if (quiet_) return;
  fmt::print(stderr, "{:<24} {:>12} {:>8} {:>15}\n", "part", "wall time, s", "share", "ns per tet-step");
  const auto line = [&](const std::string& name, double seconds) {
    const std::string of_tet_step = tet_steps > 0 ? fmt::format("{:.2f}", 1e9 * seconds / tet_steps) : "–";
    fmt::print(stderr, "{:<24} {:>12.2f} {:>7.1f}% {:>15}\n", name, seconds, 100 * seconds / wall_time, of_tet_step);
  };
  for (const PartTime& part : parts) line(part.name, part.seconds);
  line("total", wall_time);
}

void RunReport::quality(const std::vector<HistoryRow>& history) const {
  const std::vector<double> internal = internal_energy(history);
  std::vector<QualityRow> rows;
  for (const HistoryRow& row : history)
    rows.push_back({row.external_work, row.energy_residual, row.kinetic_energy, internal[rows.size()], row.mean_stress,
                    row.max_penetration, row.relative_density_current, row.time_step});
  for (const std::string& text : quality_warnings(rows)) warning(text);
}

} // namespace mpfem
