#pragma once
// A scenario as plain structs, units beside every field. Keywords and defaults of the TOML file stand in scenario.cpp
// only.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/key_places.hpp"
#include "solver/physics/bond.hpp"

namespace mpfem {

class TableReader;
class TomlDocument;

/// Flow stress as a function of the equivalent plastic strain.
enum class HardeningLaw {
  elastic,      ///< no yielding
  power,        ///< sigma_y + k eps_p^m (paper Eq. 1)
  total_strain, ///< sigma = n eps^p on the total strain, elastic until E eps = n eps^p (paper Eq. 8)
  table,        ///< piecewise linear in eps_p, constant beyond the last point
};

struct HardeningParameters {
  HardeningLaw law = HardeningLaw::power;
  double yield_stress = 0;                  ///< sigma_y, MPa (power)
  double coefficient = 0;                   ///< k (power) or n (total_strain), MPa
  double exponent = 1;                      ///< m (power) or p (total_strain), dimensionless, in (0, 1]
  std::vector<double> table_plastic_strain; ///< table: increasing, first value 0
  std::vector<double> table_flow_stress;    ///< table: MPa, positive
  bool operator==(const HardeningParameters&) const = default;
};

struct MaterialParameters {
  double density = 0;        ///< tonne/mm^3
  double youngs_modulus = 0; ///< MPa
  double poissons_ratio = 0; ///< dimensionless, (-1, 0.5)
  HardeningParameters hardening;
  bool operator==(const MaterialParameters&) const = default;
};

/// Grains of another material than the others.
struct GrainMaterial {
  std::vector<std::int64_t> grains; ///< numbers in the packing, from 0
  MaterialParameters material;
  bool operator==(const GrainMaterial&) const = default;
};

/// What a grain's contact nodes stand for.
enum class ContactSurface {
  automatic, ///< smooth for grains that were meshed as spheres with their volume, facets for all others
  facets,    ///< the mesh as it is: nodes of a curved surface, meshed with its volume, stand out of it
  smooth,    ///< the curved surface of the same volume (solver/model/smooth_surface.hpp)
};

struct ContactParameters {
  double stiffness_factor = 10;    ///< penalty K = factor * E / h, h the mean facet edge of the grain
  std::optional<double> stiffness; ///< K itself, MPa/mm, where it is given instead (locally refined meshes)
  double search_margin = 0.3;      ///< candidates are kept for gaps up to this multiple of h
  ContactSurface surface = ContactSurface::automatic;
  bool penalty_differs(const ContactParameters& other) const {
    return stiffness_factor != other.stiffness_factor || stiffness != other.stiffness;
  }
};

/// Cohesive bonds that form where grains touch (paper Eqs. 2-7, Table 1).
struct BondParameters {
  double tensile_strength = 0; ///< MPa
  double shear_strength = 0;   ///< MPa, in both tangential directions
  double fracture_energy = 0;  ///< G^c, N/mm, in every mode
  SofteningLaw softening = SofteningLaw::exponential;
  bool rebond_on_contact = false; ///< a broken bond's point bonds anew when it has opened and closes again
  bool normal_only = false;       ///< no resistance against sliding (for comparison with theories of adhesion)
  bool operator==(const BondParameters&) const = default;
};

/// Linear tetrahedra with one Gauss point.
enum class ElementType {
  tet4,       ///< pressure of every tet from its own volume: locks in plastic flow
  tet4_anp,   ///< average nodal pressure: pressure from the volumes around the nodes (Bonet and Burton 1998)
  tet4_patch, ///< F-bar patches: pressure from the volume of eight tets together (de Souza Neto et al. 2005)
};
/// Name of an element in scenarios and on the command line.
const char* element_name(ElementType element);
/// Share of each tet's own pressure with which an element is used where the scenario says nothing.
double usual_own_pressure(ElementType element);

/// Numbers in which the element pass works.
enum class Precision {
  full,  ///< doubles
  mixed, ///< floats for strains, stresses and histories of tets; doubles for all of nodes, contact, walls, time and energies' sums
};

/// Name of a precision in scenarios and on the command line.
const char* precision_name(Precision precision);

/// Whose largest frequency sets the stable step.
enum class StepEstimate {
  grain, ///< that of each grain as a whole, found by iteration
  tet,   ///< that of the worst tet by itself, a proven bound, some quarter shorter
};

struct NumericsParameters {
  ElementType element = ElementType::tet4;
  double own_pressure = 0; ///< tet4_anp, tet4_patch: share of each tet's own pressure, [0, 1]; 1 is tet4
  Precision precision = Precision::full;
  double time_step_factor = 0.9; ///< safety factor on the stable step, (0, 2]; beyond 1 nothing is proven
  StepEstimate step_estimate = StepEstimate::grain;
  double bulk_viscosity_linear = 0.06;
  double bulk_viscosity_quadratic = 1.2;
  double mass_scaling = 1;      ///< uniform factor on the density
  double mass_scaling_step = 0; ///< s: nodes are made heavier where the step at the start would be smaller; 0: none
  bool mass_scaling_lighten = false; ///< and lighter where it would be larger: locally refined meshes, slow processes
};

struct OutputParameters {
  int history_rows = 200;                          ///< rows per stage
  std::vector<double> snapshot_relative_densities; ///< a snapshot when the density first passes each of these
  bool snapshot_at_stage_end = true;
  std::vector<double> checkpoint_relative_densities; ///< a checkpoint that stays when the density first passes each
  double checkpoint_interval = 60;                   ///< s of wall-clock time between rolling checkpoints
};

/// Isotropic compaction by six walls to a relative density; smooth start and end.
struct IsotropicCompaction {
  double relative_density = 0; ///< target, reference grain volume over box volume
  double wall_speed = 0;       ///< plateau speed of every wall, mm/s
  double ramp_fraction = 0.1;  ///< fraction of the stage's time spent in each of the smooth start and end
};

/// Six walls move apart until the mean stress has fallen to a target. They slow down as they come near it.
struct IsotropicUnloading {
  double mean_stress = 0;     ///< target, MPa
  double wall_speed = 0;      ///< largest speed of every wall, mm/s
  double ramp_fraction = 0.1; ///< smooth start, as a fraction of the time in which the box would grow by 3 % in length
};

/// The nodes near two opposite faces of the box are gripped and moved along the box's axis. Walls take no part.
struct GripMotion {
  int axis = 2;                    ///< 0 x, 1 y, 2 z
  double depth = 0;                ///< mm: nodes so near to a face of the box when the stage begins
  bool lateral_fixed = true;       ///< gripped nodes do not move across the axis
  double displacement = 0;         ///< mm, change of the distance between both grips; positive apart
  std::array<double, 3> sliding{}; ///< mm, of the high grip against the low one, across the axis
  double speed = 0;                ///< plateau speed of each grip, mm/s
  double ramp_fraction = 0.1;
};

/// Nothing moves: free flight, vibration, settling.
struct Hold {
  double duration = 0; ///< s
};

/// What the walls of a stage do whose end is not a matter of time: some are driven, some are held at a stress.
enum class LoadingPath {
  isotropic,  ///< all walls together, to a mean stress
  cycles,     ///< all walls together, between two mean stresses
  unconfined, ///< x and y walls away, z walls driven
  triaxial,   ///< x and y walls held at a stress or force, z walls driven
  die,        ///< x and y walls at rest, z walls driven
  probe,      ///< all walls held on a straight path of mean and deviatoric stress
  held,       ///< all walls held at one stress, for a time
};

/// What ends a loading: the first of those that are given. Strains are logarithmic, since the stage began, compression
/// positive; stresses are those of the walls, MPa.
struct LoadingEnds {
  std::optional<double> axial_strain;      ///< negative: the walls move apart
  std::optional<double> relative_density;  ///< reference grain volume over box volume
  std::optional<double> axial_stress;      ///< MPa
  std::optional<double> mean_stress;       ///< MPa
  std::optional<double> deviatoric_stress; ///< MPa
  std::optional<double> stress_drop; ///< fall below the peak of the axial stress (unconfined) or of |q|, over the peak
  std::optional<double> dissipation_ratio; ///< plastic and damage dissipation over its value when the stage began
  std::optional<double> duration;          ///< s
};

/// Driven and servo-held walls.
struct WallLoading {
  LoadingPath path = LoadingPath::isotropic;
  double wall_speed = 0;      ///< largest speed of every driven wall, and of a probe, mm/s
  double servo_speed = 0;     ///< largest speed of every held wall, mm/s
  double ramp_fraction = 0.1; ///< of the time of the whole way (of 5 % of strain where that is not known) to full speed
  bool hold_force = true;     ///< triaxial: the lateral walls' force is held; false: their stress
  std::optional<double> lateral_stress; ///< triaxial, MPa: to be held; none: what acts when the stage begins
  double held_stress = 0;               ///< held, MPa
  std::array<double, 2> direction{};    ///< probe: of the path, in mean and deviatoric stress
  double lowest_mean_stress = 0;        ///< cycles, MPa
  double highest_mean_stress = 0;       ///< cycles, MPa
  std::int64_t cycles = 0;              ///< up and down again
  LoadingEnds ends;
};

/// Mass-proportional damping of each grain's velocity relative to the affine velocity at the grain's centre. It fades
/// from full at mean stress 0 to nothing at `fade_stress`.
struct DampingParameters {
  double rate = 0;        ///< 1/s; force = -rate * m * (v - v_affine)
  double fade_stress = 0; ///< MPa
};

/// Tolerances of quasi-static loading, between whose bounds a stage chooses its speed (solver/run/pace.hpp).
struct QuasiStatic {
  double kinetic_tolerance = 0.01; ///< kinetic energy over internal energy gained in the stage or stored at its start
  double stress_tolerance = 0.02;  ///< what inertia bears of the wall stresses, over the largest of them
  double slowest_speed = 0;        ///< mm/s
  double fastest_speed = 0;        ///< mm/s
  double loose_stress = 0;         ///< MPa: below this wall stress the packing is loose and the speed stays as it is
};

struct Stage {
  std::string name;
  std::optional<IsotropicCompaction> isotropic_compaction; ///< exactly one of these is set
  std::optional<IsotropicUnloading> isotropic_unloading;
  std::optional<GripMotion> grip;
  std::optional<Hold> hold;
  std::optional<WallLoading> loading;
  std::optional<QuasiStatic> quasi_static; ///< none: the stage keeps its speed
  DampingParameters damping;
  KeyPlaces places; ///< of its keys

