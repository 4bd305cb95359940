#pragma once
// Whether the ranks have equal shares of the measured work, and how the grains are redistributed if not.

#include <cstdint>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// How the work was divided for some time.
struct Balance {
  double imbalance = 1;            ///< busy time of the busiest rank over the mean of all
  std::vector<double> busy_of_tet; ///< [ranks], s per tet
};

/// Collective. `busy`: s that this rank has worked, without waiting for others.
Balance measure_balance(const Communicator& ranks, const Model& model, double busy);

/// Collective. The owner of each grain ([grains]) by recursive bisection of their current positions. The
/// weight of a grain is what its tets have cost its current owner.
std::vector<std::int32_t> redistribute(const Communicator& ranks, const Model& model, const Balance& balance);

/// Busy time of the busiest rank over the mean if the grains belonged to `owner` ([grains]), and their tets cost what
/// they have cost so far.
double expected_imbalance(const Model& model, const Balance& balance, std::span<const std::int32_t> owner);

/// Whether redistributing pays: the busiest rank then has less work by more than `balance` is known to, and that saves
/// more than twice what it costs (`reload`, s). `expected`: the imbalance afterwards. `remaining`: s that the rest of
/// the run takes if nothing changes.
bool pays(const Balance& balance, double expected, double remaining, double reload);

} // namespace mpfem
