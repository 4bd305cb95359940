#include "postproc/picture/view_frame.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace mpfem {

namespace {

// Shares of the picture that are left free.
constexpr double top_margin = 0.11, other_margin = 0.055, bar_margin = 0.19;

Eigen::Vector3d corner(const ShownBox& box, int number) {
  return {(number & 1) ? box.high[0] : box.low[0], (number & 2) ? box.high[1] : box.low[1],
          (number & 4) ? box.high[2] : box.low[2]};
}

} // namespace

Eigen::Vector2d ViewFrame::pixel_of(const Eigen::Vector3d& x) const {
  return {0.5 * size.width + right.dot(x - focus) / pixel, 0.5 * size.height + up.dot(x - focus) / pixel};
}

ViewFrame frame_view(const ShownBox& shown, const Eigen::Vector3d& towards_camera, const PictureSize& size,
                     bool with_bar) {
  ViewFrame view;
  view.size = size;
  view.towards_camera = towards_camera;
  // Seen from straight above or below, y points up.
  const Eigen::Vector3d upward =
      std::abs(towards_camera[2]) > 0.999 ? Eigen::Vector3d::Unit(1) : Eigen::Vector3d::Unit(2);
  view.right = upward.cross(towards_camera).normalized();
  view.up = towards_camera.cross(view.right);
  const Eigen::Vector3d middle = 0.5 * (shown.low + shown.high);
  Eigen::Vector2d half = Eigen::Vector2d::Zero();
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3d x = corner(shown, c) - middle;
    half = half.cwiseMax(Eigen::Vector2d(view.right.dot(x), view.up.dot(x)));
  }
  const double right_margin = with_bar ? bar_margin : other_margin;
  view.pixel = std::max(2 * half[0] / (size.width * (1 - other_margin - right_margin)),
                        2 * half[1] / (size.height * (1 - other_margin - top_margin)));
  view.focus = middle + view.pixel * (0.5 * (right_margin - other_margin) * size.width * view.right +
                                      0.5 * (top_margin - other_margin) * size.height * view.up);
  return view;
}

std::array<Eigen::Vector2d, 3> axis_names_places(const ViewFrame& view, const ShownBox& box) {
  const Eigen::Vector3d middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const Eigen::Vector2d centre = view.pixel_of(middle);
  std::array<Eigen::Vector2d, 3> places;
  for (int axis = 0; axis < 3; ++axis) {
    // The outermost of the four edges along this axis: the lowest one for x and y, the leftmost one for z.
    const Eigen::Vector2d wanted = axis == 2 ? Eigen::Vector2d(-1, 0) : Eigen::Vector2d(0, -1);
    double furthest = -1e300;
    for (int c = 0; c < 4; ++c) {
      Eigen::Vector3d x = middle;
      x[(axis + 1) % 3] += (c & 1 ? 1 : -1) * half[(axis + 1) % 3];
      x[(axis + 2) % 3] += (c & 2 ? 1 : -1) * half[(axis + 2) % 3];
      const Eigen::Vector2d place = view.pixel_of(x);
      if (wanted.dot(place - centre) <= furthest) continue;
      furthest = wanted.dot(place - centre);
      places[static_cast<std::size_t>(axis)] = place + 0.024 * view.size.height * (place - centre).normalized();
    }
  }
  return places;
}

} // namespace mpfem
