#include "solver/run/step_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "solver/kernels/largest_frequency.hpp"
#include "solver/parallel/grain_values.hpp"

namespace mpfem {

namespace {

// The estimate of the stable step is renewed when tets may have strained by this much since, or after so many steps. A
// strain e changes a tet's gradients by e and its volume by up to 1.7 e, so its frequency, which goes with the
// gradients and the root of the volume, by less than 2 e = 4 %: well within the 10 % that time_step_factor leaves.
constexpr double strain_between_estimates = 0.02;
constexpr int steps_between_estimates = 50;
/// The frequencies of all whole grains are computed once in so many estimates: some twenty products with the stiffness
/// each. In between, a grain's squared frequency is assumed to grow as that of its fastest growing tet, plus the growth
/// of contact at its nodes. If that would shorten the packing's step, it is computed again, unless it has grown by less
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
    : ranks_(&ranks), numerics_(numerics), of_tets_(static_cast<std::size_t>(model.grains)),
      stiffness_rate_(static_cast<std::size_t>(model.nodes()), model.pages()) {
  const auto grains = static_cast<std::size_t>(model.grains);
  grain_steps_ = {std::vector<double>(grains), std::vector<double>(grains),
                  LazyArray<double>(static_cast<std::size_t>(model.nodes()), model.pages())};
}

bool StepEstimate::is_due_after(double strain, double step) {
  state_.strain_rate = strain / step;
  state_.strain_since_estimate += strain;
  return ++state_.steps_since_estimate >= steps_between_estimates ||
         state_.strain_since_estimate > strain_between_estimates;
}

void StepEstimate::renew_after_next_step() {
  state_.steps_since_estimate = steps_between_estimates - 1;
}

/// s, by the frequency of the whole grain.
double StepEstimate::renew_grain(const Model& model, int grain, double rate) {
  const auto g = static_cast<std::size_t>(grain);
  const double squared = largest_frequency(model, grain, stiffness_rate_, of_tets_[g].step, rate).squared;
  grain_steps_.whole[g] = 2.0 / std::sqrt(squared);
  std::copy(stiffness_rate_.begin() + model.node_offset[g], stiffness_rate_.begin() + model.node_offset[g + 1],
            grain_steps_.contact.begin() + model.node_offset[g]);
  grain_steps_.growth[g] = 1;
  return std::max(of_tets_[g].step, grain_steps_.whole[g]);
}

/// 1/s^2, bound on the grain's squared frequency from what has grown since it was computed.
double StepEstimate::bound_since_spectrum(const Model& model, int grain, double found) const {
  const auto g = static_cast<std::size_t>(grain);
  double contact = 0;
  for (auto n = static_cast<std::size_t>(model.node_offset[g]); n < static_cast<std::size_t>(model.node_offset[g + 1]);
       ++n)
    contact = std::max(contact, stiffness_rate_[n] - grain_steps_.contact[n]);
  return found * grain_steps_.growth[g] + contact;
}

/// Whether the frequencies of whole grains are to be found in this estimate. `rate`: volumetric, 1/s.
bool StepEstimate::spectra_are_due(const Model& model, double rate) {
  if (++state_.estimates_since_spectrum >= estimates_between_spectra) return true;
  // In an impact quadratic viscosity grows within one estimate.
  return rate > 2 * state_.spectrum_rate && largest_quadratic_damping(model, rate) > 0.01;
}

/// What contact, walls and tools add to the frequencies of a grain's nodes.
void StepEstimate::set_stiffness_rate(const Model& model, const Contact& contact, const Boundaries& boundaries,
                                      const Bounds& bounds, int grain) {
  contact_stiffness_rate(model, contact, grain, stiffness_rate_);
  boundaries.box.add_stiffness_rate(model, bounds, grain, stiffness_rate_);
  boundaries.tools.add_stiffness_rate(model, bounds, grain, stiffness_rate_);
  raise_to_expected_rate(model, contact, grain, stiffness_rate_);
}

/// The step of a grain whose tets have just been estimated.
StepEstimate::GrainStep StepEstimate::step_of_grain(const Model& model, int grain, double rate, bool anew) {
  const auto g = static_cast<std::size_t>(grain);
  if (numerics_.step_estimate != StepEstimateMethod::grain) return {of_tets_[g].step, true};
  if (anew) return {renew_grain(model, grain, rate), true};
  const double then = 4.0 / (grain_steps_.whole[g] * grain_steps_.whole[g]);
  grain_steps_.growth[g] *= of_tets_[g].growth;
  const double now = bound_since_spectrum(model, grain, then);
  return {std::max(of_tets_[g].step, 2.0 / std::sqrt(now)), now < growth_worth_a_spectrum * then};
}

/// Collective. The grain with the shortest step: it must set the step by its computed frequency, not by a bound on it.
/// `steps` [grains].
std::size_t StepEstimate::compute_shortest(const Model& model, double rate, std::span<GrainStep> steps) {
  using Candidate = std::pair<double, std::size_t>; // step and grain
  std::vector<Candidate> candidates;
  for (std::size_t grain = 0; grain < steps.size(); ++grain) candidates.emplace_back(steps[grain].step, grain);
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> shortest({}, std::move(candidates));
  while (!steps[shortest.top().second].computed) {
    const std::size_t grain = shortest.top().second;
    shortest.pop();
    const bool own = model.ownership.owns(static_cast<std::int32_t>(grain));
    const double of_owner = own ? renew_grain(model, static_cast<int>(grain), rate) : 0.0;
    steps[grain] = {ranks_->largest(of_owner), true};
    shortest.emplace(steps[grain].step, grain);
  }
  return shortest.top().second;
}

void StepEstimate::renew(Model& model, const Contact& contact, const Boundaries& boundaries,
                         std::span<const Bounds> bounds, ThreadTeam& team, bool anew) {
  // |tr e| <= sqrt(3) |e|
  const double rate = std::sqrt(3.0) * state_.strain_rate;
  anew = anew || spectra_are_due(model, rate);
  if (anew) state_.estimates_since_spectrum = 0, state_.spectrum_rate = rate;

  std::vector<GrainStep> steps(of_tets_.size());
  team.for_each(static_cast<int>(model.own().size()), [&](int item, int) {
    const std::int32_t grain = model.own()[static_cast<std::size_t>(item)];
    const auto g = static_cast<std::size_t>(grain);
    set_stiffness_rate(model, contact, boundaries, bounds[g], grain);
    of_tets_[g] = mpfem::stable_step(model, grain, stiffness_rate_, rate);
    steps[g] = step_of_grain(model, grain, rate, anew);
  });
  share_of_grains(*ranks_, model.ownership, std::span(steps));
  share_of_grains(*ranks_, model.ownership, std::span(of_tets_));

  const std::size_t g = compute_shortest(model, rate, steps);
  state_.stable_step = numerics_.time_step_factor * steps[g].step;
  state_.controlled_by_contact = of_tets_[g].step < 0.95 * of_tets_[g].step_no_contact;
  state_.steps_since_estimate = 0;
  state_.strain_since_estimate = 0;
}

} // namespace mpfem
