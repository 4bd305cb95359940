#pragma once
// Which array is in which dataset of a checkpoint; shared by writing and reading.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "results-schema/descriptors.hpp"
#include "solver/boundary/surface_adhesion.hpp"
#include "solver/boundary/surface_friction.hpp"
#include "solver/kernels/contact_state.hpp"
#include "solver/model/grain_steps.hpp"
#include "solver/model/model.hpp"

namespace mpfem::checkpoint_datasets {

namespace check = schema::checkpoint;

/// Calls visit(dataset, array) for every array of rows of nodes.
template <class ModelType, class Visitor>
void for_each_node_array(ModelType& model, Visitor&& visit) {
  visit(check::node_position, model.position);
  visit(check::node_velocity, model.velocity);
  visit(check::node_force, model.force);
}

/// Calls visit(dataset, place) for every number that a tet keeps; place(block) gives its lanes.
template <class Visitor>
void for_each_tet_array(Visitor&& visit) {
  visit(
      check::tet_deviator_xx, [](auto& b) -> auto& { return b.deviator[0]; });
  visit(
      check::tet_deviator_yy, [](auto& b) -> auto& { return b.deviator[1]; });
  visit(
      check::tet_deviator_xy, [](auto& b) -> auto& { return b.deviator[2]; });
  visit(
      check::tet_deviator_yz, [](auto& b) -> auto& { return b.deviator[3]; });
  visit(
      check::tet_deviator_zx, [](auto& b) -> auto& { return b.deviator[4]; });
  visit(
      check::tet_flow_stress, [](auto& b) -> auto& { return b.flow_stress; });
  visit(
      check::tet_plastic_strain, [](auto& b) -> auto& { return b.plastic_strain; });
  visit(
      check::tet_length, [](auto& b) -> auto& { return b.length; });
}

/// The same for arrays with one number for each grain.
template <class Steps, class ContactType, class Visitor>
void for_each_grain_array(Steps& steps, ContactType& contact, Visitor&& visit) {
  visit(check::grain_step, steps.step);
  visit(check::grain_step_contact_share, steps.contact_share);
  visit(check::grain_step_strain, steps.strain);
  visit(check::grain_step_whole, steps.whole);
  visit(check::grain_step_growth, steps.growth);
  visit(check::grain_step_rate, steps.rate);
  visit(check::grain_step_estimates, steps.estimates);
  visit(check::grain_travel, contact.travel);
  visit(check::grain_travel_at_search, contact.travel_at_search);
}

/// The same for arrays with one number for each pair of grains.
template <class ContactType, class Visitor>
void for_each_pair_array(ContactType& contact, Visitor&& visit) {
  visit(check::contact_pair_first, contact.candidates.pair_first);
  visit(check::contact_pair_second, contact.candidates.pair_second);
}

/// The same for arrays with one number for each contact point.
template <class ContactType, class Visitor>
void for_each_point_array(ContactType& contact, Visitor&& visit) {
  visit(check::contact_point_node, contact.candidates.point_node);
  visit(check::contact_point_facet, contact.point_facet);
  visit(check::contact_point_wake, contact.point_open_until);
  visit(check::contact_point_sure, contact.point_facet_until);
}

// ---- structs as rows of numbers

/// Numbers in a row of this type: the length of the second dimension of its dataset.
template <class Row>
inline constexpr std::size_t width = std::tuple_size_v<Row>;

/// A bond or an anchor as numbers, in the order of row_of().
using Row = std::array<double, 6>;
/// A contact point with friction as numbers, in the order of row_of().
using FrictionRow = std::array<double, 8>;

/// Shape functions of the facet's second and third node; effective separation at which damage began and the largest one
/// (mm); share of the stiffness that remains; N/mm dissipated by earlier bonds of the point. The facet and the law have
/// separate datasets.
inline Row row_of(const PointBond& bond) {
  return {bond.weight1,       bond.weight2,   bond.state.initiation,
          bond.state.largest, bond.remaining, bond.dissipated_before};
}
/// The bond of such a row; `v` holds 6 numbers.
inline PointBond bond_of(std::int32_t facet, std::int32_t law, std::span<const double> v) {
  PointBond bond;
  bond.facet = facet;
  bond.law = law;
  bond.weight1 = v[0], bond.weight2 = v[1];
  bond.state = {v[2], v[3]};
  bond.remaining = v[4];
  bond.dissipated_before = v[5];
  return bond;
}

/// Shape functions of the facet's second and third node, stiffness (N/mm), force (N; x, y, z), stored and dissipated
/// energy (mJ). The facet has a separate dataset.
inline FrictionRow row_of(const PointFriction& point) {
  return {point.weight1, point.weight2, point.stiffness, point.force.x,
          point.force.y, point.force.z, point.stored,    point.dissipated};
}
/// The contact point of such a row; `v` holds 8 numbers.
inline PointFriction friction_of(std::int32_t facet, std::span<const double> v) {
  return {facet, v[0], v[1], v[2], {v[3], v[4], v[5]}, v[6], v[7]};
}

/// Place of the anchor on the surface (mm) and friction force (N), each x, y, z.
inline Row row_of(const SurfaceAnchor& anchor) {
  return {anchor.place.x, anchor.place.y, anchor.place.z, anchor.force.x, anchor.force.y, anchor.force.z};
}
/// The anchor of such a row; `v` holds 6 numbers.
inline SurfaceAnchor anchor_of(std::int32_t node, std::span<const double> v) {
  return {node, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

/// Place of the bond on the tool (mm; x, y, z), effective separation at which damage began and the largest one (mm),
/// share of the stiffness that remains.
inline Row row_of(const SurfaceBond& bond) {
  return {bond.place.x, bond.place.y, bond.place.z, bond.state.initiation, bond.state.largest, bond.remaining};
}
/// The bond of such a row; `v` holds 6 numbers.
inline SurfaceBond tool_bond_of(std::int32_t node, std::span<const double> v) {
  SurfaceBond bond;
  bond.node = node;
  bond.place = {v[0], v[1], v[2]};
  bond.state = {v[3], v[4]};
  bond.remaining = v[5];
  return bond;
}

// ---- anchors and bonds between rigid surfaces and nodes, by grain, surface and node

/// Datasets of one kind of anchors or bonds; all three have one row for each of them.
struct SurfaceDatasets {
  const decltype(check::wall_friction_node)& node;
  const decltype(check::wall_friction_side)& surface;
  const decltype(check::wall_friction_values)& values;
};
/// Faces of the box.
inline constexpr std::size_t walls = 6;
/// Friction at the walls.
inline constexpr SurfaceDatasets wall_anchors{check::wall_friction_node, check::wall_friction_side,
                                              check::wall_friction_values};
/// Friction at the tools.
inline constexpr SurfaceDatasets tool_anchors{check::tool_friction_node, check::tool_friction_tool,
                                              check::tool_friction_values};
/// Bonds of grains to tools (adhesion).
inline constexpr SurfaceDatasets tool_bonds{check::tool_adhesion_node, check::tool_adhesion_tool,
                                            check::tool_adhesion_values};

} // namespace mpfem::checkpoint_datasets
