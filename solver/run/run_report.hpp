#pragma once
// What a run prints on standard error. It is given values and decides what is said of them; it does not look into the
// time loop.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/progress.hpp"
#include "solver/output/history_row.hpp"
#include "solver/output/stage_result.hpp"
#include "solver/run/profile.hpp"

namespace mpfem {

/// Where a run is.
struct RunPosition {
  std::int64_t step = 0;
  double relative_density = 0;
  double mean_stress = 0; ///< MPa
};

/// What decides whether a row of the history becomes a report line, and what the line says besides the row.
struct RowReport {
  std::int64_t rows_in_stage = 1;     ///< with this one
  int rows_expected = 1;              ///< in a stage: output.history_rows
  bool ends_stage = false;            ///< always reported
  bool controlled_by_contact = false; ///< the time step, otherwise by elements
  double nanoseconds = 0;             ///< per tet and step
};

/// The messages of one run. Only the first rank prints, and with --quiet only warnings and what happened to files.
class RunReport {
public:
  /// `is_root`: whether this is the first rank.
  RunReport(bool is_root, bool quiet);

  void note(const std::string& text) const;
  /// For what was done to a file of the user.
  void note_despite_quiet(const std::string& text) const;
  void warning(const std::string& text) const;

  // ---- while the run goes on
  /// A line of fixed width for the last row of `history`; twenty a stage are printed.
  void row(const std::vector<HistoryRow>& history, const RowReport& about);
  /// How a stage ended. `history` ends with the stage's last row; `damped`: with mass-proportional damping.
  void stage_end(const StageResult& result, const std::vector<HistoryRow>& history, bool damped) const;
  /// `fraction` of the run is done.
  void progress(double fraction, const RunPosition& position);

  // ---- each warns once if the value calls for it
  /// `error`: residual of the energy balance over its largest term.
  void energy_error(double error, double step);
  /// `stable_step`: s. A run whose step collapses hardly writes rows that would show it.
  void stable_step(double stable_step);
  /// Once a stage: its tolerances require a lower speed than the scenario allows.
  void slowest_speed(const std::string& stage, double relative_density);

  // ---- when the run is complete
  void finish(const RunPosition& position, const std::string& output);
  /// `wall_time`: s, of all parts; `tet_steps`: tets times steps.
  void profile(std::span<const PartTime> parts, double wall_time, double tet_steps) const;
  /// What makes the results doubtful. It comes last of all, so that it is seen.
  void quality(const std::vector<HistoryRow>& history) const;

private:
  void head_of_rows();

  bool is_root_, quiet_;
  Progress progress_;
  int reported_lines_ = 0;
  double first_stable_step_ = 0; ///< s, 0: not known yet
  bool warned_of_step_ = false, warned_of_energy_ = false;
  std::string warned_of_stage_; ///< name of the last stage that was at its slowest speed
};

} // namespace mpfem
