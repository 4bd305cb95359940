// postproc-picture: the subcommand `picture` of postproc, which starts this program. It is separate because nothing
// else needs VTK.

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/version.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/picture/picture_command.hpp"

namespace {

int body(int argc, char** argv) {
  CLI::App app("postproc picture: a snapshot in three dimensions");
  app.name("postproc");
  app.set_version_flag("--version", "postproc " + mpfem::version_and_commit());
  app.require_subcommand(1);
  const auto command = mpfem::picture_command(app);
  if (const auto done = mpfem::parse_command_line(app, "postproc", argc, argv)) return *done;
  command->run_if_given();
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("postproc", body, argc, argv);
}
