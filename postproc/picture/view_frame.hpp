#pragma once
// Parallel projection of space onto a picture.

#include <array>

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

/// The largest scale that shows all of `shown` below the title and, where there is a bar, left of it.
ViewFrame frame_view(const ShownBox& shown, const Eigen::Vector3d& towards_camera, const PictureSize& size,
                     bool with_bar);

/// Pixels of the names x, y and z of the box's edges: each outside the middle of an edge at the picture's rim.
std::array<Eigen::Vector2d, 3> axis_names_places(const ViewFrame& view, const ShownBox& box);

} // namespace mpfem
