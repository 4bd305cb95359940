#pragma once
// postproc picture is an executable of its own.

namespace mpfem {

/// Where the first argument is "picture", goes on as the executable that lies next to this one and is called
/// postproc-picture, with the same arguments. Where it is missing, returns for --help and else throws
/// SimulationError. Returns for all other first arguments.
void hand_over_picture(int argc, char** argv);

} // namespace mpfem
