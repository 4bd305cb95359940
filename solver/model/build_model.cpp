#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "common/morton_key.hpp"
#include "results-schema/packing_file.hpp"
#include "solver/model/boundary_faces.hpp"
#include "solver/model/check_packing.hpp"
#include "solver/model/model.hpp"
#include "solver/model/ordering.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/parallel/agree.hpp"
#include "solver/parallel/grain_values.hpp"
#include "solver/physics/penalty.hpp"
#include "solver/physics/tet4_patch.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;

/// Materials and which grain has which.
void choose_materials(const Scenario& scenario, const std::string& name, Model& model) {
  model.material = {make_material(scenario.material, scenario.numerics.mass_scaling)};
  model.grain_material.assign(at(model.grains), 0);
  for (const GrainMaterial& other : scenario.grain_materials) {
    for (const std::int64_t grain : other.grains) {
      if (grain >= model.grains)
        throw InputError(fmt::format("{}: key 'grain_material.grains': found grain {}, allowed: 0 … {}", name, grain,
                                     model.grains - 1));
      model.grain_material[static_cast<std::size_t>(grain)] = static_cast<Index>(model.material.size());
    }
    model.material.push_back(make_material(other.material, scenario.numerics.mass_scaling));
  }
}

/// Sets model.refinement where the facets of some grain differ much in size.
void find_refinement(Model& model, const Communicator& ranks) {
  constexpr double graded = 3; // largest over smallest h of one grain's nodes; unrefined balls have up to about 2
  LazyArray<double> size(at(model.nodes()), model.pages()), edges(at(model.nodes()), model.pages());
  double most_graded = 0;
  for (const Index grain : model.own()) {
    const std::size_t g = at(grain);
    for (std::size_t f = 3 * at(model.facet_offset[g]); f < 3 * at(model.facet_offset[g + 1]); f += 3)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto a = at(model.facet[f + i]), b = at(model.facet[f + (i + 1) % 3]);
        const double *x = &model.position[4 * a], *y = &model.position[4 * b];
        const double length = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
        for (const std::size_t node : {a, b}) size[node] += length, edges[node] += 1;
      }
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (auto n = at(model.node_offset[g]); n < at(model.node_offset[g] + model.surface_node_count[g]); ++n) {
      size[n] /= edges[n];
      smallest = std::min(smallest, size[n]), largest = std::max(largest, size[n]);
    }
    if (largest > graded * smallest) most_graded = 1;
  }
  if (ranks.largest(most_graded) == 0) return;
  model.refinement = LazyArray<double>(size.size(), model.pages());
  for (const Index grain : model.own()) {
    const std::size_t g = at(grain);
    const std::size_t first = model.first_node(grain), end = model.end_node(grain),
                      surface_end = first + at(model.surface_node_count[g]);
    for (std::size_t n = first; n < end; ++n)
      model.refinement[n] = n < surface_end ? model.element_size[g] / size[n] : 1;
  }
}

/// First block of each grain, then the number of all blocks.
std::vector<Index> block_offsets(const Model& model, int lanes) {
  std::vector<Index> offset(1, 0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g)
    offset.push_back(offset[g] + (model.tet_offset[g + 1] - model.tet_offset[g] + lanes - 1) / lanes);
  return offset;
}

/// Sets the tets of a grain in the order of model.file_tet. `new_index` maps its nodes in the file to those in the
/// model, both counted from the grain's first.
template <class Real>
void set_blocks(const PackedMesh& mesh, const std::vector<Index>& new_index, int grain, Model& model) {
  constexpr int lanes = TetBlock<Real>::lanes;
  const std::size_t g = at(grain);
  const Index first_tet = model.tet_offset[g], end_tet = model.tet_offset[g + 1];
  const double flow_stress =
      std::visit([](const auto& law) { return law.initial_flow_stress(); }, model.material_of(grain).flow);
  for (Index b = model.block_offset[g]; b < model.block_offset[g + 1]; ++b)
    for (int lane = 0; lane < lanes; ++lane) {
      TetBlock<Real>& block = model.block<Real>(b);
      const Index t = model.file_tet[at(std::min(first_tet + lanes * (b - model.block_offset[g]) + lane, end_tet - 1))];
      const auto corner = mesh.corners(t);
      for (std::size_t c = 0; c < 4; ++c) block.node[c][lane] = new_index[at(corner[c] - mesh.first_node)];
      block.inverse_volume[lane] = static_cast<Real>(1.0 / mesh.volume(t));
      block.flow_stress[lane] = static_cast<Real>(flow_stress);
    }
}

