#pragma once
// One program for all x86-64 machines: several builds of it lie side by side, and the plainest starts the best of them.

namespace mpfem {

/// Goes on as the build for the newest instruction set that this processor knows (mpfem-v4: AVX-512, mpfem-v3: AVX2),
/// where it lies beside this executable; comes back where there is none. The environment variable
/// MPFEM_INSTRUCTION_SET = v2, v3 or v4 forbids newer ones. Throws InputError where it has another value.
void hand_over_to_best_build(char** arguments);

} // namespace mpfem
