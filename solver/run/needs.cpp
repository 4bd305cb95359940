#include "solver/run/needs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include <sys/statvfs.h>

#include <fmt/format.h>

#include "common/available_memory.hpp"
#include "common/errors.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/model/model.hpp"
#include "solver/output/tool_history.hpp"
#include "solver/parallel/agree.hpp"
#include "solver/parallel/share_of_cores.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

namespace {

// The sizes of arrays follow from their types. The other numbers are measured: peak memory and files of nine runs to a
// relative density of 0.92 (docs/performance.md).
constexpr double of_program = 22e6; // libraries, code, HDF5
constexpr double of_contact = 102;  // a facet: points, their forces and candidates, with the search's own
constexpr double of_bonds = 65;     // a facet more
// A facet more, as many points as bonds.
constexpr double of_friction = of_bonds * sizeof(PointFriction) / (sizeof(PointBond) + sizeof(ContactForce));
constexpr double margin = 0.1; // of the available memory: the error that the forecast may have

template <class Real>
double bytes_of_tet() {
  return static_cast<double>(sizeof(TetBlock<Real>)) / TetBlock<Real>::lanes;
}

double number(std::int64_t count) {
  return static_cast<double>(count);
}

/// "1.64 GB", "59 MB"
std::string size_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", 1e-6 * bytes) : fmt::format("{:.3g} GB", 1e-9 * bytes);
}

/// Share of all grains that one of `ranks` holds, its ghosts included: those of the layer around its own, without that
/// at the packing's surface (docs/performance.md has the ghosts of 10,000 grains).
double share_of_grains_held(double grains, int ranks) {
  const double own = grains / ranks, around = 6 * std::min(own, std::pow(own, 2.0 / 3.0));
  return std::min(1.0, (own + around * (1 - std::pow(ranks, -1.0 / 3.0))) / grains);
}

/// Share of an array's memory pages that a rank touches if it holds this share of the grains, each with so many bytes
/// of the array. Imported grains may be numbered without regard to their places, so that a page has grains of several
/// ranks; those of pack-gen need less.
double share_of_pages(double held, double bytes_of_grain) {
  constexpr double page = 4096; // bytes
  return 1 - std::pow(1 - held, 1 + page / bytes_of_grain);
}

/// Bytes of a grain, on every rank: what tools bear, and lists of what rubs on and sticks to tools and walls.
double bytes_of_boundaries(const Scenario& scenario) {
  constexpr std::size_t tool = sizeof(ToolLoad) + sizeof(std::vector<SurfaceAnchor>) + sizeof(std::vector<SurfaceBond>);
  constexpr std::size_t walls = 6 * sizeof(std::vector<SurfaceAnchor>);
  return static_cast<double>(scenario.tools.size() * tool + walls);
}

/// Bytes of one rank.
double memory_of(const PackingCounts& packing, const Scenario& scenario, int ranks) {
  const NumericsParameters& numerics = scenario.numerics;
  // Position, velocity and force; inverse mass, reference area, number in the file; volume and mean of averaged
  // pressure; the inner node and its share where contact is by the smooth surface.
  constexpr double row = 4 * sizeof(double);
  double node = 3 * row + 2 * sizeof(double) + sizeof(std::int32_t);
  if (numerics.element == ElementType::tet4_anp) node += 2 * sizeof(double);
  if (scenario.contact.surface != ContactSurface::facets) node += sizeof(std::int32_t) + sizeof(double);
  const double block = numerics.precision == Precision::mixed ? bytes_of_tet<float>() : bytes_of_tet<double>();
  // Its number in the file, and the copy of one array for a checkpoint.
  const double tet = block + sizeof(std::int32_t) + sizeof(double);
  const double facet = 3 * sizeof(std::int32_t) + of_contact + (scenario.bond ? of_bonds : 0.0) +
                       (scenario.contact.has_friction() ? of_friction : 0.0);
  const double rows = scenario.output.history_rows * static_cast<double>(scenario.stages.size());
  const double tets = number(packing.all_tets()), nodes = number(packing.nodes);
  const double grains = std::max(1.0, static_cast<double>(packing.tets.size()));
  const double held = share_of_grains_held(grains, ranks);
  return of_program + tet * tets * share_of_pages(1.0 / ranks, block * tets / grains) +
         node * nodes * share_of_pages(held, row * nodes / grains) + facet * packing.facets() * held +
         bytes_of_boundaries(scenario) * grains + 2 * bytes_of_row(scenario) * rows;
}

