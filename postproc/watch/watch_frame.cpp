#include "postproc/watch/watch_frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/one_line.hpp"
#include "common/progress.hpp"
#include "common/stage_energy.hpp"
#include "postproc/watch/character_plot.hpp"

namespace mpfem {

namespace {

/// Internal energy (mJ) of the stage of the last row.
double internal_energy_at_end(const std::vector<ProgressRow>& rows) {
  std::vector<StageEnergyRow> energies;
  energies.reserve(rows.size());
  for (const ProgressRow& row : rows) energies.push_back({row.stage, row.stored, row.dissipated});
  return stage_internal_energy(energies).back();
}

std::string_view words_of(AtWork at_work) {
  switch (at_work) {
  case AtWork::yes:
    return "mpfem is running";
  case AtWork::unknown:
    return "mpfem is running on another machine, or was killed";
  case AtWork::no:
    break;
  }
  return "no mpfem is running (--resume continues)";
}

std::string heading(const RunProgress& progress, double now) {
  const std::string age = duration_text(std::max(0.0, now - progress.written));
  if (progress.ended())
    return fmt::format("{}: {}, {} ago\n", shown_path(progress.file), one_line(progress.status), age);
  return fmt::format("{}: {}, written {} ago\n", shown_path(progress.file), words_of(progress.at_work), age);
}

/// "stage 2 of 3: unloading (isotropic_unloading), 40 % of its expected time"
std::string stage_line(const RunProgress& progress) {
  const auto number = static_cast<std::size_t>(std::max(0.0, progress.rows.back().stage));
  const auto& stages = progress.plan.stages;
  std::string text = fmt::format("stage     {}", number + 1);
  if (number < stages.size())
    text +=
        fmt::format(" of {}: {} ({})", stages.size(), shortened(stages[number].name), shortened(stages[number].type));
  if (!progress.ended()) text += fmt::format(", {:.0f} % of its expected time", 100 * stage_share(progress));
  return text + "\n";
}

/// Time (s) until the expected end of the current stage; empty where the pace is not known or that time is over.
std::optional<double> remaining(const RunProgress& progress, double now) {
  if (progress.ended() || !progress.seconds_per_stage) return {};
  const double left = (1 - stage_share(progress)) * *progress.seconds_per_stage;
  return left > 0 ? std::optional(std::max(0.0, left - (now - progress.written))) : std::nullopt;
}

std::string end_line(const RunProgress& progress, double now) {
  if (progress.ended()) return {};
  const auto left = remaining(progress, now);
  std::string text =
      "remaining " + (left ? duration_text(*left) + " to the expected end of the stage" : "not known yet");
  const auto done = static_cast<std::size_t>(progress.rows.back().stage) + 1;
  if (progress.plan.stages.size() > done)
    text += fmt::format(", then {} more stage{}", progress.plan.stages.size() - done,
                        progress.plan.stages.size() - done == 1 ? "" : "s");
  return text + "\n";
}

std::string state_lines(const RunProgress& progress) {
  const auto& rows = progress.rows;
  const ProgressRow& row = rows.back();
  const double internal = internal_energy_at_end(rows);
  std::string text = fmt::format("step      {:.0f}, time {:.4f} µs, time step {:.4f} ns\n", progress.step,
                                 1e6 * row.time, 1e9 * row.time_step);
  text += fmt::format("state     relative density {:.4f}, penetration {:.3g} of the element size\n          mean "
                      "stress p {:.4g} MPa, deviatoric stress q {:.4g} MPa\n",
                      row.relative_density, row.penetration, row.mean_stress, row.deviatoric_stress);
  text +=
      fmt::format("energy    kinetic/internal {}, residual/work {}\n          stored {:.4g} mJ, dissipated {:.4g} mJ\n",
                  internal > 0 ? fmt::format("{:.2e}", row.kinetic / internal) : "-",
                  row.external_work > 0 ? fmt::format("{:.2e}", row.residual / row.external_work) : "-", row.stored,
                  row.dissipated);
  return text;
}

std::string curve(const std::vector<ProgressRow>& rows, int width) {
  std::vector<double> density, stress;
  for (const ProgressRow& row : rows) density.push_back(row.relative_density), stress.push_back(row.mean_stress);
  constexpr int numbers = 14, narrowest = 20, widest = 100;
  return draw(
      {.x_label = "relative density", .y_label = "p / MPa", .columns = std::clamp(width - numbers, narrowest, widest)},
      density, stress);
}

} // namespace

std::string watch_frame(const RunProgress& progress, double now, int width) {
  if (progress.rows.empty())
    return "mpfem has started this run; its first checkpoint comes after output.checkpoint_interval (60 s by "
           "default)\n";
  std::string text = heading(progress, now);
  for (std::size_t i = 0; i < progress.stage_ends.size(); ++i)
    text +=
        fmt::format("done      {}: ended by {}\n",
                    i < progress.plan.stages.size() ? shortened(progress.plan.stages[i].name) : fmt::to_string(i + 1),
                    shortened(progress.stage_ends[i], 100));
  return text + stage_line(progress) + state_lines(progress) + end_line(progress, now) + "\n" +
         curve(progress.rows, width);
}

} // namespace mpfem
