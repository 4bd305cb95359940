#include "solver/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/physics/tet4_patch.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

Vector3<double> point(const std::vector<double>& node, Index i) {
  return {node[3 * at(i)], node[3 * at(i) + 1], node[3 * at(i) + 2]};
}

double tet_volume(const MeshedPacking& packing, Index tet) {
  const Index* n = &packing.tet[4 * at(tet)];
  const auto x0 = point(packing.node, n[0]);
  return dot(point(packing.node, n[1]) - x0, cross(point(packing.node, n[2]) - x0, point(packing.node, n[3]) - x0)) /
         6.0;
}

/// Key that follows a Morton curve through the box of the grain: neighbours in space become neighbours in memory.
std::uint64_t morton_key(const Vector3<double>& x, const Vector3<double>& low, double size) {
  std::uint64_t key = 0;
  const double scaled[3] = {(x.x - low.x) / size, (x.y - low.y) / size, (x.z - low.z) / size};
  for (int axis = 0; axis < 3; ++axis) {
    auto cell = static_cast<std::uint64_t>(std::clamp(scaled[axis], 0.0, 1.0) * 1023.0);
    for (int bit = 0; bit < 10; ++bit) key |= ((cell >> bit) & 1U) << (3 * bit + axis);
  }
  return key;
}

/// Orders tets so that every eight that follow each other lie together: halves of whole eights across the longest side of the box
/// of their centres, and halves of these, down to eights. Only the last has fewer.
void order_in_patches(std::span<Index> tets, const std::function<const Vector3<double>&(Index)>& centre) {
  const auto count = static_cast<Index>(tets.size());
  if (count <= patch_tets) {
    std::sort(tets.begin(), tets.end());
    return;
  }
  using Component = double Vector3<double>::*;
  Component longest = nullptr;
  double length = -1;
  for (const Component component : {&Vector3<double>::x, &Vector3<double>::y, &Vector3<double>::z}) {
    const auto [least, most] = std::minmax_element(
        tets.begin(), tets.end(), [&](Index a, Index b) { return centre(a).*component < centre(b).*component; });
    if (centre(*most).*component - centre(*least).*component > length) {
      length = centre(*most).*component - centre(*least).*component;
      longest = component;
    }
  }
  const auto half = at((count + patch_tets - 1) / patch_tets / 2 * patch_tets);
  std::nth_element(tets.begin(), tets.begin() + static_cast<std::ptrdiff_t>(half), tets.end(), [&](Index a, Index b) {
    return std::pair(centre(a).*longest, a) < std::pair(centre(b).*longest, b);
  });
  order_in_patches(tets.first(half), centre);
  order_in_patches(tets.subspan(half), centre);
}

struct Face {
  std::array<Index, 3> sorted;
  std::array<Index, 3> outward;
  bool operator<(const Face& other) const { return sorted < other.sorted; }
};

