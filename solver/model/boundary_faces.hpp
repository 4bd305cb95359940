#pragma once
// The surface of a grain's mesh.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mpfem {

/// Faces that belong to one tetrahedron only, outward counter-clockwise, of the tets `tet` [tets * 4] of a grain.
/// `grain_name` stands for the grain in messages. Throws InputError where more than two tetrahedra share a face, or the
/// faces left over do not close the grain.
std::vector<std::array<std::int32_t, 3>> boundary_faces(std::span<const std::int32_t> tet,
                                                        const std::string& grain_name);

} // namespace mpfem
