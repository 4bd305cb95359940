#include "solver/run/step_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/index.hpp"
#include "solver/kernels/largest_frequency.hpp"

namespace mpfem {

namespace {

// The stable step of a grain is estimated again when its tets may have strained by this much since, or after so many
// steps. A strain e changes a tet's gradients by e and its volume by up to 1.7 e, so its frequency, which goes with the
// gradients and the root of the volume, by less than 2 e = 4 %: well within the 10 % that time_step_factor leaves.
constexpr double strain_between_estimates = 0.02;
constexpr int steps_between_estimates = 50;
/// When a grain is due by its strain, those that have strained by this share of the limit are estimated with it, so
/// that they do not come one after another.
constexpr double share_of_limit_to_join = 0.5;
/// The frequency of a whole grain is computed once in so many of its estimates: some twenty products with the
/// stiffness. In between, its square is assumed to grow as that of the grain's fastest growing tet, plus the growth of
/// contact at its nodes. If that would shorten the packing's step, it is computed again, unless it has grown by less
/// than this.
constexpr int estimates_between_spectra = 10;
constexpr double growth_worth_a_spectrum = 1.01;

/// Share of the critical damping that quadratic bulk viscosity may reach in a volume change at `rate` (1/s).
double largest_quadratic_damping(const Model& model, double rate) {
  const double size = *std::max_element(model.element_size.begin(), model.element_size.end());
  double slowest = std::numeric_limits<double>::infinity();
  for (const Material& material : model.material) slowest = std::min(slowest, material.wave_speed);
  return model.viscosity.quadratic * model.viscosity.quadratic * rate * size / slowest;
}

} // namespace

StepEstimate::StepEstimate(const Model& model, const NumericsParameters& numerics, const Communicator& ranks)
    : ranks_(&ranks), numerics_(numerics),
      grain_steps_(static_cast<std::size_t>(model.grains), static_cast<std::size_t>(model.nodes()), model.pages()),
      stiffness_rate_(static_cast<std::size_t>(model.nodes()), model.pages()) {}

double StepEstimate::add_strain(std::int32_t grain, double strain) {
  return grain_steps_.strain[at(grain)] += strain;
}

bool StepEstimate::is_due_after(const StrainOfStep& strain, double step) {
  state_.strain_rate = strain.largest / step;
  ++state_.steps_since_estimate;
  return all_are_due() || strain.since_estimate > strain_between_estimates;
}

bool StepEstimate::all_are_due() const {
  return state_.steps_since_estimate >= steps_between_estimates;
}

void StepEstimate::renew_after_next_step() {
  state_.steps_since_estimate = steps_between_estimates - 1;
}

/// What contact, walls and tools add to the frequencies of a grain's nodes.
void StepEstimate::set_stiffness_rate(const Surroundings& now, std::int32_t grain) {
  contact_stiffness_rate(now.model, now.contact, grain, stiffness_rate_);
  now.boundaries.box.add_stiffness_rate(now.model, now.bounds[at(grain)], grain, stiffness_rate_);
  now.boundaries.tools.add_stiffness_rate(now.model, now.bounds[at(grain)], grain, stiffness_rate_);
  raise_to_expected_rate(now.model, now.contact, grain, stiffness_rate_);
}

/// Whether the frequency of the whole grain is to be computed in this estimate.
bool StepEstimate::spectrum_is_due(const Surroundings& now, std::size_t grain) const {
  if (grain_steps_.estimates[grain] + 1 >= estimates_between_spectra) return true;
  // In an impact quadratic viscosity grows within one estimate.
  return now.rate > 2 * grain_steps_.rate[grain] && now.quadratic_damping > 0.01;
}

/// 1/s^2, squared frequency of the whole grain; `step` (s) that of its tets.
double StepEstimate::compute_spectrum(const Surroundings& now, std::int32_t grain, double step) {
  const std::size_t g = at(grain);
  const Model& model = now.model;
  double squared = largest_frequency(model, grain, stiffness_rate_, step, now.rate).squared;
  if (!std::isfinite(squared)) squared = std::numeric_limits<double>::infinity(); // the bound by its tets is left
  grain_steps_.whole[g] = 2.0 / std::sqrt(squared);
  grain_steps_.growth[g] = 1;
  grain_steps_.rate[g] = now.rate;
  grain_steps_.estimates[g] = 0;
  std::copy(stiffness_rate_.begin() + model.node_offset[g], stiffness_rate_.begin() + model.node_offset[g + 1],
            grain_steps_.contact.begin() + model.node_offset[g]);
  return squared;
}

/// 1/s^2, bound on the squared frequency of the whole grain from what has grown since it was computed; `growth`: of the
/// tets' since the last estimate.
double StepEstimate::bound_since_spectrum(const Model& model, std::int32_t grain, double growth) {
  const std::size_t g = at(grain);
  ++grain_steps_.estimates[g];
  grain_steps_.growth[g] *= growth;
  double contact = 0;
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n)
    contact = std::max(contact, stiffness_rate_[n] - grain_steps_.contact[n]);
  return 4.0 / (grain_steps_.whole[g] * grain_steps_.whole[g]) * grain_steps_.growth[g] + contact;
}

