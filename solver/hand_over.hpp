#pragma once
// One program for all x86-64 machines: several builds lie side by side, and the most basic one starts the best.

namespace mpfem {

/// Continues as the build for the newest instruction set of this processor (mpfem-v4: AVX-512, mpfem-v3: AVX2) that
/// lies beside this executable; returns if there is none. The environment variable MPFEM_INSTRUCTION_SET = v2, v3 or v4
/// forbids newer sets. Throws InputError if it has another value.
void hand_over_to_best_build(char** arguments);

} // namespace mpfem