  /// mm/s of each driven wall or grip, where nothing else is asked for; 0 where nothing moves.
  double speed() const {
    return isotropic_compaction  ? isotropic_compaction->wall_speed
           : isotropic_unloading ? isotropic_unloading->wall_speed
           : grip                ? grip->speed
           : loading             ? loading->wall_speed
                                 : 0.0;
  }
};

struct Scenario {
  std::string packing_file;                   ///< meshed packing; relative to the scenario's folder
  bool walls = true;                          ///< the six walls of the box
  MaterialParameters material;                ///< of all grains but those of grain_materials
  std::vector<GrainMaterial> grain_materials; ///< no grain stands in two of them
  ContactParameters contact;
  std::optional<BondParameters> bond; ///< none: grains do not stick
  NumericsParameters numerics;
  OutputParameters output;
  std::array<double, 3> initial_velocity{};                  ///< mm/s, of all grains
  std::vector<std::array<double, 3>> grain_velocity;         ///< mm/s, of each grain (overrides; empty: none)
  std::vector<std::array<double, 3>> grain_angular_velocity; ///< rad/s, about each grain's centroid (empty: none)
  std::vector<Stage> stages;
  KeyPlaces bond_places; ///< of the keys of [bond]
  std::string text;      ///< the TOML text, with values set on the command line
};

/// Reads the keys of a [bond] table. Throws InputError.
BondParameters read_bond(TableReader table);

/// Reads a scenario. Throws InputError with file, line and column for any mistake.
Scenario read_scenario(const TomlDocument& document);

} // namespace mpfem
