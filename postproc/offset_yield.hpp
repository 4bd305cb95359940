#pragma once
// Offset yield: where a loading has left a given plastic strain.

#include <optional>
#include <vector>

#include "postproc/measurement.hpp"
#include "postproc/stage_curve.hpp"

namespace mpfem {

/// A loading as one stress against the strain that it works on.
struct LoadingPath {
  std::vector<double> strain; ///< 1, since the stage began
  std::vector<double> stress; ///< MPa, since the stage began
  const char* strain_name = "";
  const char* stress_name = "";
};

/// Axial loadings (unconfined, triaxial, in a die): axial stress, or q, against axial strain. Probes: the way along the
/// path of p and q against the strain that works on it. With (n_p, n_q) the direction from the path's beginning to its
/// end, p de_v + q de_q being the work per volume and e_q = e_a - e_v / 3: stress n_p dp + n_q dq, strain
/// n_p e_v + n_q e_q.
LoadingPath loading_path(const StageCurve& curve);

struct OffsetYieldRule {
  double offset = 0.002;         ///< plastic strain at yield
  std::optional<double> slope{}; ///< MPa, elastic, given by hand (an unload-reload modulus)
};

/// The first row pair at which strain less stress over the elastic slope, counted from where the elastic line meets
/// zero stress (a toe does not count), reaches the offset: the field's 0.2 % proof stress. The slope is that of
/// `modulus` by its default rule on this path, whose damage it does not look at. The value is the axial stress of an
/// unconfined test, else q; p and q in the details. Uncertainty: the change between the two rows and that with the
/// slope's own uncertainty, halved, and the rows' scatter, as hypotenuse. Throws InputError where the offset is not
/// reached.
Measurement offset_yield(const StageCurve& curve, const OffsetYieldRule& rule);

/// Of stage `number` (default: the last probe, unconfined or triaxial compression, else the last stage).
Measurement measure_offset_yield(const schema::FileReader& file, std::optional<int> number,
                                 const OffsetYieldRule& rule);

} // namespace mpfem
