#pragma once
// The triangles of an STL file as they stand in it.
//
// Binary form: 80 bytes of any text, the number n of triangles (32 bits), and for each twelve 32-bit numbers (normal
// and three corners) and two bytes more, all little-endian. Text form: `solid NAME`, for each triangle `facet normal`
// and three numbers, `outer loop`, three times `vertex` and three numbers, `endloop`, `endfacet`, and at last `endsolid
// NAME`; several solids may follow each other. (3D Systems, StereoLithography Interface Specification, 1988.)

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Lengths in the unit of the file, which the file does not name.
struct StlFacet {
  Vector3<double> normal; ///< as stored: often of another length than 1, zero, or no number
  std::array<Vector3<double>, 3> corner;
};

struct StlFacets {
  std::vector<StlFacet> facet;
  bool binary = false;
};

/// `bytes`: the whole file, `name` stands for it in messages. The file is binary where it has the 84 + 50 n bytes that
/// its own n asks for: text files begin with "solid", but many binary ones do, too. Throws InputError: neither form, a
/// word or a number missing (with its line), corners that are not finite, no triangle at all.
StlFacets read_stl_facets(std::string_view bytes, const std::string& name);

} // namespace mpfem
