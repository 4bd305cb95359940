#pragma once
// `mpfem bench`: what a step costs on this machine, part by part, compared with what the machine can do.

#include <cstdint>
#include <optional>
#include <string>

#include "solver/parallel/communicator.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// What is measured, and on which packing.
struct BenchOptions {
  int threads = 1;
  std::int64_t tets = 200'000;
  int grains = 329;
  ElementType element = ElementType::tet4;
  Precision precision = Precision::full;
  bool bonds = true;
  double friction = 0;              ///< mu between grains and at walls
  int steps = 150;                  ///< measured after the packing has begun to flow
  std::optional<Scenario> scenario; ///< instead of the built-in packing
  std::optional<std::string> from;  ///< checkpoint whose state is measured (with a scenario)
  bool json = false;
  bool quiet = false;
};

/// Collective. Measures and prints a table, or one object with `json`. With several ranks, times of parts of a step are
/// those of the first rank, and contact searches are not measured alone. Throws InputError.
void run_bench(const BenchOptions& options, const Communicator& ranks = Communicator());

} // namespace mpfem
