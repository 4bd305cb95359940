#pragma once
// A scenario as plain structs, units beside every field. Only read_*.cpp know the keywords of the TOML file.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/key_places.hpp"
#include "solver/scenario/bond_parameters.hpp"
#include "solver/scenario/stages.hpp"
#include "solver/scenario/tools.hpp"

namespace mpfem {

/// Flow stress as a function of the equivalent plastic strain.
enum class HardeningLaw {
  elastic,      ///< no yielding
  power,        ///< sigma_y + k eps_p^m (paper Eq. 1)
  total_strain, ///< sigma = n eps^p on the total strain, elastic until E eps = n eps^p (paper Eq. 8)
  table,        ///< piecewise linear in eps_p, constant beyond the last point
};

/// The table [material.hardening].
struct HardeningParameters {
  HardeningLaw law = HardeningLaw::power;
  double yield_stress = 0;                  ///< sigma_y, MPa (power)
  double coefficient = 0;                   ///< k (power) or n (total_strain), MPa
  double exponent = 1;                      ///< m (power) or p (total_strain), dimensionless, in (0, 1]
  std::vector<double> table_plastic_strain; ///< table: increasing, first value 0; at most TableLaw::max_points
  std::vector<double> table_flow_stress;    ///< table: MPa, positive
  bool operator==(const HardeningParameters&) const = default;
};

/// The table [material].
struct MaterialParameters {
  double density = 0;        ///< tonne/mm^3
  double youngs_modulus = 0; ///< MPa
  double poissons_ratio = 0; ///< dimensionless, (-1, 0.5)
  HardeningParameters hardening;
  bool operator==(const MaterialParameters&) const = default;
};

/// Grains whose material differs from [material].
struct GrainMaterial {
  std::vector<std::int64_t> grains; ///< numbers in the packing, from 0
  MaterialParameters material;
  bool operator==(const GrainMaterial&) const = default;
};

/// What a grain's contact nodes stand for.
enum class ContactSurface {
  automatic, ///< smooth for grains that were meshed as spheres with their volume, facets for all others
  facets,    ///< the mesh as it is: nodes of a curved surface, meshed with its volume, lie outside it
  smooth,    ///< the curved surface of the same volume (solver/model/smooth_surface.hpp)
};

/// Two materials whose grains rub with a coefficient of their own.
struct MaterialPair {
  std::array<std::size_t, 2> materials{}; ///< 0: [material]; 1, 2, …: the grain materials in their order
  double friction = 0;                    ///< Coulomb's mu
};

/// The table [contact].
struct ContactParameters {
  double stiffness_factor = 10;    ///< penalty K = factor * E / h, h the mean facet edge of the grain
  std::optional<double> stiffness; ///< K itself, MPa/mm, if it is given instead (locally refined meshes)
  double friction = 0;             ///< Coulomb's mu between grains, where no pair of materials has its own
  std::vector<MaterialPair> pairs;
  double search_margin = 0.3; ///< candidates are kept for gaps up to this multiple of h
  ContactSurface surface = ContactSurface::automatic;
  bool penalty_differs(const ContactParameters& other) const {
    return stiffness_factor != other.stiffness_factor || stiffness != other.stiffness;
  }
  /// Whether grains of any two materials rub.
  bool has_friction() const {
    const auto rubs = [](const MaterialPair& pair) { return pair.friction > 0; };
    return friction > 0 || std::any_of(pairs.begin(), pairs.end(), rubs);
  }
};

/// Linear tetrahedra with one Gauss point.
enum class ElementType {
  tet4,       ///< pressure of every tet from its own volume: locks in plastic flow
  tet4_anp,   ///< average nodal pressure: pressure from the volumes around the nodes (Bonet and Burton 1998)
  tet4_patch, ///< F-bar patches: pressure from the volume of eight tets together (de Souza Neto et al. 2005)
};
/// Name of an element in scenarios and on the command line.
const char* element_name(ElementType element);
/// Share of each tet's own pressure that an element uses if the scenario gives none.
double usual_own_pressure(ElementType element);

/// Number types of the element pass.
enum class Precision {
  full,  ///< doubles
  mixed, ///< floats for strains, stresses and histories of tets; doubles for nodes, contact, walls, time and sums
         ///< of energies
};

/// Name of a precision in scenarios and on the command line.
const char* precision_name(Precision precision);

/// Whose largest frequency sets the stable step.
enum class StepEstimateMethod {
  grain, ///< each grain as a whole, found by iteration
  tet,   ///< the worst tet by itself: a proven bound, with a step about a quarter shorter
};

/// The tables [element] and [numerics].
struct NumericsParameters {
  ElementType element = ElementType::tet4;
  double own_pressure = 0; ///< tet4_anp, tet4_patch: share of each tet's own pressure, [0, 1]; 1 is tet4
  Precision precision = Precision::full;
  double time_step_factor = 0.9; ///< safety factor on the stable step, (0, 2]; beyond 1 nothing is proven
  StepEstimateMethod step_estimate = StepEstimateMethod::grain;
  double bulk_viscosity_linear = 0.06;
  double bulk_viscosity_quadratic = 1.2;
  double mass_scaling = 1;      ///< uniform factor on the density
  double mass_scaling_step = 0; ///< s: nodes are made heavier where the step at the start would be smaller; 0: none
  bool mass_scaling_lighten = false; ///< and lighter where it would be larger: locally refined meshes, slow processes
};

/// The table [output].
struct OutputParameters {
  int history_rows = 200;                          ///< rows per stage
  std::vector<double> snapshot_relative_densities; ///< a snapshot when the density first passes each of these
  bool snapshot_at_stage_end = true;
  std::vector<double> checkpoint_relative_densities; ///< a lasting checkpoint when the density first passes each
  double checkpoint_interval = 60;                   ///< s of wall-clock time between rolling checkpoints
};

/// Everything that a scenario's file says.
struct Scenario {
  std::string packing_file; ///< meshed packing; relative to the scenario's folder
  bool walls = true;        ///< the six walls of the box
  double wall_friction = 0; ///< Coulomb's mu between grains and walls
  std::vector<ToolParameters> tools;
  std::optional<ContainerParameters> container; ///< none: relative density and stresses are those of the box
  std::array<double, 3> gravity{};              ///< mm/s^2
  MaterialParameters material;                  ///< of all grains but those of grain_materials
  std::vector<GrainMaterial> grain_materials;   ///< no grain is in two of them
  ContactParameters contact;
  std::optional<BondParameters> bond; ///< none: grains do not stick
  NumericsParameters numerics;
  OutputParameters output;
  std::array<double, 3> initial_velocity{};                  ///< mm/s, of all grains
  std::vector<std::array<double, 3>> grain_velocity;         ///< mm/s, of each grain (overrides; empty: none)
  std::vector<std::array<double, 3>> grain_angular_velocity; ///< rad/s, about each grain's centroid (empty: none)
  std::vector<Stage> stages;
  KeyPlaces places;      ///< of the keys outside of tables
  KeyPlaces bond_places; ///< of the keys of [bond]
  /// Of the keys of [output]; of those outside of tables if there is no such table.
  KeyPlaces output_places;
  std::string text; ///< the TOML text, with values set on the command line

  /// Whether there is friction between grains, at walls or at tools.
  bool has_friction() const;
  bool has_gravity() const { return gravity != std::array<double, 3>{}; }
};

} // namespace mpfem