using Faces = std::vector<std::array<Index, 3>>;

std::uint64_t hash_of_mesh(const MeshedPacking& packing) {
  if (packing.hash) return *packing.hash;
  return hash_of_mesh(
      hash_values(std::span<const Index>(packing.tet), hash_values(std::span<const double>(packing.node))), packing);
}

/// A model with the settings of the scenario and room for nodes and tets, but none of them set.
Model empty_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name) {
  Model model;
  model.grains = packing.grains();
  model.ownership = packing.ownership ? *packing.ownership : sole_ownership(model.grains);
  choose_materials(scenario, name, model);
  model.element = scenario.numerics.element;
  model.own_pressure = scenario.numerics.own_pressure;
  model.uniform_penalty = scenario.contact.stiffness.has_value();
  model.viscosity = {scenario.numerics.bulk_viscosity_linear, scenario.numerics.bulk_viscosity_quadratic};
  model.node_offset = packing.grain_node_offset;
  model.tet_offset = packing.grain_tet_offset;
  model.seed = packing.seed;
  model.mesh_hash = hash_of_mesh(packing);
  model.box_low = {0, 0, 0};
  model.box_high = packing.box_lengths;
  const std::size_t nodes = at(model.nodes()), tets = at(model.tets()), grains = at(model.grains);
  const Pages pages = model.pages();
  model.file_node = LazyArray<Index>(nodes, pages);
  model.file_tet = LazyArray<Index>(tets, pages);
  for (LazyArray<double>* rows : {&model.position, &model.velocity, &model.force})
    *rows = LazyArray<double>(4 * nodes, pages);
  model.inverse_mass = LazyArray<double>(nodes, pages);
  model.reference_area = LazyArray<double>(nodes, pages);
  model.surface_node_count.assign(grains, 0);
  for (std::vector<double>* values :
       {&model.reference_volume, &model.mass, &model.element_size, &model.penalty_stiffness})
    values->assign(grains, 0.0);
  return model;
}

