#include "solver/bench/work.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "solver/physics/counted.hpp"
#include "solver/physics/gap.hpp"
#include "solver/physics/penalty.hpp"
#include "solver/physics/tet4.hpp"

namespace mpfem {

namespace {

constexpr double row_bytes = 4 * sizeof(double);
constexpr double facet_bytes = 3 * sizeof(std::int32_t);

template <class Body>
double operations_of(const Body& body) {
  Counted::operations = 0;
  body();
  return static_cast<double>(Counted::operations);
}

/// A facet and a node above its interior: the longest path through the regions of a triangle.
const Vector3<Counted> facet[3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
const Vector3<Counted> node{0.25, 0.25, -0.1};

double operations_of_distance() {
  return operations_of([] { norm(node - closest_point_on_triangle(node, facet).point); });
}

double operations_of_point() {
  return operations_of([] {
    // As contact_forces() does for a touching point without bond,
    const ClosestPoint<Counted> closest = closest_point_on_triangle(node, facet);
    const Vector3<Counted> offset = node - closest.point;
    const Counted distance = norm(offset), h = 1.0, pass_stiffness = 1.0, area = 1.0;
    Counted energy = 0.0, depth = 0.0;
    dot(offset, facet_direction(facet));
    const Counted k = pass_stiffness * Counted(1.0) * area;
    const Vector3<Counted> push = penalty_force(k, offset);
    Vector3<Counted> force[4] = {};
    force[0] = force[0] + push;
    energy = energy + penalty_energy(k, distance);
    depth = max(depth, distance / h);
    // and contact_reactions() for the three nodes of its facet.
    const Counted weight[3] = {Counted(1.0) - closest.weight1 - closest.weight2, closest.weight1, closest.weight2};
    for (int c = 0; c < 3; ++c) force[c + 1] = force[c + 1] - weight[c] * push;
  });
}

} // namespace

Work work_of_tet(const Model& model) {
  Work work;
  const ElasticModuli moduli = elastic_moduli(5000, 0.3);
  const PowerLaw law{25, 125, 0.3};
  const Counted zero(0.0);
  const Vector3<Counted> edge[3] = {{1.0, zero, zero}, {zero, 1.0, zero}, {zero, zero, 1.0}};
  const Vector3<Counted> displacement[3] = {{1e-4, zero, zero}, {zero, -1e-4, zero}, {zero, zero, zero}};
  // On the yield surface at a plastic strain of 0.5, and moving on by 1e-4.
  const double flow = 25 + 125 * std::pow(0.5, 0.3);
  const TetState<Counted> state{{flow / std::sqrt(3.0), -flow / std::sqrt(3.0), zero, zero, zero}, {flow, 0.5}};
  work.operations = operations_of([&] {
    update_tet(law, TetConstants{moduli, {0.06, 1.2}, 2e6, 1.55e-9, 1e-4}, edge, displacement, state, Counted(6.0),
               Counted(1.0), [&](const Counted& ratio) { return mean_stress(moduli, ratio); });
  });
  // Block read; deviator, flow stress and plastic strain written; positions and velocities of nodes read, forces
  // written.
  work.bytes = with_tet_numbers(model, [](auto number) {
    using Block = TetBlock<decltype(number)>;
    return static_cast<double>(sizeof(Block) + sizeof(Block::deviator) + sizeof(Block::flow_stress) +
                               sizeof(Block::plastic_strain)) /
           Block::lanes;
  });
  work.bytes += 3 * row_bytes * model.nodes() / model.tets();
  return work;
}

Work work_of_contact(const Contact& contact) {
  const auto sum = [](const auto& counts) { return std::accumulate(counts.begin(), counts.end(), 0.0); };
  const double points = sum(contact.active), bonds = sum(contact.pulling);
  // For every candidate: when it is to be checked again, and whether it has a bond.
  const double candidates = static_cast<double>(contact.candidates.point_node.size()) *
                            (sizeof(double) + (contact.bond.empty() ? 0 : sizeof(PointBond::facet) + sizeof(double)));
  // A record of a force is written, and read for the reactions.
  const double record = 2 * sizeof(ContactForce);
  // For a point: its node, its facet and how long that stays the closest; the node's position, force and area; the
  // facet, its nodes' positions and forces. A bond usually lies on the same nodes, and adds its state.
  const double point =
      2 * sizeof(std::int32_t) + sizeof(double) + 3 * row_bytes + sizeof(double) + facet_bytes + 9 * row_bytes + record;
  const double bond = 2 * sizeof(PointBond) + record;
  return {points * operations_of_point(), candidates + points * point + bonds * bond};
}

Work work_of_search(const Model& model, const ContactCandidates& candidates) {
  Work work;
  for (std::size_t pair = 0; pair < candidates.pair_first.size(); ++pair) {
    const auto first = static_cast<std::size_t>(candidates.pair_first[pair]),
               second = static_cast<std::size_t>(candidates.pair_second[pair]);
    work.bytes += row_bytes * (model.surface_node_count[first] + model.surface_node_count[second]) +
                  facet_bytes * (model.facet_offset[second + 1] - model.facet_offset[second]);
  }
  const auto found = static_cast<double>(candidates.point_facet.size());
  work.bytes += sizeof(std::int32_t) *
                (found + static_cast<double>(candidates.point_node.size() + candidates.point_facet_offset.size()));
  work.operations = found * operations_of_distance();
  return work;
}

Work work_of_integration(const Model& model) {
  // Rows of position and velocity read and written, force and inverse mass read.
  const double bytes = 5 * row_bytes + sizeof(double);
  // Along each of three axes v <- keep v + gain/m f + pull target, its square summed, x <- x + step v; gain/m.
  const double operations = 3 * (5 + 2 + 2) + 1;
  return {operations * model.nodes(), bytes * model.nodes()};
}

} // namespace mpfem
