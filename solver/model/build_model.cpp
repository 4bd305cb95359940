#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/index.hpp"
#include "solver/model/boundary_faces.hpp"
#include "solver/model/check_packing.hpp"
#include "solver/model/model.hpp"
#include "solver/model/ordering.hpp"
#include "solver/model/packing_geometry.hpp"
#include "solver/model/smooth_surface.hpp"
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
        throw InputError(fmt::format("{}: key 'grain_material.grains': found grain {}, allowed 0 … {}", name, grain,
                                     model.grains - 1));
      model.grain_material[static_cast<std::size_t>(grain)] = static_cast<Index>(model.material.size());
    }
    model.material.push_back(make_material(other.material, scenario.numerics.mass_scaling));
  }
}

/// Sets model.refinement where the facets of some grain differ much in size.
void find_refinement(Model& model) {
  constexpr double graded = 3; // largest over smallest h of one grain's nodes; unrefined balls have up to about 2
  std::vector<double> size(static_cast<std::size_t>(model.nodes()), 0.0), edges(size.size(), 0.0);
  for (std::size_t f = 0; f < model.facet.size(); f += 3)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = at(model.facet[f + i]), b = at(model.facet[f + (i + 1) % 3]);
      const double *x = &model.position[4 * a], *y = &model.position[4 * b];
      const double length = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
      for (const std::size_t node : {a, b}) size[node] += length, edges[node] += 1;
    }
  bool refined = false;
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g) {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (auto n = at(model.node_offset[g]); n < at(model.node_offset[g] + model.surface_node_count[g]); ++n) {
      size[n] /= edges[n];
      smallest = std::min(smallest, size[n]), largest = std::max(largest, size[n]);
    }
    refined = refined || largest > graded * smallest;
  }
  if (!refined) return;
  model.refinement.assign(size.size(), 1.0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g)
    for (auto n = at(model.node_offset[g]); n < at(model.node_offset[g] + model.surface_node_count[g]); ++n)
      model.refinement[n] = model.element_size[g] / size[n];
}

/// First block of each grain, and the number of all.
std::vector<Index> block_offsets(const Model& model, int lanes) {
  std::vector<Index> offset(1, 0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g)
    offset.push_back(offset[g] + (model.tet_offset[g + 1] - model.tet_offset[g] + lanes - 1) / lanes);
  return offset;
}

/// The tets of all grains in the order of model.file_tet, and model.block_offset. `new_index` maps nodes of the file to
/// the model's.
template <class Real>
std::vector<TetBlock<Real>> make_blocks(const MeshedPacking& packing, const std::vector<Index>& new_index,
                                        Model& model) {
  constexpr int lanes = TetBlock<Real>::lanes;
  model.block_offset = block_offsets(model, lanes);
  std::vector<TetBlock<Real>> blocks(at(model.block_offset.back()));
  for (int g = 0; g < model.grains; ++g) {
    const Index n0 = model.node_offset[at(g)], t0 = model.tet_offset[at(g)], t1 = model.tet_offset[at(g) + 1];
    const double flow_stress =
        std::visit([](const auto& law) { return law.initial_flow_stress(); }, model.material_of(g).flow);
    for (Index b = model.block_offset[at(g)]; b < model.block_offset[at(g) + 1]; ++b)
      for (int lane = 0; lane < lanes; ++lane) {
        TetBlock<Real>& block = blocks[at(b)];
        const Index t = model.file_tet[at(std::min(t0 + lanes * (b - model.block_offset[at(g)]) + lane, t1 - 1))];
        for (int c = 0; c < 4; ++c)
          block.node[c][lane] = new_index[at(packing.tet[4 * at(t) + static_cast<std::size_t>(c)])] - n0;
        block.inverse_volume[lane] = static_cast<Real>(1.0 / tet_volume(packing, t));
        block.flow_stress[lane] = static_cast<Real>(flow_stress);
      }
  }
  return blocks;
}

/// Node and tet numbers of one grain, in the file as in the model.
struct GrainRange {
  Index first_node, end_node, first_tet, end_tet;
  std::size_t nodes() const { return at(end_node - first_node); }
  std::size_t tets() const { return at(end_tet - first_tet); }
};

GrainRange range_of(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  return {model.node_offset[g], model.node_offset[g + 1], model.tet_offset[g], model.tet_offset[g + 1]};
}

using Faces = std::vector<std::array<Index, 3>>;

