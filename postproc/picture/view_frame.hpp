#pragma once
// Where things of space come to lie in a picture: a parallel projection.

#include <array>

#include <Eigen/Core>

#include "postproc/picture/picture_scene.hpp"

namespace mpfem {

struct PictureSize {
  int width = 1200, height = 1000; ///< pixels
};

/// Pixels count from the picture's lower left corner.
struct ViewFrame {
  Eigen::Vector3d right, up, towards_camera; ///< unit vectors
  Eigen::Vector3d focus;                     ///< what the picture's middle shows, mm
  double pixel = 1;                          ///< mm that a pixel is wide
  PictureSize size;

  Eigen::Vector2d pixel_of(const Eigen::Vector3d& x) const;
};

/// The largest scale that shows all of `shown` below the title and, where there is a bar, left of it.
ViewFrame frame_view(const ShownBox& shown, const Eigen::Vector3d& towards_camera, const PictureSize& size,
                     bool with_bar);

/// Where the names of the box's edges x, y and z stand: outside the middle of an edge at the picture's rim.
std::array<Eigen::Vector2d, 3> axis_names_places(const ViewFrame& view, const ShownBox& box);

} // namespace mpfem
