#pragma once
// A body from an STL file: a closed and oriented surface of triangles, with a report on the repairs.
//
// Faults with only one possible meaning are repaired and counted: corners at the same place become one vertex,
// triangles that thereby lose their area are left out, edges of triangles without area are flipped (flip_slivers.hpp),
// and a surface that is inside out as a whole is reversed. All other faults are refused: the inside of an open or
// contradictory surface could only be guessed.

#include <cstddef>
#include <string>
#include <string_view>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

/// What was found in a file, and what was repaired.
struct StlFindings {
  bool binary = false;
  std::size_t triangles = 0, vertices = 0; ///< of the surface after repairs
  std::size_t shells = 0;                  ///< closed parts that share no edge
  Bounds bounds{};                         ///< mm
  double volume = 0;                       ///< mm^3, enclosed
  std::size_t dropped = 0;                 ///< triangles left out because two corners coincide
  std::size_t flipped = 0;                 ///< edges flipped because a triangle had its corners on one line
  std::size_t other_normals = 0;           ///< stored normals that differ from the triangle's own; they are ignored
  bool turned = false;                     ///< the surface was inside out in the file
};

/// A surface that can be used, with the report on it.
struct StlBody {
  TriangleMesh mesh; ///< closed, oriented, every triangle with area
  StlFindings findings;
};

/// `scale`: the file's unit of length in mm (1 for mm, 1000 for m, 25.4 for inches). Throws InputError, one line with
/// the file, the number of a triangle and its place in mm: not an STL file, no extent, coordinates beyond 1e9 mm,
/// triangles without area that no flip repairs, edges that are not shared by two triangles in opposite directions, no
/// volume, contradictory shells (one inside out, or one inside another).
StlBody read_stl(const std::string& path, double scale);
/// The same for a file's bytes; `name` is used in messages.
StlBody stl_body(std::string_view bytes, const std::string& name, double scale);

/// The findings in one line of text.
std::string describe(const StlFindings& findings);

} // namespace mpfem