/// Faces that belong to one tetrahedron only, outward counter-clockwise, for the tets [begin, end). Throws InputError where
/// more than two tetrahedra share a face, or the faces left over do not close the grain.
std::vector<std::array<Index, 3>> boundary_faces(const std::vector<Index>& tet, Index begin, Index end,
                                                 const std::string& grain_name) {
  static constexpr int corner[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::vector<Face> faces;
  faces.reserve(4 * at(end - begin));
  for (Index t = begin; t < end; ++t) {
    for (const auto& c : corner) {
      Face face;
      for (std::size_t i = 0; i < 3; ++i) face.outward[i] = tet[4 * at(t) + static_cast<std::size_t>(c[i])];
      face.sorted = face.outward;
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::array<Index, 3>> boundary;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].sorted == faces[i].sorted) ++j;
    if (j == i + 1) boundary.push_back(faces[i].outward);
    if (j > i + 2)
      throw InputError(fmt::format("{}: {} tetrahedra share the face of nodes {}, {}, {}, allowed at most two",
                                   grain_name, j - i, faces[i].sorted[0], faces[i].sorted[1], faces[i].sorted[2]));
    i = j;
  }
  // Every edge once in each direction, or as often in both where parts of the surface touch along it.
  std::vector<std::pair<Index, Index>> forward, backward;
  for (const auto& face : boundary)
    for (std::size_t i = 0; i < 3; ++i) {
      forward.emplace_back(face[i], face[(i + 1) % 3]);
      backward.emplace_back(face[(i + 1) % 3], face[i]);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  if (boundary.empty() || forward != backward)
    throw InputError(
        fmt::format("{}: its surface is not closed, allowed tetrahedra that meet face to face", grain_name));
  return boundary;
}

FlowLaw make_flow_law(const MaterialParameters& p) {
  const HardeningParameters& h = p.hardening;
  switch (h.law) {
  case HardeningLaw::elastic:
    return ElasticLaw{};
  case HardeningLaw::power:
    return PowerLaw{h.yield_stress, h.coefficient, h.exponent};
  case HardeningLaw::total_strain:
    return TotalStrainLaw{h.coefficient, h.exponent, p.youngs_modulus};
  case HardeningLaw::table: {
    if (h.table_plastic_strain.size() > static_cast<std::size_t>(TableLaw::max_points))
      throw InputError(fmt::format("material.hardening: the table has {} points, allowed at most {}",
                                   h.table_plastic_strain.size(), TableLaw::max_points));
    TableLaw law;
    law.points = static_cast<int>(h.table_plastic_strain.size());
    std::copy(h.table_plastic_strain.begin(), h.table_plastic_strain.end(), law.strain.begin());
    std::copy(h.table_flow_stress.begin(), h.table_flow_stress.end(), law.stress.begin());
    return law;
  }
  }
  return ElasticLaw{};
}

void check_packing(const MeshedPacking& packing, const std::string& name) {
  const auto nodes = static_cast<Index>(packing.node.size() / 3);
  const auto tets = static_cast<Index>(packing.tet.size() / 4);
  for (const double length : packing.box_lengths)
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(fmt::format("{}: /box/lengths holds {}, allowed > 0", name, length));
  const auto& no = packing.grain_node_offset;
  const auto& to = packing.grain_tet_offset;
  if (no.size() < 2 || no.size() != to.size() || no.front() != 0 || to.front() != 0 || no.back() != nodes ||
      to.back() != tets || !std::is_sorted(no.begin(), no.end()) || !std::is_sorted(to.begin(), to.end()))
    throw InputError(fmt::format("{}: /mesh/grain_node_offset and /mesh/grain_tet_offset do not divide {} nodes and {} "
                                 "tets into grains",
                                 name, nodes, tets));
  if (!packing.sphere_radius.empty() && (packing.sphere_radius.size() + 1 != no.size() ||
                                         packing.sphere_center.size() != 3 * packing.sphere_radius.size()))
    throw InputError(
        fmt::format("{}: /spheres/center and /spheres/radius hold {} and {} numbers, allowed three and one for "
                    "each of {} grains",
                    name, packing.sphere_center.size(), packing.sphere_radius.size(), no.size() - 1));
  for (std::size_t g = 0; g + 1 < no.size(); ++g) {
    if (to[g + 1] == to[g]) throw InputError(fmt::format("{}: grain {} has no tetrahedra", name, g));
    for (Index t = to[g]; t < to[g + 1]; ++t) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Index n = packing.tet[4 * at(t) + i];
        if (n < no[g] || n >= no[g + 1])
          throw InputError(fmt::format("{}: /mesh/tet row {}: node {} is not one of grain {} (allowed {} … {})", name,
                                       t, n, g, no[g], no[g + 1] - 1));
      }
      const double volume = tet_volume(packing, t);
      if (!(volume > 0))
        throw InputError(fmt::format("{}: /mesh/tet row {} (grain {}) is inverted or degenerate: volume {:.3g} mm^3, "
                                     "allowed > 0",
                                     name, t, g, volume));
    }
  }
  for (Index i = 0; i < nodes; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = packing.node[3 * at(i) + axis];
      if (!std::isfinite(x)) throw InputError(fmt::format("{}: /mesh/node row {} is not finite", name, i));
    }
}