double disk_of(const PackingCounts& packing, const Scenario& scenario) {
  const OutputParameters& output = scenario.output;
  const double tets = number(packing.all_tets()), nodes = number(packing.nodes), facets = packing.facets();
  const auto stages = static_cast<double>(scenario.stages.size());
  // Eight numbers of a tet, thirteen of a node, and contact points; measured, since most points have few candidates.
  const double checkpoint = 64 * tets + 104 * nodes + (scenario.bond ? 43.0 : 20.0) * facets +
                            (scenario.contact.has_friction() ? 24.0 * facets : 0.0);
  // Checkpoints that stay, the rolling one, and the one that is being written.
  const double checkpoints = stages + 2 + static_cast<double>(output.checkpoint_relative_densities.size());
  // Snapshots are files next to the run file until it contains them all.
  double snapshots =
      (output.snapshot_at_stage_end ? stages : 0.0) + static_cast<double>(output.snapshot_relative_densities.size());
  for (const Stage& stage : scenario.stages) snapshots += std::min(stage.snapshots, output.history_rows);
  const double snapshot = 22 * tets, mesh = 11 * tets;
  const double history = bytes_of_row(scenario) * output.history_rows * stages; // so far, in checkpoints too
  return checkpoints * (checkpoint + history) + 2 * snapshots * snapshot + mesh + history;
}

/// "memory", …: empty, a warning, or InputError.
std::string compare(const std::string& purpose, const char* what, double needed, double available) {
  if (needed <= (1 - margin) * available) return {};
  const std::string text = fmt::format("{}: the run needs about {} of {}, {} are available", purpose, size_text(needed),
                                       what, size_text(available));
  if (needed > (1 + margin) * available)
    throw InputError(text + (what[0] == 'm'
                                 ? ", allowed: a coarser mesh, element.precision = \"mixed\", or more memory (also "
                                   "that of more machines, with mpirun)"
                                 : ", allowed: fewer checkpoints and snapshots, or an --output on another disk"));
  return text;
}

} // namespace

double bytes_of_row(const Scenario& scenario) {
  return static_cast<double>(sizeof(HistoryRow) + scenario.tools.size() * sizeof(ToolRow));
}

Needs needs_of(const PackingCounts& packing, const Scenario& scenario, int ranks) {
  return {memory_of(packing, scenario, ranks), disk_of(packing, scenario)};
}

Needs needs_of(const Scenario& scenario, int ranks) {
  try {
    return needs_of(read_packing_counts(scenario.packing_file), scenario, ranks);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}key 'packing': {}", scenario.places.prefix("packing"), error.what()));
  }
}

double available_disk_space(const std::string& file) {
  struct statvfs system {};
  const auto folder = std::filesystem::absolute(file).parent_path();
  if (statvfs(folder.c_str(), &system) != 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize);
}

std::string check_needs(const std::string& purpose, const Needs& needs, const Needs& available) {
  const std::string memory = compare(purpose, "memory", needs.memory, available.memory),
                    disk = compare(purpose, "disk space", needs.disk, available.disk);
  return memory.empty() || disk.empty() ? memory + disk : memory + "; " + disk;
}

std::string check_memory(const std::string& purpose, double of_rank, const Communicator& ranks) {
  const double needed = ranks_on_this_machine(ranks) * ranks.largest(of_rank);
  std::string scarce;
  agree(ranks, [&] { scarce = check_needs(purpose, {.memory = needed}, {.memory = available_memory()}); });
  return scarce;
}

} // namespace mpfem
