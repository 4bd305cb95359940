#pragma once
// The grains: nodes, tetrahedra, surfaces and their state. A grain owns a contiguous range of everything.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/lazy_array.hpp"
#include "solver/model/material.hpp"
#include "solver/model/surface_view.hpp"
#include "solver/model/tet_block.hpp"
#include "solver/parallel/communicator.hpp"
#include "solver/parallel/ownership.hpp"
#include "solver/physics/stable_step.hpp"
#include "solver/physics/tensor.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Node arrays hold rows of four doubles (x, y, z, spare); the surface nodes of a grain are its first ones. All ranks
/// number grains, nodes, tets and facets alike, and arrays of grains are the same on all of them. Arrays of nodes, tets
/// and facets are set for the rank's own grains. For grains near these, only what contact needs is set.
struct Model {
  int grains = 0;
  Ownership ownership;                      ///< the grains that this rank computes
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
  LazyArray<std::int32_t> facet;                ///< [facets * 3], outward counter-clockwise
  LazyArray<std::int32_t> file_node;            ///< [nodes]: index in the packing file
  LazyArray<std::int32_t> file_tet;             ///< [tets]: index in the packing file, in block order

  LazyArray<double> position;       ///< mm
  LazyArray<double> velocity;       ///< mm/s, at the half step before the position
  LazyArray<double> force;          ///< N, internal and contact forces at the position
  LazyArray<double> reference_area; ///< [nodes]: tributary area of surface nodes at the start, mm^2
  LazyArray<double> inverse_mass;   ///< [nodes], 1/tonne
  TetBlocks blocks;
  LazyArray<double> inverse_nodal_volume; ///< [nodes], 1/mm^3, of the reference state; tet4_anp only
  LazyArray<double> nodal_mean;           ///< [nodes], MPa: scratch of the element pass; tet4_anp only
  std::vector<std::int32_t> patch_offset; ///< [grains + 1]; tet4_patch only
  LazyArray<double>
      inverse_patch_volume; ///< [patches], 1/mm^3, of the reference state: eight tets that follow each other

  std::vector<double> reference_volume;  ///< [grains], mm^3
  std::vector<double> mass;              ///< [grains], tonne (scaled)
  LazyArray<double> mass_factor;         ///< [nodes]: scaled over own mass; empty if nothing was scaled to a step
  double added_mass = 0;                 ///< by scaling to a step, over the mass of the packing
  double largest_added_mass = 0;         ///< the same, for the grain with the largest value
  std::vector<double> element_size;      ///< [grains], h: mean edge length of the surface facets, mm
  std::vector<double> penalty_stiffness; ///< [grains], K = factor E / h, MPa/mm
  bool uniform_penalty = false;          ///< K was given, and is the same in refined parts of the mesh
  LazyArray<double> refinement; ///< [nodes]: h of the grain over that of the surface node's facets; empty where
                                ///< no grain is locally refined
  LazyArray<std::int32_t>
      inner_node;           ///< [nodes]: towards which a surface node's contact point lies; empty where contact
                            ///< takes the nodes themselves (solver/model/smooth_surface.hpp)
  LazyArray<double> inward; ///< [nodes]: the inner node's share in the contact point
  int smooth_grains = 0;    ///< number of grains that touch by their smooth surface

  std::array<double, 3> box_low{}; ///< mm, at the start
  std::array<double, 3> box_high{};
  std::int64_t seed = -1;      ///< of the packing, -1 where unknown
  std::uint64_t mesh_hash = 0; ///< of nodes and tets as read

  /// Grains that this rank computes, ascending.
  const std::vector<std::int32_t>& own() const { return ownership.own; }
  /// Kind of memory pages for arrays of nodes, tets and facets.
  Pages pages() const { return own().size() == static_cast<std::size_t>(grains) ? Pages::large : Pages::small; }
  std::int32_t nodes() const { return node_offset.back(); }
  std::int32_t tets() const { return tet_offset.back(); }
  std::int32_t facets() const { return facet_offset.back(); }
  /// Nodes of a grain: the number of its first, and of the one behind its last.
  std::size_t first_node(int grain) const { return static_cast<std::size_t>(node_offset[std::size_t(grain)]); }
  std::size_t end_node(int grain) const { return static_cast<std::size_t>(node_offset[std::size_t(grain) + 1]); }
  /// Rows of a grain in arrays of four numbers a node: where its first one begins, and where its last one ends.
  std::size_t first_row(int grain) const { return 4 * first_node(grain); }
  std::size_t end_row(int grain) const { return 4 * end_node(grain); }
  const Material& material_of(int grain) const { return material[std::size_t(grain_material[std::size_t(grain)])]; }
  /// Block `index` of a model whose tets are in numbers of type Real.
  template <class Real>
  TetBlock<Real>& block(std::int32_t index) {
    return (*std::get_if<LazyArray<TetBlock<Real>>>(&blocks))[static_cast<std::size_t>(index)];
  }
  template <class Real>
  const TetBlock<Real>& block(std::int32_t index) const {
    return (*std::get_if<LazyArray<TetBlock<Real>>>(&blocks))[static_cast<std::size_t>(index)];
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
  /// Ratio of a surface node's penalty to its grain's mean: K = factor E / h with the h around the node. 1 if the
  /// scenario gives K itself.
  double local_stiffness(std::size_t node) const {
    return refinement.empty() || uniform_penalty ? 1.0 : refinement[node];
  }
  Vector3<double> point(std::size_t node) const { return vector_of(&position[4 * node]); }       ///< mm
  Vector3<double> velocity_of(std::size_t node) const { return vector_of(&velocity[4 * node]); } ///< mm/s
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
    const Vector3<double> v = velocity_of(node);
    if (inner_node.empty()) return v;
    return v + inward[node] * (velocity_of(static_cast<std::size_t>(inner_node[node])) - v);
  }
  /// Adds a force on a surface node's contact point, N: along an axis, or a vector.
  void push_contact_point(std::size_t node, std::size_t axis, double f) {
    if (inner_node.empty()) {
      force[4 * node + axis] += f;
      return;
    }
    force[4 * node + axis] += (1 - inward[node]) * f;
    force[4 * static_cast<std::size_t>(inner_node[node]) + axis] += inward[node] * f;
  }
  void push_contact_point(std::size_t node, const Vector3<double>& f) {
    for (std::size_t axis = 0; axis < 3; ++axis) push_contact_point(node, axis, f[axis]);
  }
  double total_reference_volume() const;
  SurfaceView surface() const;
  /// Bytes of all arrays.
  std::size_t memory() const;
};

