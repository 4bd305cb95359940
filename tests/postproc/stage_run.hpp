#pragma once
// Runs whose history is written down row by row: what a metric should find in them is known.

#include <random>

#include "postproc/run_data/stage_curve.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"

namespace mpfem::test {

/// One history row; what is not given stays 0. The box is a cube of 1 mm at the start of the run.
struct Row {
  int stage = 0;
  double axial_strain = 0, lateral_strain = 0; ///< logarithmic, compression positive
  double axial_stress = 0, lateral_stress = 0; ///< MPa
  double relative_density = 0.6;               ///< free, so that a test can say what it wants
  double plastic = 0, damage = 0, elastic = 0; ///< mJ
  double contact_area = 0, coordination = 0;   ///< mm^2 of 10 mm^2, 1
  double bonded_area = 0, mean_damage = 0;     ///< mm^2, 1
  double residual = 0;                         ///< mJ, of the ledger
};

inline RunContents run_of(const std::vector<Row>& rows, const std::string& scenario = "text") {
  RunContents c = small_run();
  std::erase_if(c.numbers, [](const auto& entry) { return entry.first.starts_with("/history/"); });
  c.extents["rows"] = rows.size();
  auto& n = c.numbers;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    n["/history/time"].push_back(1e-6 * static_cast<double>(i));
    n["/history/step"].push_back(static_cast<double>(i));
    n["/history/stage"].push_back(r.stage);
    n["/history/relative_density"].push_back(r.relative_density);
    for (const double strain : {r.lateral_strain, r.lateral_strain, r.axial_strain})
      n["/history/box_lengths"].push_back(std::exp(-strain));
    for (int side = 0; side < 6; ++side)
      n["/history/wall_stress"].push_back(side < 4 ? r.lateral_stress : r.axial_stress);
    n["/history/mean_stress"].push_back((r.axial_stress + 2 * r.lateral_stress) / 3);
    n["/history/deviatoric_stress"].push_back(r.axial_stress - r.lateral_stress);
    n["/history/axial_strain"].push_back(r.axial_strain);
    n["/history/volumetric_strain"].push_back(r.axial_strain + 2 * r.lateral_strain);
    n["/history/plastic_dissipation"].push_back(r.plastic);
    n["/history/damage_dissipation"].push_back(r.damage);
    n["/history/elastic_energy"].push_back(r.elastic);
    n["/history/surface_area"].push_back(10);
    n["/history/contact_area"].push_back(r.contact_area);
    n["/history/coordination_number"].push_back(r.coordination);
    n["/history/bonded_area"].push_back(r.bonded_area);
    n["/history/mean_damage"].push_back(r.mean_damage);
    n["/history/energy_residual"].push_back(r.residual);
  }
  c.texts["/provenance/scenario"] = {scenario};
  return c;
}

/// The history as a curve of its stage `number`, by way of a run file.
inline StageCurve curve_of(const Folder& folder, const RunContents& run, int number = 0) {
  write_run(folder / "curve.h5", run);
  const schema::FileReader file(folder / "curve.h5");
  const HistoryTable history(file);
  return stage_curve(history, stage_by_number(stages_of(history, {}), number, "curve.h5"), "curve.h5");
}

inline StageCurve curve_of(const Folder& folder, const std::vector<Row>& rows, int number = 0) {
  return curve_of(folder, run_of(rows), number);
}

/// Normally distributed numbers, the same in every run of the tests.
class Noise {
public:
  explicit Noise(unsigned seed) : engine_(seed) {}
  /// By sums of twelve: std::normal_distribution differs between libraries.
  double operator()() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine_() - std::mt19937::min()) / 4294967295.0;
    return sum;
  }

private:
  std::mt19937 engine_;
};

} // namespace mpfem::test
