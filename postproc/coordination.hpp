#pragma once
// Coordination numbers: with and without rattlers, with and without walls.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "postproc/measurement.hpp"

namespace mpfem {

/// What touches what.
struct ContactGraph {
  struct Pair {
    std::array<std::int32_t, 2> grains{};
    bool bonded = false; ///< by at least one unbroken bond
  };
  std::vector<Pair> pairs; ///< each once
  std::vector<int> walls;  ///< [grains], how many walls each touches
};

/// Which grains are rattlers: grains that no unbroken bond holds and that have fewer than `fewest` contacts with walls
/// and with grains that are none themselves, found by taking them away until no more are found. Without friction it
/// takes four contacts to hold a grain in space, three forces in a plane leaving it free across (Agnolin and Roux,
/// Phys. Rev. E 76 (2007) 061302).
std::vector<bool> find_rattlers(const ContactGraph& graph, int fewest);

/// Contacts of the grains in `counted`, with each other and, where `with_walls`, with walls.
std::vector<double> contacts_of(const ContactGraph& graph, const std::vector<bool>& counted, bool with_walls);

/// The contacts of a snapshot (numbered as in snapshot_name): pairs of grains that touch or are held by an unbroken
/// bond, and walls that push. Throws InputError where the snapshot does not tell the walls' forces.
ContactGraph contact_graph(const schema::FileReader& file, int snapshot);

/// The mean number of contacts of a grain that is no rattler, walls included, and the other three ways of counting it.
/// Uncertainty: half of the 95 % interval of a mean over grains, taken as independent. Throws InputError.
Measurement measure_coordination(const schema::FileReader& file, int snapshot, int fewest);

} // namespace mpfem