/// Two grains that lie in the same place, as copies do, have no gap that contact could measure.
void refuse_shared_places(const Model& model, const std::string& name) {
  struct Place {
    std::array<double, 3> x;
    int grain;
    bool operator<(const Place& other) const { return std::tie(x, grain) < std::tie(other.x, other.grain); }
  };
  std::vector<Place> places;
  for (int g = 0; g < model.grains; ++g) {
    const auto gs = static_cast<std::size_t>(g);
    for (Index n = model.node_offset[gs]; n < model.node_offset[gs] + model.surface_node_count[gs]; ++n)
      places.push_back({{model.position[4 * at(n)], model.position[4 * at(n) + 1], model.position[4 * at(n) + 2]}, g});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].x == places[i - 1].x && places[i].grain != places[i - 1].grain)
      throw InputError(
          fmt::format("{}: grains {} and {} have a node in the same place ({:g}, {:g}, {:g}), allowed grains apart",
                      name, places[i - 1].grain, places[i].grain, places[i].x[0], places[i].x[1], places[i].x[2]));
}

/// The grains along a Morton curve through the box. Contact, which reads every grain's neighbours, finds them in the cache
/// when it takes the grains in this order.
std::vector<Index> spatial_order(const Model& model) {
  const double size = *std::max_element(model.box_high.begin(), model.box_high.end());
  std::vector<std::pair<std::uint64_t, Index>> order;
  for (Index g = 0; g < model.grains; ++g) {
    const auto first = at(model.node_offset[at(g)]), count = at(model.surface_node_count[at(g)]);
    Vector3<double> centre{0, 0, 0};
    for (std::size_t n = first; n < first + count; ++n)
      centre =
          centre + (1.0 / static_cast<double>(count)) *
                       Vector3<double>{model.position[4 * n], model.position[4 * n + 1], model.position[4 * n + 2]};
    order.emplace_back(morton_key(centre, {0, 0, 0}, size), g);
  }
  std::sort(order.begin(), order.end());
  std::vector<Index> grains;
  for (const auto& [key, grain] : order) grains.push_back(grain);
  return grains;
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

} // namespace

double Model::total_reference_volume() const {
  return std::accumulate(reference_volume.begin(), reference_volume.end(), 0.0);
}

SurfaceView Model::surface() const {
  return {position, node_offset, surface_node_count, facet, facet_offset};
}

std::size_t Model::memory() const {
  const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
  return bytes(position) + bytes(velocity) + bytes(force) + bytes(normal) + bytes(inverse_mass) +
         bytes(reference_area) + std::visit(bytes, blocks) + bytes(inverse_nodal_volume) + bytes(nodal_mean) +
         bytes(inverse_patch_volume) + bytes(inner_node) + bytes(inward) + bytes(facet) + bytes(file_node) +
         bytes(file_tet);
}

Material make_material(const MaterialParameters& parameters, double mass_scaling) {
  const ElasticModuli moduli = elastic_moduli(parameters.youngs_modulus, parameters.poissons_ratio);
  const double density = parameters.density * mass_scaling;
  return {moduli, density, std::sqrt(moduli.dilatational() / density), make_flow_law(parameters)};
}

