#pragma once
// Tensile strength of a disc by diametral compression (Brazilian test) between two plates.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "postproc/measurement.hpp"
#include "postproc/stages.hpp"

namespace mpfem {

/// Stress (MPa) across the loaded diameter in the centre of a disc under two line loads: 2 F / (pi D t) (Hertz 1883;
/// Carneiro and Barcellos 1953; Fell and Newton, J. Pharm. Sci. 59, 688, 1970). N, mm.
double diametral_stress(double force, double diameter, double thickness);

/// Factor on that stress where each load is spread over an arc of the half angle alpha (rad): sin(2 alpha)/alpha - 1
/// (Hondros, Aust. J. Appl. Sci. 10, 243, 1959). 1 for a line load; 0.910 at 2 alpha = 30 degrees, beyond which the
/// disc no longer breaks from its centre.
double flat_correction(double half_angle);
inline constexpr double largest_flat_angle = 30; ///< degrees, 2 alpha

/// N, the load on a disc in each row from the forces of both plates on one axis: their mean. It is 0 until each plate
/// bears a tenth of the largest mean: before, one of them pushes the disc against the other.
std::vector<double> disc_force(std::span<const double> a, std::span<const double> b);

/// The largest value before the first fall by a share of it, of values that were smoothed before. Falls of values below
/// a tenth of the largest of all do not count: there a disc seats.
struct FirstPeak {
  std::size_t row = 0;
  bool falls = false; ///< else: the largest value of all, after which nothing fell so far
};
FirstPeak first_peak(const std::vector<double>& values, double drop);

/// Nodes of one state that are pressed (contact pressure > 0) near one end of the loaded diameter: half of the angle
/// under which the flat is seen from the axis, asin of half of its width over the disc's radius.
struct DiscState {
  std::span<const float> node;             ///< [nodes * 3], mm
  std::span<const float> contact_pressure; ///< [nodes], MPa
  int load_axis = 0, disc_axis = 2;        ///< 0, 1, 2 for x, y, z
  double diameter = 0;                     ///< mm
  double face_distance = 0;                ///< mm, of pressed nodes from the outermost node
};
/// Of the wider of both flats, rad; nothing where an end has no pressed node.
std::optional<double> flat_half_angle(const DiscState& state);

struct DiametralRule {
  std::vector<std::string> plates;           ///< two tools; without them the run's only two
  std::optional<int> stage;                  ///< without it the last
  double drop = 0.1;                         ///< share of the largest force by which it falls after a peak
  int disc_axis = 2;                         ///< 0, 1, 2 for x, y, z
  std::optional<double> diameter, thickness; ///< mm; without them the nodes' extents before the test
  std::optional<double> flat_angle;          ///< degrees, 2 alpha; without it that of the snapshot at the peak
  std::optional<double> face_distance;       ///< mm; without it a hundredth of the diameter
};

/// The value is 2 F / (pi D t), F the peak of the mean force of both plates along the axis on which they approach.
/// Throws InputError: no two plates, no force, no snapshot for what is not given, flats wider than 30 degrees.
Measurement measure_diametral(const schema::FileReader& file, const DiametralRule& rule);

} // namespace mpfem
