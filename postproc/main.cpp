// postproc: numbers, tables and pictures from run files.

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/version.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/figure/figure_commands.hpp"
#include "postproc/hand_over_picture.hpp"
#include "postproc/picture/picture_command.hpp"

namespace {

using namespace mpfem;

constexpr const char* help =
    "postproc: numbers, tables and pictures from the runs of mpfem.\n"
    "Examples:\n"
    "  postproc summary run.h5 -o summary.json\n"
    "  postproc curve run.h5 --columns relative_density,mean_stress -o curve.csv\n"
    "  postproc section run.h5 --snapshot -1 --axis z --position 0.5 --relative --field von_mises -o section.png\n"
    "  postproc section run.h5 --field damage -o damage.png\n"
    "  postproc picture run.h5 --color von-mises -o run.png      (in three dimensions, cut open)\n"
    "  postproc view run.h5 -o view.html                         (a page with the grains in three dimensions)\n"
    "  postproc watch run.h5                                     (a run in progress, in the terminal)\n"
    "  postproc contact run.h5 --pair 3,17 --view contact.png\n"
    "  postproc elastic-recovery run.h5 -o recovery.json   (and modulus, strength, yield, hysteresis, energy)\n"
    "  postproc damage run.h5 --snapshot -1 -o damage.json\n"
    "  postproc tablet run.h5 -o tablet.json               (and heckel, diametral)\n"
    "  postproc fit points.csv --x relative_density --y strength --model exponential -o fits.json\n"
    "  postproc vtk run.h5 -o vtk        (open vtk/run.pvd in ParaView)\n"
    "  postproc validate run.h5\n"
    "  postproc table, fits, plot, verdict, report: for a figure or study declared in one file (docs/figure-file.md)\n"
    "Exit codes: 0 done, 2 bad usage or input, 3 a picture could not be drawn, 4 storage failed.";

/// In the order of the help text, before and after the subcommands of figures.
constexpr MakeCommand* before_figures[] = {summary_command,
                                           curve_command,
                                           contact_command,
                                           vtk_command,
                                           section_command,
                                           density_map_command,
                                           view_command,
                                           watch_command,
                                           elastic_recovery_command,
                                           modulus_command,
                                           strength_command,
                                           yield_command,
                                           hysteresis_command,
                                           damage_command,
                                           quasi_static_command,
                                           stress_path_command,
                                           triaxial_command,
                                           section_stress_command,
                                           section_damage_command,
                                           stress_at_densities_command,
                                           compaction_quality_command,
                                           energy_command,
                                           fit_command,
                                           unload_reload_modulus_command,
                                           offset_yield_command,
                                           coordination_command,
                                           inner_stress_command,
                                           damage_of_test_command,
                                           damage_band_command,
                                           tablet_command,
                                           heckel_command,
                                           diametral_command};
constexpr MakeCommand* after_figures[] = {validate_command, cost_command};

/// The subcommand `picture` for --help alone: if it is to draw, hand_over_picture() does not return.
std::unique_ptr<Command> add_picture_help(CLI::App& app) {
  auto command = picture_command(app);
  CLI::App* picture = app.get_subcommand("picture");
  picture->description(picture->get_description() +
                       "\nNeeds the executable postproc-picture, which ./bootstrap pictures builds in the sources.");
  return command;
}

/// The subcommands that measure and draw, in `app`.
std::vector<std::unique_ptr<Command>> commands_before_figures(CLI::App& app) {
  std::vector<std::unique_ptr<Command>> commands;
  for (MakeCommand* make : before_figures) commands.push_back(make(app));
  commands.push_back(add_picture_help(app));
  return commands;
}

/// Refuses words with which a figure's rules cannot call this program. A program of its own parses them, because the
/// other one is at work.
void check_words_of_figure(const std::vector<std::string>& words) {
  CLI::App app;
  app.require_subcommand(1);
  const auto commands = commands_before_figures(app);
  check_words(app, "postproc", words);
}

int body(int argc, char** argv) {
  hand_over_picture(argc, argv);
  CLI::App app(help);
  app.set_version_flag("--version", "postproc " + version_and_commit());
  app.require_subcommand(1);
  auto commands = commands_before_figures(app);
  const FigureCommands figures(app, check_words_of_figure);
  for (MakeCommand* make : after_figures) commands.push_back(make(app));

  if (const auto done = parse_command_line(app, "postproc", argc, argv)) return *done;
  for (const auto& command : commands) command->run_if_given();
  figures.run();
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return mpfem::run_program("postproc", body, argc, argv);
}
