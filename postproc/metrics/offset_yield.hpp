#pragma once
// Offset yield: the stress at which a loading reaches a given plastic strain.

#include <optional>
#include <vector>

#include "postproc/run_data/measurement.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

/// A loading as one stress against its work-conjugate strain.
struct LoadingPath {
  std::vector<double> strain; ///< 1, since the stage began
  std::vector<double> stress; ///< MPa, since the stage began
  const char* strain_name = "";
  const char* stress_name = "";
};

/// For axial loadings (unconfined, triaxial, in a die): axial stress (unconfined) or q against axial strain. For
/// probes, and stages of unknown type that are not unconfined: the stress along the path of p and q against its
/// work-conjugate strain. With (n_p, n_q) the direction from the path's beginning to its end, p de_v + q de_q the work
/// per volume, and e_q = e_a - e_v / 3: stress n_p dp + n_q dq, strain n_p e_v + n_q e_q. Throws InputError where a
/// probe ends where it begins.
LoadingPath loading_path(const StageCurve& curve);

/// What counts as yield.
struct OffsetYieldRule {
  double offset = 0.002;         ///< plastic strain at yield
  std::optional<double> slope{}; ///< MPa, elastic slope given by hand (an unload-reload modulus)
};

/// Interpolated between the first two rows between which the plastic strain reaches the offset (0.2 % proof stress):
/// strain minus stress over the elastic slope, counted from where the elastic line meets zero stress, so that a toe
/// does not count. The slope is that of `modulus` by its default rule on this path, without its limit on damage. The
/// value is the axial stress (MPa) of an unconfined test, otherwise q; p and q are in the details. Uncertainty, in
/// quadrature: half of the change between the two rows, the change with the slope's own uncertainty, and the rows'
/// scatter. Throws InputError where the offset is not reached.
Measurement offset_yield(const StageCurve& curve, const OffsetYieldRule& rule);

/// offset_yield of stage `number` (default: the last probe, unconfined or triaxial compression, otherwise the last
/// stage). Throws InputError.
Measurement measure_offset_yield(const schema::FileReader& file, std::optional<int> number,
                                 const OffsetYieldRule& rule);

} // namespace mpfem
