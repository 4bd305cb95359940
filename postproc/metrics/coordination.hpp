#pragma once
// Coordination numbers: with and without rattlers, with and without walls.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Contacts among grains and between grains and walls.
struct ContactGraph {
  struct Pair {
    std::array<std::int32_t, 2> grains{};
    bool bonded = false; ///< by at least one intact bond
  };
  std::vector<Pair> pairs; ///< each once
  std::vector<int> walls;  ///< [grains], number of walls that each touches
};

/// [grains], true for rattlers: grains without an intact bond and with fewer than `fewest` contacts. Only contacts
/// with walls and with grains that are not rattlers count, so rattlers are removed until no more are found. Without
/// friction four contacts are needed to hold a grain in space; three forces in a plane leave it free to move out of the
/// plane (Agnolin and Roux, Phys. Rev. E 76 (2007) 061302).
std::vector<bool> find_rattlers(const ContactGraph& graph, int fewest);

/// [grains], number of contacts of the grains in `counted`: with each other and, if `with_walls`, with walls.
std::vector<double> contacts_of(const ContactGraph& graph, const std::vector<bool>& counted, bool with_walls);

/// The contacts of a snapshot (numbered as in snapshot_name): pairs of grains that touch or share an intact bond, and
/// walls that push. Throws InputError where the snapshot has no wall forces.
ContactGraph contact_graph(const schema::FileReader& file, int snapshot);

/// Mean number of contacts of the grains that are not rattlers, walls included; the details also count with rattlers
/// and without walls. Uncertainty: half of the 95 % interval of a mean over grains, taken as independent. Throws
/// InputError.
Measurement measure_coordination(const schema::FileReader& file, int snapshot, int fewest);

} // namespace mpfem
