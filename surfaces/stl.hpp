#pragma once
// A body given as an STL file: a closed and oriented surface of triangles, and what was found on the way to it.
//
// What has one meaning only is mended and counted: corners at the same place become one vertex, triangles that lose
// their area by that are left out, edges of triangles without area are flipped (flip_slivers.hpp), and a surface that
// is turned inside out as a whole is turned round. Everything else is refused: what lies inside of an open or a
// contradictory surface is a matter of guessing.

#include <cstddef>
#include <string>
#include <string_view>

#include "surfaces/triangle_mesh.hpp"

namespace mpfem {

struct StlFindings {
  bool binary = false;
  std::size_t triangles = 0, vertices = 0; ///< of the surface that is used
  std::size_t shells = 0;                  ///< closed parts that share no edge
  Bounds bounds{};                         ///< mm
  double volume = 0;                       ///< mm^3, enclosed
  std::size_t dropped = 0;                 ///< triangles of the file with two corners at the same place: left out
  std::size_t flipped = 0;                 ///< edges flipped, because a triangle had its corners on one line
  std::size_t other_normals = 0;           ///< stored normals that point away from the triangle's own; they are ignored
  bool turned = false;                     ///< the file had the surface inside out
};

struct StlBody {
  TriangleMesh mesh; ///< closed, oriented, every triangle with area
  StlFindings findings;
};

/// `scale`: mm in the file's unit of length (1 for mm, 1000 for m, 25.4 for inches). Throws InputError, one line with
/// the file and a place in mm: no STL file, no extent, coordinates beyond 1e9 mm, triangles without area that no flip
/// mends, edges that two triangles do not share in opposite directions, no volume, shells that contradict each other
/// (one inside out, or one in another).
StlBody read_stl(const std::string& path, double scale);
/// The same of a file's bytes; `name` stands for it in messages.
StlBody stl_body(std::string_view bytes, const std::string& name, double scale);

/// The findings in one line, for people.
std::string describe(const StlFindings& findings);

} // namespace mpfem
