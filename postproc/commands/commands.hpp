#pragma once
// All subcommands of postproc except those for figures (figure/figure_commands.hpp), one class each.

#include <memory>

namespace CLI {
class App;
}

namespace mpfem {

class Command;
using MakeCommand = std::unique_ptr<Command>(CLI::App&);

// Tables and pictures of a run or its snapshots.
MakeCommand summary_command, curve_command, contact_command, vtk_command, section_command, density_map_command,
    view_command, watch_command;

// One number from a stage of a run.
MakeCommand elastic_recovery_command, modulus_command, strength_command, yield_command, hysteresis_command,
    quasi_static_command, triaxial_command, energy_command;

// One number from a snapshot or a whole run.
MakeCommand damage_command, stress_path_command, section_stress_command, section_damage_command,
    stress_at_densities_command, compaction_quality_command;

// One number that the paper does not have.
MakeCommand unload_reload_modulus_command, offset_yield_command, coordination_command, inner_stress_command,
    damage_of_test_command, damage_band_command;

// Measurements of tablets.
MakeCommand tablet_command, heckel_command, diametral_command;

// For points, and for files of any kind.
MakeCommand fit_command, validate_command, cost_command;

} // namespace mpfem
