#pragma once
// What `mpfem bench` has measured, and how it is printed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "solver/bench/work.hpp"
#include "solver/run/profile.hpp"

namespace mpfem {

/// What was measured: the state of the packing.
struct BenchScene {
  std::string element, precision;
  int ranks = 1;
  int threads = 1; ///< of each rank
  int lanes = 1;   ///< tets in a pack
  std::int32_t tets = 0;
  int grains = 0;
  int steps = 0; ///< requested
  double relative_density = 0;
  double bonds = 0;
  double contact_points = 0;
  std::int64_t candidate_points = 0;
};

/// Cost of a step, in ns per tet and step.
struct StepCost {
  double whole = 0;
  std::array<double, profile_parts> part{};
  double of(Part p) const { return part[static_cast<std::size_t>(p)]; }
};

/// The element pass alone, over all grains, while most tets harden.
struct ElementCost {
  double nanoseconds = 0; ///< per tet and step
  double hardening = 0;   ///< fraction of the tets that yielded in the last pass
};

/// A contact search. All 0 with several ranks.
struct SearchCost {
  double seconds = 0;
  double steps = 0; ///< that one search lasts at the current speeds of the grains
};

/// A row of the history and a checkpoint.
struct OutputCost {
  double row_seconds = 0, checkpoint_seconds = 0, checkpoint_bytes = 0;
  double steps_per_row = 0, checkpoint_interval = 0; ///< s
};

/// The best that the machine does, or that the machines of all ranks do.
struct MachineLimits {
  double triad = 0; ///< GB/s
  double fma = 0;   ///< GFlop/s
};

/// What several ranks cost each other in a step.
struct RankCost {
  double sent = 0;                 ///< bytes per step, of the rank that sends most
  double waited_for_messages = 0;  ///< ns per tet-step, mean of the ranks: between neighbours
  double waited_in_sums = 0;       ///< the same, in the sums over all ranks
  double waited_in_sums_least = 0; ///< the same, of the rank that waits least: the sums themselves cost at most this
  double imbalance = 1; ///< busy time of the busiest rank over the mean: elements, contact, integration, normals
};

/// Everything that is printed.
struct BenchResult {
  BenchScene scene;
  StepCost step;
  ElementCost elements;
  SearchCost search;
  OutputCost output;
  MachineLimits machine;
  Work tet, integration;     ///< for a tet; all nodes
  Work contact, search_work; ///< for all points; a search. Of one rank only
  double memory = 0;         ///< bytes, the peaks of all ranks added up
  double memory_of_root = 0; ///< bytes, the peak of the first rank
  RankCost ranks;

  bool alone() const { return scene.ranks == 1; }
  /// ns per tet, of some seconds.
  double per_tet(double seconds) const { return 1e9 * seconds / scene.tets; }
  /// ns per contact point, of ns per tet; 0 without contact.
  double per_point(double per_tet_step) const {
    return scene.contact_points > 0 ? per_tet_step * scene.tets / scene.contact_points : 0.0;
  }
  /// ns per tet and step: a search over the steps that it lasts.
  double search_per_step() const;
  /// ns per tet and step: rows over the steps between two, checkpoints over the time between two.
  double output_per_step() const;
};

/// One JSON object.
std::string json_text(const BenchResult& result);

/// Tables of the costs, and of the bytes and operations compared with the machine's limits.
std::string table_text(const BenchResult& result);

} // namespace mpfem
