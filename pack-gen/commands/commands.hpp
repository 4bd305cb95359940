#pragma once
// All subcommands of pack-gen, one class each.

#include <memory>

namespace CLI {
class App;
}

namespace mpfem {

class Command;
using MakeCommand = std::unique_ptr<Command>(CLI::App&);

MakeCommand spheres_command, settle_command, mesh_command, import_command, export_command, quality_command,
    hemispheres_command;

} // namespace mpfem
