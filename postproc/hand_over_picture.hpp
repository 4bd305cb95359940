#pragma once
// postproc picture is a separate executable.

namespace mpfem {

/// If the first argument is "picture", replaces this process by the executable postproc-picture next to this one, with
/// the same arguments. Where that is missing, returns for --help and throws SimulationError otherwise. Returns for any
/// other first argument.
void hand_over_picture(int argc, char** argv);

} // namespace mpfem
