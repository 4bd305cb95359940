#pragma once
// The grains: nodes, tetrahedra, surfaces and their state. A grain owns a contiguous range of everything.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/aligned.hpp"
#include "solver/model/material.hpp"
#include "solver/model/surface_view.hpp"
#include "solver/model/tet_block.hpp"
#include "solver/physics/stable_step.hpp"
#include "solver/physics/tensor.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Node arrays hold rows of four doubles (x, y, z, spare); the surface nodes of a grain are its first ones.
struct Model {
  int grains = 0;
  std::vector<Material> material;           ///< [materials]
  std::vector<std::int32_t> grain_material; ///< [grains], into `material`
  ElementType element = ElementType::tet4;
  double own_pressure = 0; ///< tet4_anp, tet4_patch: share of each tet's own pressure
  BulkViscosity viscosity{};

  std::vector<std::int32_t> node_offset;        ///< [grains + 1]
  std::vector<std::int32_t> surface_node_count; ///< [grains]
  std::vector<std::int32_t> tet_offset;         ///< [grains + 1]
  std::vector<std::int32_t> block_offset;       ///< [grains + 1]
  std::vector<std::int32_t> facet_offset;       ///< [grains + 1]
  std::vector<std::int32_t> spatial_order;      ///< [grains]: all of them, neighbours in space near each other
  std::vector<std::int32_t> facet;              ///< [facets * 3], outward counter-clockwise
  std::vector<std::int32_t> file_node;          ///< [nodes]: index in the packing file
  std::vector<std::int32_t> file_tet;           ///< [tets]: index in the packing file, in block order

  AlignedVector<double> position;     ///< mm
  AlignedVector<double> velocity;     ///< mm/s, at the half step before the position
  AlignedVector<double> force;        ///< N, internal and contact forces at the position
  AlignedVector<double> normal;       ///< unit outward normal of surface nodes and, fourth, tributary area mm^2
  std::vector<double> reference_area; ///< [nodes]: tributary area of surface nodes at the start, mm^2
  AlignedVector<double> inverse_mass; ///< [nodes], 1/tonne
  TetBlocks blocks;
  std::vector<double> inverse_nodal_volume; ///< [nodes], 1/mm^3, of the reference state; tet4_anp only
  std::vector<double> nodal_mean;           ///< [nodes], MPa: scratch of the element pass; tet4_anp only
  std::vector<std::int32_t> patch_offset;   ///< [grains + 1]; tet4_patch only
  std::vector<double>
      inverse_patch_volume; ///< [patches], 1/mm^3, of the reference state: eight tets that follow each other

  std::vector<double> reference_volume;  ///< [grains], mm^3
  std::vector<double> mass;              ///< [grains], tonne (scaled)
  std::vector<double> mass_factor;       ///< [nodes]: scaled over own mass; empty where nothing was scaled to a step
  double added_mass = 0;                 ///< by scaling to a step, over the mass of the packing
  double largest_added_mass = 0;         ///< the same of the grain that it concerns most
  std::vector<double> element_size;      ///< [grains], h: mean edge length of the surface facets, mm
  std::vector<double> penalty_stiffness; ///< [grains], K = factor E / h, MPa/mm
  bool uniform_penalty = false;          ///< K was given, and is the same wherever the mesh is refined
  std::vector<double> refinement; ///< [nodes]: h of the grain over that of the surface node's facets; empty where
                                  ///< no grain is locally refined
  std::vector<std::int32_t>
      inner_node;             ///< [nodes]: towards which a surface node's contact point lies; empty where contact
                              ///< takes the nodes themselves (solver/model/smooth_surface.hpp)
  std::vector<double> inward; ///< [nodes]: the inner node's share in the contact point
  int smooth_grains = 0;      ///< number of grains that touch by their smooth surface

  std::array<double, 3> box_low{}; ///< mm, at the start
  std::array<double, 3> box_high{};
  std::int64_t seed = -1;      ///< of the packing, -1 where unknown
  std::uint64_t mesh_hash = 0; ///< of nodes and tets as read