/// Nodes of a grain in the order of the model: surface nodes first, each group along a Morton curve through the grain's
/// box.
std::vector<Index> order_nodes(const PackedMesh& mesh, const std::vector<char>& on_surface) {
  Vector3<double> low = mesh.point(mesh.first_node), high = low;
  for (Index n = mesh.first_node; n < mesh.end_node(); ++n) {
    const auto x = mesh.point(n);
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  std::vector<std::pair<std::uint64_t, Index>> keys;
  for (Index n = mesh.first_node; n < mesh.end_node(); ++n) {
    const std::uint64_t interior = on_surface[at(n - mesh.first_node)] ? 0U : 1U;
    const Vector3<double> x = mesh.point(n) - low;
    keys.emplace_back((interior << 40U) | morton_key({x.x / size, x.y / size, x.z / size}), n);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order;
  for (const auto& [key, node] : keys) order.push_back(node);
  return order;
}

/// Sets nodes and positions of a grain. Returns the number in the model of each of its nodes in the file, both counted
/// from the grain's first.
std::vector<Index> add_nodes(const PackedMesh& mesh, const Faces& faces, std::size_t grain, Model& model) {
  std::vector<char> on_surface(at(mesh.nodes()), 0);
  for (const auto& face : faces)
    for (const Index n : face) on_surface[at(n - mesh.first_node)] = 1;
  std::vector<Index> new_index(on_surface.size());
  Index node = mesh.first_node;
  for (const Index file_node : order_nodes(mesh, on_surface)) {
    new_index[at(file_node - mesh.first_node)] = node - mesh.first_node;
    model.file_node[at(node)] = file_node;
    const Vector3<double> x = mesh.point(file_node);
    double* row = &model.position[4 * at(node)];
    row[0] = x.x, row[1] = x.y, row[2] = x.z;
    ++node;
  }
  model.surface_node_count[grain] = static_cast<Index>(std::count(on_surface.begin(), on_surface.end(), char{1}));
  return new_index;
}

/// Sets the element size of a grain and the tributary areas of its surface nodes, and turns its faces into facets:
/// triples of the model's nodes.
void measure_facets(const PackedMesh& mesh, const std::vector<Index>& new_index, std::size_t grain, Faces& faces,
                    Model& model) {
  double edge_sum = 0;
  for (auto& face : faces) {
    const auto x0 = mesh.point(face[0]);
    const double area = 0.5 * norm(cross(mesh.point(face[1]) - x0, mesh.point(face[2]) - x0));
    for (std::size_t i = 0; i < 3; ++i) edge_sum += norm(mesh.point(face[i]) - mesh.point(face[(i + 1) % 3]));
    for (Index& node : face) {
      node = mesh.first_node + new_index[at(node - mesh.first_node)];
      model.reference_area[at(node)] += area / 3.0;
    }
  }
  model.element_size[grain] = edge_sum / (3.0 * static_cast<double>(faces.size()));
}

/// Sets the order of a grain's tets: in patches of eight that lie together.
void add_tets(const PackedMesh& mesh, Model& model) {
  std::vector<Vector3<double>> centre(at(mesh.tets()), Vector3<double>{0, 0, 0});
  const std::span<Index> order(model.file_tet.data() + mesh.first_tet, at(mesh.tets()));
  for (Index t = mesh.first_tet; t < mesh.end_tet(); ++t) {
    const auto i = at(t - mesh.first_tet);
    for (const Index corner : mesh.corners(t)) centre[i] = centre[i] + 0.25 * mesh.point(corner);
    order[i] = t;
  }
  order_in_patches(order, [&](Index t) -> const Vector3<double>& { return centre[at(t - mesh.first_tet)]; });
}

/// Lumps a quarter of every tet's mass at each of its nodes. Throws InputError where a node belongs to no tet.
void lump_masses(const PackedMesh& mesh, double density, const std::vector<Index>& new_index, const std::string& name,
                 std::size_t grain, Model& model) {
  double volume = 0;
  for (Index i = mesh.first_tet; i < mesh.end_tet(); ++i) {
    const Index t = model.file_tet[at(i)];
    const double tet_v = mesh.volume(t);
    volume += tet_v;
    for (const Index corner : mesh.corners(t)) // mass here; inverted below
      model.inverse_mass[at(mesh.first_node + new_index[at(corner - mesh.first_node)])] += 0.25 * density * tet_v;
  }
  model.reference_volume[grain] = volume;
  model.mass[grain] = volume * density;
  for (Index n = mesh.first_node; n < mesh.end_node(); ++n) {
    double& m = model.inverse_mass[at(n)];
    if (!(m > 0))
      throw InputError(fmt::format("{}: /mesh/node row {} belongs to no tetrahedron, allowed: nodes of tetrahedra only",
                                   name, model.file_node[at(n)]));
    m = 1.0 / m;
  }
}

/// What is built of a grain before all ranks know how many facets each grain has.
struct GrainParts {
  Faces facets;
  std::vector<Index> new_index; ///< node of the file -> node of the model, both counted from the grain's first
};

GrainParts add_grain(const MeshedPacking& packing, const Scenario& scenario, const std::string& name, Index grain,
                     Model& model) {
  const std::size_t g = at(grain);
  const PackedMesh mesh = packing.mesh_of(grain);
  GrainParts parts;
  parts.facets = boundary_faces(mesh.tet, fmt::format("{}: grain {}", name, grain));
  const Material& material = model.material_of(grain);
  parts.new_index = add_nodes(mesh, parts.facets, g, model);
  measure_facets(mesh, parts.new_index, g, parts.facets, model);
  model.penalty_stiffness[g] = scenario.contact.stiffness.value_or(
      penalty_stiffness(scenario.contact.stiffness_factor, material.moduli.youngs(), model.element_size[g]));
  add_tets(mesh, model);
  lump_masses(mesh, material.density, parts.new_index, name, g, model);
  return parts;
}

/// Brings what was measured on every grain to all ranks, and sets facets and their offsets.
void join_grains(const std::vector<GrainParts>& parts, Model& model, const Communicator& ranks) {
  const auto share = [&](auto& values) { share_of_grains(ranks, model.ownership, std::span(values)); };
  share(model.surface_node_count), share(model.element_size), share(model.penalty_stiffness);
  share(model.reference_volume), share(model.mass);
  std::vector<Index> facets(at(model.grains), 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    facets[at(model.own()[i])] = static_cast<Index>(parts[i].facets.size());
  share(facets);
  model.facet_offset.assign(1, 0);
  std::int64_t all = 0;
  for (const Index count : facets) {
    if ((all += count) > std::numeric_limits<Index>::max())
      throw InputError(fmt::format("found more than {} facets of surfaces, allowed: fewer; use a coarser mesh",
                                   std::numeric_limits<Index>::max()));
    model.facet_offset.push_back(static_cast<Index>(all));
  }
  model.facet = LazyArray<Index>(3 * at(model.facets()), model.pages());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Index* corner = model.facet.data() + 3 * at(model.facet_offset[at(model.own()[i])]);
    for (const auto& facet : parts[i].facets) corner = std::copy(facet.begin(), facet.end(), corner);
  }
}

/// Sets the blocks of all own grains.
template <class Real>
void make_blocks(const MeshedPacking& packing, const std::vector<GrainParts>& parts, Model& model) {
  model.block_offset = block_offsets(model, TetBlock<Real>::lanes);
  model.blocks = LazyArray<TetBlock<Real>>(at(model.block_offset.back()), model.pages());
  for (std::size_t i = 0; i < parts.size(); ++i)
    set_blocks<Real>(packing.mesh_of(model.own()[i]), parts[i].new_index, model.own()[i], model);
}

/// Sets the volumes around nodes, if pressures are averaged there. Masses must still be as lumped: density times that
/// volume.
void set_nodal_volumes(Model& model) {
  if (model.element != ElementType::tet4_anp) return;
  model.inverse_nodal_volume = LazyArray<double>(at(model.nodes()), model.pages());
  for (const Index g : model.own())
    for (Index n = model.node_offset[at(g)]; n < model.node_offset[at(g) + 1]; ++n)
      model.inverse_nodal_volume[at(n)] = model.inverse_mass[at(n)] * model.material_of(g).density;
  model.nodal_mean = LazyArray<double>(at(model.nodes()), model.pages());
}

/// Sets the volumes of patches, if tets share the pressure of their patch.
void set_patch_volumes(const MeshedPacking& packing, Model& model) {
  if (model.element != ElementType::tet4_patch) return;
  model.patch_offset.assign(1, 0);
  for (std::size_t g = 0; g < at(model.grains); ++g)
    model.patch_offset.push_back(model.patch_offset[g] +
                                 (model.tet_offset[g + 1] - model.tet_offset[g] + patch_tets - 1) / patch_tets);
  model.inverse_patch_volume = LazyArray<double>(at(model.patch_offset.back()), model.pages());
  for (const Index g : model.own()) {
    const PackedMesh mesh = packing.mesh_of(g);
    Index patch = model.patch_offset[at(g)];
    for (Index t = mesh.first_tet; t < mesh.end_tet(); t += patch_tets) {
      double volume = 0;
      for (Index i = t; i < std::min(t + patch_tets, mesh.end_tet()); ++i) volume += mesh.volume(model.file_tet[at(i)]);
      model.inverse_patch_volume[at(patch++)] = 1.0 / volume;
    }
  }
}

} // namespace

std::uint64_t hash_of_mesh(std::uint64_t of_nodes_and_tets, const MeshedPacking& packing) {
  return schema::hash_of_mesh(of_nodes_and_tets, packing.grain_node_offset, packing.box_lengths);
}

Model build_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name,
                  const Communicator& ranks) {
  const bool mixed = scenario.numerics.precision == Precision::mixed;
  Model model;
  std::vector<GrainParts> parts; // of the own grains
  agree(ranks, [&] {
    check_packing(packing, name);
    model = empty_model(packing, scenario, name);
    if (mixed) refuse_sizes_beyond_floats(packing, model.own(), name);
    for (const Index grain : model.own()) parts.push_back(add_grain(packing, scenario, name, grain, model));
  });
  join_grains(parts, model, ranks);
  if (mixed)
    make_blocks<float>(packing, parts, model);
  else
    make_blocks<double>(packing, parts, model);
  model.spatial_order = spatial_order(model, ranks);
  set_nodal_volumes(model);
  set_patch_volumes(packing, model);
  refuse_shared_places(model, name, ranks);
  find_refinement(model, ranks);
  find_smooth_surface(model, smooth_grains(model, packing, scenario.contact.surface, ranks));
  if (scenario.numerics.mass_scaling_step > 0) scale_masses(model, scenario, ranks);
  return model;
}

} // namespace mpfem