/// Calls f(double{}) or f(float{}), depending on the number type of the model's tets.
template <class F>
auto with_tet_numbers(const Model& model, F&& f) {
  return std::holds_alternative<LazyArray<TetBlock<double>>>(model.blocks) ? f(double{}) : f(float{});
}

/// The mesh of one grain in a packing file.
struct PackedMesh {
  std::span<const double> node;      ///< [nodes * 3], mm
  std::span<const std::int32_t> tet; ///< [tets * 4], numbers of nodes in the file
  std::int32_t first_node = 0;       ///< in the file
  std::int32_t first_tet = 0;

  std::int32_t nodes() const { return static_cast<std::int32_t>(node.size() / 3); }
  std::int32_t tets() const { return static_cast<std::int32_t>(tet.size() / 4); }
  std::int32_t end_node() const { return first_node + nodes(); }
  std::int32_t end_tet() const { return first_tet + tets(); }
  /// Node of the file, mm.
  Vector3<double> point(std::int32_t file_node) const {
    return vector_of(&node[3 * static_cast<std::size_t>(file_node - first_node)]);
  }
  /// The four nodes of a tet of the file.
  std::span<const std::int32_t, 4> corners(std::int32_t file_tet) const {
    return std::span<const std::int32_t, 4>(&tet[4 * static_cast<std::size_t>(file_tet - first_tet)], 4);
  }
  /// mm^3; negative where the tetrahedron is inverted.
  double volume(std::int32_t file_tet) const;
};

/// A meshed packing, as read from its file: all of it, or the meshes of one rank's grains.
struct MeshedPacking {
  std::array<double, 3> box_lengths{};
  std::vector<double> node;                    ///< [nodes * 3], mm, of the rank's grains one after another
  std::vector<std::int32_t> tet;               ///< [tets * 4], numbers of nodes in the file
  std::vector<std::int32_t> grain_node_offset; ///< [grains + 1], in the file
  std::vector<std::int32_t> grain_tet_offset;  ///< [grains + 1], in the file
  std::vector<double> sphere_center; ///< [grains * 3], mm, of the spheres that were meshed; empty where unknown
  std::vector<double> sphere_radius; ///< [grains], mm
  std::int64_t seed = -1;
  std::optional<Ownership> ownership{}; ///< none: all grains are here
  std::vector<std::size_t> node_start;  ///< [grains], in `node`, where not all grains are here
  std::vector<std::size_t> tet_start;   ///< [grains], in `tet`
  std::optional<std::uint64_t> hash{};  ///< hash_of_mesh of the whole file, where not all grains are here

  int grains() const { return static_cast<int>(grain_node_offset.size()) - 1; }
  /// The mesh of a grain that is here.
  PackedMesh mesh_of(int grain) const;
};

/// Identifies a mesh. `of_nodes_and_tets`: hash of its nodes, with that of its tets chained to it (common/hash.hpp).
std::uint64_t hash_of_mesh(std::uint64_t of_nodes_and_tets, const MeshedPacking& packing);

/// Reads a meshed packing file. With several ranks, each reads the meshes of its own grains: those that `owner`
/// ([grains], rank) assigns to it or, without that, a share by the number of tets. Collective. Throws InputError if the
/// file is missing, damaged or not meshed.
MeshedPacking read_packing(const std::string& path, const Communicator& ranks = Communicator(),
                           const std::optional<std::vector<std::int32_t>>& owner = std::nullopt);

/// Assigns each rank its share, by the number of tets, of the grains of a packing that all ranks have made alike.
void divide(MeshedPacking& packing, const Communicator& ranks);

/// Makes nodes heavier until no tet, with the usual share of contact and bonds, requires a smaller step in the
/// reference state than numerics.mass_scaling_step. With numerics.mass_scaling_lighten, also lighter where the tets
/// leave room: then every node is as heavy as the step needs, and no more. Sets mass_factor, added_mass and
/// largest_added_mass.
void scale_masses(Model& model, const Scenario& scenario, const Communicator& ranks);

/// Builds the model: surfaces found, nodes and tets renumbered for locality, masses lumped. `name` stands for the file
/// in messages. Collective. Throws InputError: inverted or degenerate tetrahedron, nodes out of range, open surface.
/// Nodes outside the box are refused later (initial_state.hpp).
Model build_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name,
                  const Communicator& ranks = Communicator());

} // namespace mpfem
