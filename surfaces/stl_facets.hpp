#pragma once
// The triangles of an STL file as stored.
//
// Binary form: 80 bytes of any text, the number n of triangles (32 bits), and for each triangle twelve 32-bit numbers
// (normal and three corners) and two more bytes, all little-endian. Text form: `solid NAME`; for each triangle `facet
// normal` and three numbers, `outer loop`, three times `vertex` and three numbers, `endloop`, `endfacet`; at the end
// `endsolid NAME`. Several solids may follow each other. (3D Systems, StereoLithography Interface Specification, 1988.)

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "solver/physics/tensor.hpp"

namespace mpfem {

/// Lengths are in the file's unit, which the file does not state.
struct StlFacet {
  Vector3<double> normal; ///< as stored: often not of length 1, zero, or NaN
  std::array<Vector3<double>, 3> corner;
};

/// All triangles of a file.
struct StlFacets {
  std::vector<StlFacet> facet;
  bool binary = false;
};

/// `bytes`: the whole file; `name` is used in messages. The file is binary if it has the 84 + 50 n bytes that its own n
/// requires: text files begin with "solid", but so do many binary ones. Throws InputError: neither form, a word or a
/// number missing (with its line), corners that are not finite, no triangles.
StlFacets read_stl_facets(std::string_view bytes, const std::string& name);

} // namespace mpfem
