#include "postproc/run_data/windows.hpp"

namespace mpfem {

Window axial_window(const StageCurve& curve, RowRange rows, const std::string& stress_name,
                    const std::vector<double>& stress) {
  Window window;
  window.stage = curve.stage;
  window.stage_type = curve.type;
  window.first_row = curve.first_row + rows.first;
  window.last_row = curve.first_row + rows.last;
  window.strain = range_of(curve.axial_strain, rows.first, rows.last);
  window.stress_name = stress_name;
  window.stress = range_of(stress, rows.first, rows.last);
  return window;
}

Window isotropic_window(const HistoryTable& history, const StageRows& stage, RowRange rows) {
  Window window;
  window.stage = stage.number;
  window.stage_type = stage.type;
  window.first_row = rows.first;
  window.last_row = rows.last;
  window.strain_name = "volumetric_strain";
  window.strain = range_of(history["volumetric_strain"], rows.first, rows.last);
  window.stress_name = "mean_stress";
  window.stress = range_of(history["mean_stress"], rows.first, rows.last);
  return window;
}

} // namespace mpfem
