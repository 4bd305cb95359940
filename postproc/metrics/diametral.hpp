#pragma once
// Tensile strength of a disc by diametral compression (Brazilian test) between two plates.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

/// Tensile stress (MPa) across the loaded diameter at the centre of a disc under two line loads: 2 F / (pi D t) (Hertz
/// 1883; Carneiro and Barcellos 1953; Fell and Newton, J. Pharm. Sci. 59, 688, 1970). Force in N, lengths in mm.
double diametral_stress(double force, double diameter, double thickness);

/// Factor on that stress where each load is spread over an arc of half angle alpha (rad): sin(2 alpha)/alpha - 1
/// (Hondros, Aust. J. Appl. Sci. 10, 243, 1959). 1 for a line load; 0.910 at 2 alpha = 30 degrees, beyond which the
/// disc no longer breaks from its centre.
double flat_correction(double half_angle);
/// Largest angle of a flat at which the disc still breaks from its centre.
inline constexpr double largest_flat_angle = 30; ///< degrees, 2 alpha

/// Load on a disc in each row (N) from the forces of both plates on one axis: the mean of their magnitudes. It is 0
/// until each plate carries a tenth of the largest mean: before that, one plate pushes the disc towards the other.
std::vector<double> disc_force(std::span<const double> a, std::span<const double> b);

/// The largest of the (smoothed) values before they first fall by a share `drop` of it. Falls from values below a tenth
/// of the largest of all, or below `smallest`, do not count: there the disc seats.
struct FirstPeak {
  std::size_t row = 0;
  bool falls = false; ///< false: the largest of all values, no such fall after it
};
/// Finds that peak among the values of a stage, one per row. Only rows for which `counts` is true can have fallen.
FirstPeak first_peak(
    const std::vector<double>& values, double drop, double smallest = 0,
    const std::function<bool(std::size_t row)>& counts = [](std::size_t) { return true; });

/// One state of the disc, for flat_half_angle.
struct DiscState {
  std::span<const float> node;             ///< [nodes * 3], mm
  std::span<const float> contact_pressure; ///< [nodes], MPa
  int load_axis = 0, disc_axis = 2;        ///< 0, 1, 2 for x, y, z
  double diameter = 0;                     ///< mm
  double face_distance = 0;                ///< mm, pressed nodes of a flat lie no farther from the outermost node
};
/// Half angle (rad) of the wider of both flats, as seen from the disc's axis: asin of half the flat's width over the
/// disc's radius. The width is the extent, across the load, of the pressed nodes (contact pressure > 0) at one end of
/// the loaded diameter. Empty where an end has no pressed node.
std::optional<double> flat_half_angle(const DiscState& state);

/// Thickness (mm) of a disc: the median of its local thickness over the face. Local is the distance of the outermost
/// nodes in a column along the disc's axis, a twelfth of the diameter wide, within 0.8 radii of the axis. A grain that
/// sticks out of a face, or has come off, changes few columns and so hardly the median; between the outermost nodes of
/// the whole disc it would count in full. 0 without nodes there.
double disc_thickness(std::span<const float> node, int load_axis, int disc_axis, double diameter);

/// How a diametral test is read.
struct DiametralRule {
  std::vector<std::string> plates; ///< two tools; default: the only two of the run
  std::optional<int> stage;        ///< default: the last
  double drop = 0.1;               ///< share of the peak force by which the force must fall after it
  double smallest_peak = 0;        ///< N, smaller peaks do not count
  /// Falls of the force count only with a crack through the centre: when this share of the bonds there, by area, has
  /// broken (DiscCrack::of_centre). 0: all count.
  double crack_in_centre = 0;
  int disc_axis = 2;                         ///< 0, 1, 2 for x, y, z
  std::optional<double> diameter, thickness; ///< mm; default: extent along the load and disc_thickness before the test
  std::optional<double> flat_angle;          ///< degrees, 2 alpha; default: from the snapshot nearest to the peak
  std::optional<double> face_distance;       ///< mm; default: a hundredth of the diameter
};

/// The value is 2 F / (pi D t) (MPa), F the peak of the mean force of both plates along the axis on which they
/// approach. It is NaN where `crack_in_centre` is given and no fall of the force counts, or flats are wider than 30
/// degrees. Throws InputError: no two plates, plates that do not move across the disc's axis, too few rows, no force of
/// `smallest_peak`, no snapshot before the test for a missing diameter or thickness, wider flats without
/// `crack_in_centre`, `crack_in_centre` without bonds or snapshots of the stage.
Measurement measure_diametral(const schema::FileReader& file, const HistoryTable& history, const DiametralRule& rule);

/// CSV: where bonds have broken up to each snapshot of the stage (disc_crack.hpp), with the force on the disc. Throws
/// InputError as measure_diametral() where there is no test or no diameter.
std::string disc_crack_csv(const schema::FileReader& file, const HistoryTable& history, const DiametralRule& rule);

} // namespace mpfem
