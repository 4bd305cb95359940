#include "postproc/run_data/snapshot_window.hpp"

#include <algorithm>
#include <cmath>

#include "postproc/run_data/snapshot.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

SnapshotWindow snapshot_window(const schema::FileReader& file, int number) {
  namespace run = schema::run;
  const std::string name = snapshot_name(file, number);
  const auto names = file.snapshots();
  SnapshotWindow window;
  window.number = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  window.relative_density = file.read_scalar(run::snapshots_relative_density, name);
  window.mean_stress = file.read_scalar(run::snapshots_mean_stress, name);
  const double time = file.read_scalar(run::snapshots_time, name);
  const HistoryTable history(file, NotFinite::kept); // a snapshot may be sound though the run diverged later
  const auto& times = history["time"];
  std::size_t nearest = 0;
  for (std::size_t row = 0; row < history.rows(); ++row)
    if (std::abs(times[row] - time) < std::abs(times[nearest] - time)) nearest = row;
  window.stage = static_cast<int>(history["stage"][nearest]);
  window.stage_type = stage_by_number(stages_of(history, scenario_facts(file)), window.stage, file.path()).type;
  return window;
}

} // namespace mpfem
