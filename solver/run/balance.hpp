#pragma once
// Whether the ranks have equal shares of the measured work, and how the grains are redistributed if not.

#include <cstdint>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// s that a rank has worked for some time, without waiting for others.
struct BusyTime {
  double tets = 0;    ///< on work in proportion to tetrahedra: elements, surfaces, integration
  double contact = 0; ///< on contact points

  double total() const { return tets + contact; }
};

/// How the work was divided for some time.
struct Balance {
  double imbalance = 1;     ///< busy time of the busiest rank over the mean of all
  std::vector<double> cost; ///< [grains], s that each grain has cost its owner
};

/// Collective. `busy` is that of this rank. `contact_work` ([grains], in any unit): work on contact of each grain, set
/// for the rank's own grains. A rank's grains share its two times by their tetrahedra and by this work.
Balance measure_balance(const Communicator& ranks, const Model& model, std::span<const double> contact_work,
                        const BusyTime& busy);

/// Collective. The owner of each grain ([grains]) by recursive bisection of their current positions, weighted by what
/// they have cost their current owners.
std::vector<std::int32_t> redistribute(const Communicator& ranks, const Model& model, const Balance& balance);

/// Busy time of the busiest of `ranks` ranks over the mean if the grains belonged to `owner` ([grains]) and cost what
/// they have cost so far.
double expected_imbalance(const Balance& balance, std::span<const std::int32_t> owner, int ranks);

/// Whether redistributing pays: the busiest rank then has less work by more than `balance` is known to, and that saves
/// more than twice what it costs (`reload`, s). `expected`: the imbalance afterwards. `remaining`: s that the rest of
/// the run takes if nothing changes.
bool pays(const Balance& balance, double expected, double remaining, double reload);

} // namespace mpfem
