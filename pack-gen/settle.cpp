#include "pack-gen/settle.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/inflated_spheres.hpp"
#include "pack-gen/overlap_minimiser.hpp"

namespace mpfem {

namespace {

double top_of(const SpherePacking& packing) {
  double top = 0;
  for (std::size_t i = 0; i < packing.radius.size(); ++i) top = std::max(top, packing.center[i][2] + packing.radius[i]);
  return top;
}

/// Throws InputError if the container is lower than the bed with a gap above it.
void refuse_low_container(const SpherePacking& packing, double bed_height, double gap) {
  const double needed = bed_height + gap;
  if (packing.surface || packing.box[2] >= needed * (1 - 1e-9)) return;
  throw InputError(fmt::format("found a container that is {:g} mm high, lower than the bed of {} spheres, allowed: at "
                               "least {:.5g} mm for this bed, or --fit-height, which raises it to that height",
                               packing.box[2], packing.radius.size(), needed));
}

} // namespace

SettledPacking settle(const SpherePacking& packing, const SettleRequest& request) {
  const double gap = request.smallest_gap;
  if (packing.surface && request.fit_height)
    throw InputError("found a container that is a surface, whose height is that of its file, allowed: a box or a "
                     "cylinder for a height fitted to the bed");
  InflatedSpheres spheres = inflated_spheres(packing.radius, gap, packing.container());
  std::vector<Point> start = packing.center;
  for (Point& p : start)
    for (double& x : p) x = (x - 0.5 * gap) / spheres.unit;
  spheres.container.open_above = true; // a ceiling would hold down a bed that is higher than the container
  OverlapMinimiser bed(std::move(start), spheres.radius, spheres.container);
  constexpr double at_rest = 1e-4; // share of a weight; more lets spheres balance on one another
  constexpr int most_steps = 200000;
  bool rests = false;
  // A heavy bed settles fast but is soft; as the weight decreases it becomes a bed of hard spheres.
  for (double weight = 1e-3; weight > 1e-8 && !(rests && bed.largest_overlap() <= allowed_overlap); weight *= 0.1) {
    bed.set_weight(weight);
    rests = bed.sink(at_rest, most_steps, [&](double share) {
      if (request.progress)
        request.progress(fmt::format("settling, {:.2g} weights unbalanced (wanted: {:.2g}), overlap {:.2g} mean radii "
                                     "(wanted: {:.2g})",
                                     share, at_rest, bed.largest_overlap(), allowed_overlap));
    });
  }
  SettledPacking result{packing, 0, bed.unbalanced_share()};
  for (std::size_t i = 0; i < packing.center.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) result.packing.center[i][k] = bed.position()[i][k] * spheres.unit + 0.5 * gap;
  result.bed_height = top_of(result.packing);
  if (!packing.surface) result.packing.box[2] = result.bed_height + gap;
  if (!rests || !(smallest_gap(result.packing).gap >= gap * (1 - 1e-9)))
    throw InputError(
        fmt::format("{} spheres do not come to rest with gaps of {:g} mm in this container: {:.2g} of a "
                    "weight is unbalanced and the smallest gap is {:.4g} mm, allowed: smaller gaps or more "
                    "room",
                    packing.radius.size(), gap, result.unbalanced, smallest_gap(result.packing).gap));
  if (request.fit_height) return result;
  refuse_low_container(packing, result.bed_height, gap);
  result.packing.box = packing.box;
  return result;
}

} // namespace mpfem
