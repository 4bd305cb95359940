#pragma once
// postproc picture: a snapshot in three dimensions.

#include <memory>

namespace CLI {
class App;
}

namespace mpfem {

class Command;
/// Adds the subcommand to the program.
std::unique_ptr<Command> picture_command(CLI::App& app);

} // namespace mpfem