/// Estimates the stable step of a grain. `anew`: by the frequency of the whole grain as it is now.
void StepEstimate::estimate(const Surroundings& now, std::int32_t grain, bool anew) {
  const std::size_t g = at(grain);
  set_stiffness_rate(now, grain);
  const StableStep of_tets = mpfem::stable_step(now.model, grain, stiffness_rate_, now.rate);
  grain_steps_.step[g] = of_tets.step;
  grain_steps_.contact_share[g] = of_tets.step_no_contact > 0 ? of_tets.step / of_tets.step_no_contact : 0.0;
  grain_steps_.strain[g] = 0;
  if (numerics_.step_estimate != StepEstimateMethod::grain) return;
  const double squared = anew || spectrum_is_due(now, g) ? compute_spectrum(now, grain, of_tets.step)
                                                         : bound_since_spectrum(now.model, grain, of_tets.growth);
  grain_steps_.step[g] = std::max(of_tets.step, 2.0 / std::sqrt(squared));
}

/// The last estimate of a grain.
StepEstimate::GrainStep StepEstimate::last_estimate(std::int32_t grain) const {
  const std::size_t g = at(grain);
  const bool computed = numerics_.step_estimate != StepEstimateMethod::grain ||
                        grain_steps_.step[g] > grain_steps_.whole[g] / std::sqrt(growth_worth_a_spectrum);
  return {grain_steps_.step[g], grain_steps_.contact_share[g], computed ? 1.0 : 0.0};
}

/// Own grains that take part in this estimate.
std::vector<std::int32_t> StepEstimate::due_grains(const Model& model, bool all) const {
  std::vector<std::int32_t> due;
  for (const std::int32_t grain : model.own())
    if (all || grain_steps_.strain[at(grain)] > share_of_limit_to_join * strain_between_estimates) due.push_back(grain);
  return due;
}

/// Collective. The grain of all ranks with the shortest step, and of several the lowest.
std::int32_t StepEstimate::grain_with_shortest_step(const Ownership& ownership) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  double step = none, grain = ownership.own.empty() ? none : ownership.own.front();
  for (const std::int32_t own : ownership.own)
    if (grain_steps_.step[at(own)] < step) step = grain_steps_.step[at(own)], grain = own;
  const double shortest = -ranks_->largest(-step);
  return static_cast<std::int32_t>(-ranks_->largest(step == shortest ? -grain : -none));
}

/// Collective. The shortest step of all grains: the grain that sets it must do so by its computed frequency, not by a
/// bound on it.
StepEstimate::GrainStep StepEstimate::shortest_step(const Surroundings& now) {
  const Ownership& ownership = now.model.ownership;
  std::int32_t renewed = -1;
  while (true) {
    const std::int32_t grain = grain_with_shortest_step(ownership);
    GrainStep step = ownership.owns(grain) ? last_estimate(grain) : GrainStep{};
    std::array<double, 3> numbers{step.step, step.contact_share, step.computed}; // 0 on all ranks but one
    ranks_->combine({}, numbers);
    step = {numbers[0], numbers[1], numbers[2]};
    if (step.computed > 0 || grain == renewed) return step;
    if (ownership.owns(grain)) estimate(now, grain, true);
    renewed = grain;
  }
}

void StepEstimate::renew(Model& model, const Contact& contact, const Boundaries& boundaries,
                         std::span<const Bounds> bounds, ThreadTeam& team, bool anew) {
  const double rate = std::sqrt(3.0) * state_.strain_rate; // |tr e| <= sqrt(3) |e|
  const Surroundings now{model, contact, boundaries, bounds, rate, largest_quadratic_damping(model, rate)};
  const bool all = anew || all_are_due();
  const std::vector<std::int32_t> due = due_grains(model, all);
  team.for_each(static_cast<int>(due.size()), [&](int item, int) { estimate(now, due[at(item)], anew); });
  const GrainStep shortest = shortest_step(now);
  state_.stable_step = numerics_.time_step_factor * shortest.step;
  state_.controlled_by_contact = shortest.contact_share < 0.95;
  if (all) state_.steps_since_estimate = 0;
}

} // namespace mpfem
