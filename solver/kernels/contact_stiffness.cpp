#include "solver/kernels/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "common/index.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem {

void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  std::fill(rate.begin() + first, rate.begin() + model.node_offset[g + 1], 0.0);
  const auto add = [&](std::int32_t node, double stiffness) {
    rate[at(node)] += stiffness * model.inverse_mass[at(node)];
  };
  const auto share = [](const ContactForce& point) {
    return contact_stiffness_bound(point.stiffness, point.weight(0), point.weight(1), point.weight(2));
  };
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points) {
        add(point.node, share(point));
        if (!model.inner_node.empty())
          add(model.inner_node[at(point.node)], model.inward[at(point.node)] * share(point));
      }
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::int32_t pair = candidates.incoming_pair[at(i)];
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points)
        for (int c = 0; c < 3; ++c) add(point.facet_node[c], std::abs(point.weight(c)) * share(point));
  }
}

namespace {

/// A node of a grain that is r times as coarse adds r^2/(1 + r) times the rate expected of an equal grain (the harmonic
/// mean of both penalties, r^2 times the area). Below r = 1.5 that is less.
void raise_near_coarser_grains(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  constexpr double coarser = 1.5;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::size_t pair = at(candidates.incoming_pair[at(i)]), other = at(candidates.pair_first[pair]);
    if (model.element_size[other] < coarser * model.element_size[g]) continue;
    const double stiffness = pass_stiffness(model.penalty_stiffness[other], model.penalty_stiffness[g]);
    for (std::int32_t p = candidates.pair_point_offset[pair]; p < candidates.pair_point_offset[pair + 1]; ++p) {
      const std::size_t node = at(candidates.point_node[at(p)]);
      const double k = stiffness * model.local_stiffness(node) * model.reference_area[node] *
                       raised_by_bonds(contact.bond_laws, 2 * stiffness * model.local_stiffness(node));
      for (std::int32_t f = candidates.point_facet_offset[at(p)]; f < candidates.point_facet_offset[at(p) + 1]; ++f)
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::size_t touched = at(model.facet[3 * at(candidates.point_facet[at(f)]) + corner]);
          rate[touched] = std::max(rate[touched], expected_contact_rate(k, model.inverse_mass[touched]));
        }
    }
  }
}

/// Against a much stiffer neighbour a grain meets up to twice the stiffness that it meets in an equal grain: the
/// harmonic mean of both penalties over its own. Smaller contrasts, such as those between grains of different size, are
/// left to the estimates that follow.
double stiffness_contrast(const Model& model, const Contact& contact, int grain) {
  constexpr double least_contrast = 1.5;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  double contrast = 1;
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::size_t other = at(candidates.pair_first[at(candidates.incoming_pair[at(i)])]);
    const double mean =
        2 * pass_stiffness(model.penalty_stiffness[other], model.penalty_stiffness[g]) / model.penalty_stiffness[g];
    if (mean > least_contrast) contrast = std::max(contrast, mean);
  }
  return contrast;
}

} // namespace

void raise_to_expected_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  const double contrast = stiffness_contrast(model, contact, grain);
  for (std::int32_t node = first; node < first + model.surface_node_count[g]; ++node) {
    const double penalty = model.penalty_stiffness[g] * model.local_stiffness(at(node));
    const double raised = contrast * raised_by_bonds(contact.bond_laws, penalty) * penalty;
    const double expected =
        expected_contact_rate(raised * model.reference_area[at(node)], model.inverse_mass[at(node)]);
    rate[at(node)] = std::max(rate[at(node)], expected);
  }
  raise_near_coarser_grains(model, contact, grain, rate);
}

} // namespace mpfem