/// Materials and which grain has which.
static void choose_materials(const Scenario& scenario, const std::string& name, Model& model) {
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

std::array<std::int32_t, 4> Model::nodes_of_tet(int grain, std::int32_t tet) const {
  return with_tet_numbers(*this, [&](auto number) {
    constexpr int lanes = TetBlock<decltype(number)>::lanes;
    const auto& node = block<decltype(number)>(block_offset[static_cast<std::size_t>(grain)] + tet / lanes).node;
    const int lane = tet % lanes;
    return std::array<std::int32_t, 4>{node[0][lane], node[1][lane], node[2][lane], node[3][lane]};
  });
}

namespace {

/// First block of each grain, and the number of all.
std::vector<Index> block_offsets(const Model& model, int lanes) {
  std::vector<Index> offset(1, 0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(model.grains); ++g)
    offset.push_back(offset[g] + (model.tet_offset[g + 1] - model.tet_offset[g] + lanes - 1) / lanes);
  return offset;
}

/// The tets of all grains in the order of model.file_tet, and model.block_offset. `new_index` maps nodes of the file to the model's.
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

/// Eighth powers of lengths (the step's estimate) and inverse sixth ones must be floats.
void refuse_sizes_beyond_floats(const MeshedPacking& packing, const std::string& name) {
  constexpr double least = 1e-4, most = 1e4; // mm
  for (std::size_t t = 0; t < packing.tet.size() / 4; ++t) {
    double longest = 0;
    const auto x0 = point(packing.node, packing.tet[4 * t]);
    for (std::size_t c = 1; c < 4; ++c)
      longest = std::max(longest, norm(point(packing.node, packing.tet[4 * t + c]) - x0));
    if (!(longest > least && longest < most))
      throw InputError(
          fmt::format("{}: tet {} has an edge of {:.3g} mm; element.precision = 'mixed' takes {:g} … {:g} mm, "
                      "'double' any",
                      name, t, longest, least, most));
  }
}

} // namespace

Model build_model(const MeshedPacking& packing, const Scenario& scenario, const std::string& name) {
  check_packing(packing, name);
  Model model;
  model.grains = static_cast<int>(packing.grain_node_offset.size()) - 1;
  choose_materials(scenario, name, model);
  model.viscosity = {scenario.numerics.bulk_viscosity_linear, scenario.numerics.bulk_viscosity_quadratic};
  model.node_offset = packing.grain_node_offset;
  model.tet_offset = packing.grain_tet_offset;
  model.seed = packing.seed;
  model.mesh_hash = hash_values(std::span<const double>(packing.node));
  model.mesh_hash = hash_values(std::span<const Index>(packing.tet), model.mesh_hash);
  model.mesh_hash = hash_values(std::span<const Index>(packing.grain_node_offset), model.mesh_hash);
  model.mesh_hash = hash_values(std::span<const double>(packing.box_lengths), model.mesh_hash);
  model.box_low = {0, 0, 0};
  model.box_high = packing.box_lengths;

  const std::size_t nodes = packing.node.size() / 3;
  const std::size_t tets = packing.tet.size() / 4;
  model.file_node.resize(nodes);
  model.file_tet.resize(tets);
  model.facet_offset.assign(1, 0);
  model.position.assign(4 * nodes, 0.0);
  model.velocity.assign(4 * nodes, 0.0);
  model.force.assign(4 * nodes, 0.0);
  model.normal.assign(4 * nodes, 0.0);
  model.inverse_mass.assign(nodes, 0.0);
  model.reference_area.assign(nodes, 0.0);
  std::vector<Index> new_index(nodes); // file node -> model node
  for (int g = 0; g < model.grains; ++g) {
    const auto gs = static_cast<std::size_t>(g);
    const Index n0 = model.node_offset[gs], n1 = model.node_offset[gs + 1];
    const Index t0 = model.tet_offset[gs], t1 = model.tet_offset[gs + 1];
    const Material& material = model.material_of(g);

    // 1. Surface, then nodes: surface nodes first, each group along a Morton curve.
    const auto faces = boundary_faces(packing.tet, t0, t1, fmt::format("{}: grain {}", name, g));
    std::vector<char> on_surface(at(n1 - n0), 0);
    for (const auto& face : faces)
      for (Index n : face) on_surface[at(n - n0)] = 1;
    Vector3<double> low = point(packing.node, n0), high = low;
    for (Index n = n0; n < n1; ++n) {
      const auto x = point(packing.node, n);
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    std::vector<std::pair<std::uint64_t, Index>> order;
    for (Index n = n0; n < n1; ++n) {
      const std::uint64_t interior = on_surface[at(n - n0)] ? 0U : 1U;
      order.emplace_back((interior << 40U) | morton_key(point(packing.node, n), low, size), n);
    }
    std::sort(order.begin(), order.end());
    Index surface_nodes = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Index model_node = n0 + static_cast<Index>(i);
      new_index[at(order[i].second)] = model_node;
      model.file_node[at(model_node)] = order[i].second;
      surface_nodes += on_surface[at(order[i].second - n0)];
      for (std::size_t axis = 0; axis < 3; ++axis)
        model.position[4 * at(model_node) + axis] = packing.node[3 * at(order[i].second) + axis];
    }
    model.surface_node_count.push_back(surface_nodes);

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
    const double h = edge_sum / (3.0 * static_cast<double>(faces.size()));
    model.element_size.push_back(h);
    model.penalty_stiffness.push_back(
        scenario.contact.stiffness.value_or(scenario.contact.stiffness_factor * material.moduli.youngs() / h));

    // 2. Tets in patches, in blocks.
    std::vector<Vector3<double>> centre(at(t1 - t0), Vector3<double>{0, 0, 0});
    std::vector<Index> tet_order(at(t1 - t0));
    for (Index t = t0; t < t1; ++t) {
      for (std::size_t i = 0; i < 4; ++i)
        centre[at(t - t0)] = centre[at(t - t0)] + 0.25 * point(packing.node, packing.tet[4 * at(t) + i]);
      tet_order[at(t - t0)] = t;
    }
    order_in_patches(tet_order, [&](Index t) -> const Vector3<double>& { return centre[at(t - t0)]; });
    double volume = 0;
    for (Index i = 0; i < t1 - t0; ++i) {
      const Index t = tet_order[at(i)];
      const double tet_v = tet_volume(packing, t);
      model.file_tet[at(t0 + i)] = t;
      volume += tet_v;
      for (std::size_t c = 0; c < 4; ++c) // mass here; inverted below
        model.inverse_mass[at(new_index[at(packing.tet[4 * at(t) + c])])] += 0.25 * material.density * tet_v;
    }
    model.reference_volume.push_back(volume);
    model.mass.push_back(volume * material.density);
    for (Index n = n0; n < n1; ++n) {
      double& m = model.inverse_mass[at(n)];
      if (!(m > 0))
        throw InputError(fmt::format("{}: node {} belongs to no tetrahedron", name, model.file_node[at(n)]));
      m = 1.0 / m;
    }
  }
  if (scenario.numerics.precision == Precision::mixed) {
    refuse_sizes_beyond_floats(packing, name);
    model.blocks = make_blocks<float>(packing, new_index, model);
  } else {
    model.blocks = make_blocks<double>(packing, new_index, model);
  }
  model.spatial_order = spatial_order(model);
  model.element = scenario.numerics.element;
  model.own_pressure = scenario.numerics.own_pressure;
  model.uniform_penalty = scenario.contact.stiffness.has_value();
  if (model.element == ElementType::tet4_anp) {
    // Masses are still as lumped: density times the volume around a node.
    for (int g = 0; g < model.grains; ++g)
      for (Index n = model.node_offset[at(g)]; n < model.node_offset[at(g) + 1]; ++n)
        model.inverse_nodal_volume.push_back(model.inverse_mass[at(n)] * model.material_of(g).density);
    model.nodal_mean.assign(nodes, 0.0);
  }
  if (model.element == ElementType::tet4_patch) {
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
  refuse_shared_places(model, name);
  find_refinement(model);
  find_smooth_surface(model, smooth_grains(model, packing, scenario.contact.surface));
  if (scenario.numerics.mass_scaling_step > 0)
    scale_masses(model, scenario.numerics.mass_scaling_step / scenario.numerics.time_step_factor,
                 scenario.numerics.mass_scaling_lighten);
  return model;
}

} // namespace mpfem
