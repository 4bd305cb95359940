#pragma once
// One contact between two grains in detail, bond by bond.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "postproc/run_data/contact_plane.hpp"
#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// A bond of a surface node of one grain to the surface of the other.
struct ContactBond {
  std::int32_t node = 0, grain = 0; ///< the node, and the grain that it belongs to
  std::array<double, 3> x{};        ///< mm
  double u = 0, v = 0;              ///< mm, in the contact's mean plane about the area centroid
  double damage = 0;                ///< 0 intact … 1 broken
  double area = 0;                  ///< mm^2
  double opening = 0, sliding = 0;  ///< mm
};

/// One contact with all of its bonds.
struct ContactMap {
  std::string snapshot;
  double relative_density = 0, mean_stress = 0;   ///< 1, MPa
  std::pair<std::int32_t, std::int32_t> grains{}; ///< first < second
  std::array<double, 3> force{};                  ///< N, of the second grain on the first
  double area = 0, bonded_area = 0;               ///< mm^2, means of the two sides
  double damage = -1;                             ///< area-weighted mean; -1 where no bond was ever formed
  double bond_energy = 0, damage_dissipation = 0; ///< mJ
  ContactPlane plane;                             ///< normal from the first grain to the second
  std::vector<ContactBond> bonds;                 ///< of both sides, broken ones too, in the file's order
};

/// The contact of two grains, given in either order, at a snapshot (numbered as in snapshot_name). Throws InputError
/// where there is no such snapshot, where it has no bonds, and where these are not two grains in contact.
ContactMap contact_map(const schema::FileReader& file, int snapshot, std::pair<int, int> grains);

/// All numbers by name.
nlohmann::ordered_json to_json(const ContactMap& map);

/// The bonds as CSV: node, grain of the node, position, in-plane coordinates, damage, area, opening, sliding.
std::string contact_points_csv(const ContactMap& map);

} // namespace mpfem
