#pragma once
// Spheres in a column, pressed between two walls through a list of approaches: forces, approaches and the surface state
// of every contact.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "solver/run/simulation.hpp"
#include "tests/support/hertz_column.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

struct ColumnSetup {
  double radius = 0.1; ///< mm, of every sphere
  ElementType element = ElementType::tet4;
  HardeningLaw law = HardeningLaw::elastic; ///< Table 1 of Ku, Zhao, Mollon and Zhao
  double stiffness_factor = 10;             ///< K = factor E/h
  ContactSurface surface = ContactSurface::facets;
  std::vector<double> approaches; ///< mm, nominal, of a sphere's centre towards each contact, growing
  double wall_speed = 4000;       ///< mm/s, of each wall
  double rest = 1e-6;             ///< s, of damping at every approach, walls at rest
  bool listed_from_top = false;   ///< grains stand in the packing from the top down instead of from the bottom up
};

/// What a column shows at rest. Approaches (mm) are those of a sphere's centre towards the contact; between two
/// spheres, half of the approach of both centres.
struct ColumnState {
  double low_force = 0, high_force = 0, pair_force = 0;                     ///< N, axial, compression positive
  double low_approach = 0, high_approach = 0, pair_approach = 0;            ///< mm
  double kinetic_over_elastic = 0, residual_over_work = 0, penetration = 0; ///< penetration over h
};

/// One or two spheres along z. Their centres are kept on the axis: a column of smooth spheres would buckle.
class PressedColumn {
public:
  /// `spheres`: meshes about their centres at the origin, from the bottom up.
  PressedColumn(std::vector<GrainMesh> spheres, const ColumnSetup& setup) : setup_(setup), team_(1) {
    const auto count = spheres.size();
    std::vector<double> center(count);
    double height = 0;
    for (std::size_t i = 0; i < count; ++i) {
      double low = 0, high = 0;
      for (const auto& x : spheres[i].node) low = std::min(low, x[2]), high = std::max(high, x[2]);
      const double apart = 1e-6 * setup.radius;
      center[i] = height + apart - low;
      height += high - low + 2 * apart;
    }
    for (std::size_t i = 0; i < count; ++i) move(spheres[i], {0.5, 0.5, center[i]});
    if (setup.listed_from_top) std::reverse(spheres.begin(), spheres.end());
    scenario_ = holding_scenario(1, setup.law);
    scenario_.walls = true;
    scenario_.numerics.element = setup.element;
    scenario_.numerics.own_pressure = usual_own_pressure(setup.element);
    scenario_.contact.stiffness_factor = setup.stiffness_factor;
    scenario_.contact.surface = setup.surface;
    scenario_.stages.clear();
    double before = height;
    for (const double approach : setup.approaches) {
      const double after = 2 * static_cast<double>(count) * (setup.radius - approach);
      UnconfinedCompression loading;
      loading.wall_speed = setup.wall_speed;
      loading.ramp_fraction = 0.3;
      loading.ends.axial_strain = std::log(before / after);
      Stage stage;
      stage.name = "press";
      stage.type = loading;
      // Near the critical damping of a sphere's resonance on its contacts: what moves is at rest after a microsecond.
      stage.damping = {1e7, 1e9};
      scenario_.stages.push_back(stage);
      Stage rest;
      rest.name = "rest";
      rest.type = Rest{setup.rest};
      rest.damping = stage.damping;
      scenario_.stages.push_back(rest);
      before = after;
    }
    simulation_ =
        std::make_unique<Simulation>(build_model(pack(spheres, {1, 1, height}), scenario_, "column"), scenario_, team_);
    for (std::size_t i = 0; i < count; ++i) center_offset_.push_back(center[i] - mean(model().position, i, 2));
  }

  /// Presses to the next approach of the list and lets the column come to rest; forces are evaluated afterwards.
  void press() {
    run_stage();
    run_stage();
  }

  ColumnState state() {
    const HistoryRow row = simulation_->observe();
    const double area = row.box_lengths[0] * row.box_lengths[1];
    const Cell& cell = simulation_->box().cell();
    ColumnState result;
    result.low_force = row.wall_stress[4] * area;
    result.high_force = row.wall_stress[5] * area;
    result.low_approach = setup_.radius - (center(0) - cell.low[2]);
    result.high_approach = setup_.radius - (cell.high[2] - center(count() - 1));
    if (count() == 2) {
      result.pair_approach = setup_.radius - 0.5 * (center(1) - center(0));
      const auto pairs = pair_contacts(model(), simulation_->contact());
      if (!pairs.empty()) result.pair_force = std::abs(pairs[0].force[2]);
    }
    result.kinetic_over_elastic = row.kinetic_energy / row.elastic_energy;
    result.residual_over_work = row.energy_residual / row.external_work;
    result.penetration = row.max_penetration;
    return result;
  }

  std::size_t count() const { return static_cast<std::size_t>(simulation_->model().grains); }
  /// Grain of the model that is sphere `i` from the bottom.
  std::size_t grain(std::size_t i) const { return setup_.listed_from_top ? count() - 1 - i : i; }
  Model& model() { return simulation_->model_to_disturb(); }
  Simulation& simulation() { return *simulation_; }

private:
  void run_stage() {
    if (started_) {
      simulation_->begin_next_stage();
      simulation_->advance();
    }
    started_ = true;
    for (;;) {
      simulation_->evaluate_forces();
      if (simulation_->stage_complete()) return;
      simulation_->advance();
      for (std::size_t i = 0; i < count(); ++i)
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double drift = mean(model().velocity, i, axis);
          for (std::size_t n = first_node(i); n < end_node(i); ++n) model().velocity[4 * n + axis] -= drift;
        }
    }
  }

  std::size_t first_node(std::size_t i) { return static_cast<std::size_t>(model().node_offset[grain(i)]); }
  std::size_t end_node(std::size_t i) { return static_cast<std::size_t>(model().node_offset[grain(i) + 1]); }
  double mean(const LazyArray<double>& rows, std::size_t i, std::size_t axis) {
    double sum = 0;
    for (std::size_t n = first_node(i); n < end_node(i); ++n) sum += rows[4 * n + axis] / model().inverse_mass[n];
    return sum / model().mass[grain(i)];
  }
  /// z of a sphere's centre: where its centre of mass has gone, from the sphere's own centre.
  double center(std::size_t i) { return mean(model().position, i, 2) + center_offset_[i]; }

  ColumnSetup setup_;
  ThreadTeam team_;
  Scenario scenario_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<double> center_offset_;
  bool started_ = false;
};

/// Force (N) of an elastic sphere on a plane, or on its like, at an approach (mm) of its centre: Hertz times the
/// finite-sphere factor. `radius` mm, `plane_strain_modulus` E/(1 - nu^2) MPa.
inline double finite_sphere_force(double approach, double radius, double plane_strain_modulus) {
  return finite_sphere_factor(2 * approach / radius) * 4.0 / 3.0 * plane_strain_modulus * std::sqrt(radius) *
         std::pow(approach, 1.5);
}

} // namespace mpfem::test