  std::int32_t nodes() const { return node_offset.back(); }
  std::int32_t tets() const { return tet_offset.back(); }
  std::int32_t facets() const { return facet_offset.back(); }
  const Material& material_of(int grain) const { return material[std::size_t(grain_material[std::size_t(grain)])]; }
  /// Block `index` of a model whose tets are in numbers of type Real.
  template <class Real>
  TetBlock<Real>& block(std::int32_t index) {
    return (*std::get_if<std::vector<TetBlock<Real>>>(&blocks))[static_cast<std::size_t>(index)];
  }
  template <class Real>
  const TetBlock<Real>& block(std::int32_t index) const {
    return (*std::get_if<std::vector<TetBlock<Real>>>(&blocks))[static_cast<std::size_t>(index)];
  }
  template <class Real>
  int tets_in_block(int grain, int block_index) const {
    constexpr int lanes = TetBlock<Real>::lanes;
    const int left = tet_offset[std::size_t(grain) + 1] - tet_offset[std::size_t(grain)] -
                     lanes * (block_index - block_offset[std::size_t(grain)]);
    return left < lanes ? left : lanes;
  }
  /// Nodes of tet `tet` of a grain, both counted from the grain's first.
  std::array<std::int32_t, 4> nodes_of_tet(int grain, std::int32_t tet) const;
  /// How much stiffer than its grain's mean the penalty of a surface node is: K = factor E / h with the h around the
  /// node. 1 where the scenario gives K itself.
  double local_stiffness(std::size_t node) const {
    return refinement.empty() || uniform_penalty ? 1.0 : refinement[node];
  }
  /// Where the gap of a surface node is measured, mm.
  double contact_coordinate(std::size_t node, std::size_t axis) const {
    const double x = position[4 * node + axis];
    if (inner_node.empty()) return x;
    return x + inward[node] * (position[4 * static_cast<std::size_t>(inner_node[node]) + axis] - x);
  }
  Vector3<double> contact_point(std::size_t node) const {
    return {contact_coordinate(node, 0), contact_coordinate(node, 1), contact_coordinate(node, 2)};
  }
  /// mm/s, of a surface node's contact point.
  Vector3<double> contact_velocity(std::size_t node) const {
    const auto row = [this](std::size_t n) {
      return Vector3<double>{velocity[4 * n], velocity[4 * n + 1], velocity[4 * n + 2]};
    };
    if (inner_node.empty()) return row(node);
    return row(node) + inward[node] * (row(static_cast<std::size_t>(inner_node[node])) - row(node));
  }
  /// Adds a force on a surface node's contact point, N.
  void push_contact_point(std::size_t node, std::size_t axis, double f) {
    if (inner_node.empty()) {
      force[4 * node + axis] += f;
      return;
    }
    force[4 * node + axis] += (1 - inward[node]) * f;
    force[4 * static_cast<std::size_t>(inner_node[node]) + axis] += inward[node] * f;
  }
  double total_reference_volume() const;
  SurfaceView surface() const;
  /// Bytes of all arrays.
  std::size_t memory() const;
};

/// f(double{}) or f(float{}), as the numbers of the model's tets are.
template <class F>
auto with_tet_numbers(const Model& model, F&& f) {
  return std::holds_alternative<std::vector<TetBlock<double>>>(model.blocks) ? f(double{}) : f(float{});
}

/// A meshed packing, as read from its file.
struct MeshedPacking {
  std::array<double, 3> box_lengths{};
  std::vector<double> node;                    ///< [nodes * 3], mm
  std::vector<std::int32_t> tet;               ///< [tets * 4]
  std::vector<std::int32_t> grain_node_offset; ///< [grains + 1]
  std::vector<std::int32_t> grain_tet_offset;  ///< [grains + 1]
  std::vector<double> sphere_center; ///< [grains * 3], mm, of the spheres that were meshed; empty where unknown
  std::vector<double> sphere_radius; ///< [grains], mm
  std::int64_t seed = -1;
};

/// Reads a meshed packing file. Throws InputError where it is missing, damaged or not meshed.
MeshedPacking read_packing(const std::string& path);

/// Makes nodes heavier until no tet, with the usual share of contact, requires a smaller step than `step` (s) in the
/// reference state; with `lighten`, also lighter where the tets leave room: then every node is as heavy as the step
/// needs, and no more. Sets mass_factor, added_mass and largest_added_mass.
void scale_masses(Model& model, double step, bool lighten);

/// Builds the model: surfaces found, nodes and tets renumbered for locality, masses lumped. `name` stands for the file
/// in messages. Throws InputError: inverted or degenerate tetrahedron, nodes out of range, open surface, node outside
/// the box.
Model build_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name);

} // namespace mpfem