std::uint64_t hash_of_mesh(const MeshedPacking& packing) {
  std::uint64_t hash = hash_values(std::span<const double>(packing.node));
  hash = hash_values(std::span<const Index>(packing.tet), hash);
  hash = hash_values(std::span<const Index>(packing.grain_node_offset), hash);
  return hash_values(std::span<const double>(packing.box_lengths), hash);
}

/// A model with the settings of the scenario and room for nodes and tets, but none of them set.
Model empty_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name) {
  Model model;
  model.grains = static_cast<int>(packing.grain_node_offset.size()) - 1;
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
  const std::size_t nodes = packing.node.size() / 3;
  model.file_node.resize(nodes);
  model.file_tet.resize(packing.tet.size() / 4);
  model.facet_offset.assign(1, 0);
  model.position.assign(4 * nodes, 0.0);
  model.velocity.assign(4 * nodes, 0.0);
  model.force.assign(4 * nodes, 0.0);
  model.normal.assign(4 * nodes, 0.0);
  model.inverse_mass.assign(nodes, 0.0);
  model.reference_area.assign(nodes, 0.0);
  return model;
}

/// Nodes of a grain in the order of the model: surface nodes first, each group along a Morton curve through the grain's
/// box.
std::vector<Index> order_nodes(const MeshedPacking& packing, const GrainRange& range,
                               const std::vector<char>& on_surface) {
  Vector3<double> low = point(packing.node, range.first_node), high = low;
  for (Index n = range.first_node; n < range.end_node; ++n) {
    const auto x = point(packing.node, n);
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  std::vector<std::pair<std::uint64_t, Index>> keys;
  for (Index n = range.first_node; n < range.end_node; ++n) {
    const std::uint64_t interior = on_surface[at(n - range.first_node)] ? 0U : 1U;
    keys.emplace_back((interior << 40U) | morton_key(point(packing.node, n), low, size), n);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order;
  for (const auto& [key, node] : keys) order.push_back(node);
  return order;
}

/// Sets nodes and positions of a grain, and `new_index` from its nodes in the file to those of the model.
void add_nodes(const MeshedPacking& packing, const GrainRange& range, const Faces& faces, Model& model,
               std::vector<Index>& new_index) {
  std::vector<char> on_surface(range.nodes(), 0);
  for (const auto& face : faces)
    for (const Index n : face) on_surface[at(n - range.first_node)] = 1;
  Index node = range.first_node;
  for (const Index file_node : order_nodes(packing, range, on_surface)) {
    new_index[at(file_node)] = node;
    model.file_node[at(node)] = file_node;
    for (std::size_t axis = 0; axis < 3; ++axis)
      model.position[4 * at(node) + axis] = packing.node[3 * at(file_node) + axis];
    ++node;
  }
  model.surface_node_count.push_back(static_cast<Index>(std::count(on_surface.begin(), on_surface.end(), char{1})));
}

/// Sets the facets of a grain, its element size, and the tributary areas of its surface nodes.
void add_facets(const MeshedPacking& packing, const Faces& faces, const std::vector<Index>& new_index, Model& model) {
  double edge_sum = 0;
  for (const auto& face : faces) {
    const auto x0 = point(packing.node, face[0]);
    const double area = 0.5 * norm(cross(point(packing.node, face[1]) - x0, point(packing.node, face[2]) - x0));
    for (std::size_t i = 0; i < 3; ++i) {
      model.reference_area[at(new_index[at(face[i])])] += area / 3.0;
      model.facet.push_back(new_index[at(face[i])]);
      edge_sum += norm(point(packing.node, face[i]) - point(packing.node, face[(i + 1) % 3]));
    }
  }
  model.facet_offset.push_back(static_cast<Index>(model.facet.size() / 3));
  model.element_size.push_back(edge_sum / (3.0 * static_cast<double>(faces.size())));
}

/// Sets the order of a grain's tets: in patches of eight that lie together.
void add_tets(const MeshedPacking& packing, const GrainRange& range, Model& model) {
  std::vector<Vector3<double>> centre(range.tets(), Vector3<double>{0, 0, 0});
  const std::span<Index> order(model.file_tet.data() + range.first_tet, range.tets());
  for (Index t = range.first_tet; t < range.end_tet; ++t) {
    const auto i = at(t - range.first_tet);
    for (std::size_t c = 0; c < 4; ++c) centre[i] = centre[i] + 0.25 * point(packing.node, packing.tet[4 * at(t) + c]);
    order[i] = t;
  }
  order_in_patches(order, [&](Index t) -> const Vector3<double>& { return centre[at(t - range.first_tet)]; });
}

/// Lumps a quarter of every tet's mass at each of its nodes. Throws InputError where a node belongs to no tet.
void lump_masses(const MeshedPacking& packing, const GrainRange& range, double density,
                 const std::vector<Index>& new_index, const std::string& name, Model& model) {
  double volume = 0;
  for (Index i = range.first_tet; i < range.end_tet; ++i) {
    const Index t = model.file_tet[at(i)];
    const double tet_v = tet_volume(packing, t);
    volume += tet_v;
    for (std::size_t c = 0; c < 4; ++c) // mass here; inverted below
      model.inverse_mass[at(new_index[at(packing.tet[4 * at(t) + c])])] += 0.25 * density * tet_v;
  }
  model.reference_volume.push_back(volume);
  model.mass.push_back(volume * density);
  for (Index n = range.first_node; n < range.end_node; ++n) {
    double& m = model.inverse_mass[at(n)];
    if (!(m > 0)) throw InputError(fmt::format("{}: node {} belongs to no tetrahedron", name, model.file_node[at(n)]));
    m = 1.0 / m;
  }
}

/// Sets the volumes around nodes, where pressures are averaged there. Masses must be as lumped: density times that
/// volume.
void set_nodal_volumes(Model& model) {
  if (model.element != ElementType::tet4_anp) return;
  for (int g = 0; g < model.grains; ++g)
    for (Index n = model.node_offset[at(g)]; n < model.node_offset[at(g) + 1]; ++n)
      model.inverse_nodal_volume.push_back(model.inverse_mass[at(n)] * model.material_of(g).density);
  model.nodal_mean.assign(at(model.nodes()), 0.0);
}

/// Sets the volumes of patches, where tets share the pressure of theirs.
void set_patch_volumes(const MeshedPacking& packing, Model& model) {
  if (model.element != ElementType::tet4_patch) return;
  model.patch_offset.assign(1, 0);
  for (int g = 0; g < model.grains; ++g) {
    const Index first = model.tet_offset[at(g)], end = model.tet_offset[at(g) + 1];
    for (Index t = first; t < end; t += patch_tets) {
      double volume = 0;
      for (Index i = t; i < std::min(t + patch_tets, end); ++i) volume += tet_volume(packing, model.file_tet[at(i)]);
      model.inverse_patch_volume.push_back(1.0 / volume);
    }
    model.patch_offset.push_back(static_cast<Index>(model.inverse_patch_volume.size()));
  }
}

} // namespace

Model build_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name) {
  check_packing(packing, name);
  const bool mixed = scenario.numerics.precision == Precision::mixed;
  if (mixed) refuse_sizes_beyond_floats(packing, name);
  Model model = empty_model(packing, scenario, name);
  std::vector<Index> new_index(packing.node.size() / 3); // node of the file -> node of the model
  for (int g = 0; g < model.grains; ++g) {
    const GrainRange range = range_of(model, g);
    const Faces faces =
        boundary_faces(packing.tet, range.first_tet, range.end_tet, fmt::format("{}: grain {}", name, g));
    const Material& material = model.material_of(g);
    add_nodes(packing, range, faces, model, new_index);
    add_facets(packing, faces, new_index, model);
    model.penalty_stiffness.push_back(scenario.contact.stiffness.value_or(
        penalty_stiffness(scenario.contact.stiffness_factor, material.moduli.youngs(), model.element_size.back())));
    add_tets(packing, range, model);
    lump_masses(packing, range, material.density, new_index, name, model);
  }
  if (mixed)
    model.blocks = make_blocks<float>(packing, new_index, model);
  else
    model.blocks = make_blocks<double>(packing, new_index, model);
  model.spatial_order = spatial_order(model);
  set_nodal_volumes(model);
  set_patch_volumes(packing, model);
  refuse_shared_places(model, name);
  find_refinement(model);
  find_smooth_surface(model, smooth_grains(model, packing, scenario.contact.surface));
  if (scenario.numerics.mass_scaling_step > 0)
    scale_masses(model, scenario.numerics.mass_scaling_step / scenario.numerics.time_step_factor,
                 scenario.numerics.mass_scaling_lighten);
  return model;
}

} // namespace mpfem
