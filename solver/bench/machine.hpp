#pragma once
// What this machine can do at best, measured: memory traffic and arithmetic.

#include "solver/kernels/thread_team.hpp"

namespace mpfem {

/// GB/s of a(i) = b(i) + s c(i) on arrays larger than any cache; best of several, counting 24 bytes an i. Linux places
/// pages near the thread that first writes them, so each thread fills its own part.
double measure_triad(ThreadTeam& team);

/// GFlop/s of independent fused multiply-adds on packs of doubles; a fused multiply-add counts two.
double measure_fma(ThreadTeam& team);

} // namespace mpfem
