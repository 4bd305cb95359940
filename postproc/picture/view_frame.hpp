#pragma once
// Parallel projection of space onto a picture.

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "postproc/picture/picture_scene.hpp"

namespace mpfem {

/// Size of a picture.
struct PictureSize {
  int width = 1200, height = 1000; ///< pixels
};

/// A parallel projection; pixels count from the picture's lower left corner.
struct ViewFrame {
  Eigen::Vector3d right, up, towards_camera; ///< unit vectors
  Eigen::Vector3d focus;                     ///< point in the picture's middle, mm
  double pixel = 1;                          ///< width of a pixel, mm
  PictureSize size;

  Eigen::Vector2d pixel_of(const Eigen::Vector3d& x) const;
};

/// What a picture leaves free for others than grains: the share of its height at the top, and room for a colour bar.
struct FreeRoom {
  double top = 0.11;
  bool bar = false;
};

/// The largest scale that shows all of `shown` in the rest of the picture. `camera`: azimuth and elevation, degrees.
/// The z axis points up; seen from straight above it points away from the camera's azimuth.
ViewFrame frame_view(const ShownBox& shown, const std::array<double, 2>& camera, const PictureSize& size,
                     const FreeRoom& room);

/// Pixels of the names x, y and z of the box's edges: each outside the middle of an edge at the picture's rim, beyond
/// the triangles that lie in its way. None for an edge that is seen from its end.
std::array<std::optional<Eigen::Vector2d>, 3> axis_names_places(const ViewFrame& view, const ShownBox& box,
                                                                const std::vector<SolidTriangle>& triangles = {});

} // namespace mpfem
