#include "postproc/picture/view_frame.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace mpfem {

namespace {

// Shares of the picture that are left free.
constexpr double other_margin = 0.055, bar_margin = 0.19;

Eigen::Vector3d corner(const ShownBox& box, int number) {
  return {(number & 1) ? box.high[0] : box.low[0], (number & 2) ? box.high[1] : box.low[1],
          (number & 4) ? box.high[2] : box.low[2]};
}

} // namespace

Eigen::Vector2d ViewFrame::pixel_of(const Eigen::Vector3d& x) const {
  return {0.5 * size.width + right.dot(x - focus) / pixel, 0.5 * size.height + up.dot(x - focus) / pixel};
}

ViewFrame frame_view(const ShownBox& shown, const std::array<double, 2>& camera, const PictureSize& size,
                     const FreeRoom& room) {
  ViewFrame view;
  view.size = size;
  view.towards_camera = towards_camera(camera);
  // From the azimuth alone, which a camera straight above has, too. Beyond 90 degrees it looks from the other side.
  const double azimuth = camera[0] * M_PI / 180, side = std::cos(camera[1] * M_PI / 180) < -1e-9 ? -1 : 1;
  view.right = side * Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
  view.up = view.towards_camera.cross(view.right);
  const Eigen::Vector3d middle = 0.5 * (shown.low + shown.high);
  Eigen::Vector2d half = Eigen::Vector2d::Zero();
  for (int c = 0; c < 8; ++c) {
    const Eigen::Vector3d x = corner(shown, c) - middle;
    half = half.cwiseMax(Eigen::Vector2d(view.right.dot(x), view.up.dot(x)));
  }
  const double right_margin = room.bar ? bar_margin : other_margin;
  view.pixel = std::max(2 * half[0] / (size.width * (1 - other_margin - right_margin)),
                        2 * half[1] / (size.height * (1 - other_margin - room.top)));
  view.focus = middle + view.pixel * (0.5 * (right_margin - other_margin) * size.width * view.right +
                                      0.5 * (room.top - other_margin) * size.height * view.up);
  return view;
}

namespace {

/// A point of the picture and a direction in it.
struct Ray {
  Eigen::Vector2d from, along;
};

/// How far along the ray triangles reach that come closer to it than `width`.
double reach(const Ray& ray, const ViewFrame& view, const std::vector<SolidTriangle>& triangles, double width) {
  const Eigen::Vector2d across(-ray.along[1], ray.along[0]);
  double furthest = 0;
  for (const SolidTriangle& t : triangles) {
    double nearest_left = 1e300, nearest_right = -1e300, end = 0;
    for (const SolidVertex& vertex : t.corner) {
      const Eigen::Vector2d place = view.pixel_of(vertex.position) - ray.from;
      nearest_left = std::min(nearest_left, across.dot(place));
      nearest_right = std::max(nearest_right, across.dot(place));
      end = std::max(end, ray.along.dot(place));
    }
    if (nearest_left < width && nearest_right > -width) furthest = std::max(furthest, end);
  }
  return furthest;
}

/// Of the four edges of the box along this axis the outermost, by its middle: the lowest one for x and y, the leftmost
/// one for z.
Eigen::Vector2d outermost_edge(const ViewFrame& view, const ShownBox& box, int axis) {
  const Eigen::Vector3d middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const Eigen::Vector2d wanted = axis == 2 ? Eigen::Vector2d(-1, 0) : Eigen::Vector2d(0, -1);
  Eigen::Vector2d outermost = view.pixel_of(middle);
  double furthest = -1e300;
  for (int c = 0; c < 4; ++c) {
    Eigen::Vector3d x = middle;
    x[(axis + 1) % 3] += (c & 1 ? 1 : -1) * half[(axis + 1) % 3];
    x[(axis + 2) % 3] += (c & 2 ? 1 : -1) * half[(axis + 2) % 3];
    const Eigen::Vector2d place = view.pixel_of(x);
    if (wanted.dot(place) <= furthest) continue;
    furthest = wanted.dot(place);
    outermost = place;
  }
  return outermost;
}

} // namespace

std::array<std::optional<Eigen::Vector2d>, 3> axis_names_places(const ViewFrame& view, const ShownBox& box,
                                                                const std::vector<SolidTriangle>& triangles) {
  const double letter = 0.024 * view.size.height;
  const Eigen::Vector2d centre = view.pixel_of(0.5 * (box.low + box.high));
  std::array<std::optional<Eigen::Vector2d>, 3> places;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d edge = (box.high - box.low).cwiseProduct(Eigen::Vector3d::Unit(axis));
    if ((view.pixel_of(edge) - view.pixel_of({0, 0, 0})).norm() < 3 * letter) continue;
    const Eigen::Vector2d middle = outermost_edge(view, box, axis), outward = (middle - centre).normalized();
    Eigen::Vector2d place = middle + (letter + reach({middle, outward}, view, triangles, 0.6 * letter)) * outward;
    place = place.cwiseMax(Eigen::Vector2d::Constant(0.7 * letter));
    places[static_cast<std::size_t>(axis)] =
        place.cwiseMin(Eigen::Vector2d(view.size.width - 0.7 * letter, view.size.height - 0.7 * letter));
  }
  return places;
}

} // namespace mpfem
