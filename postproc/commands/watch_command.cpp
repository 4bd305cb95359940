// watch: a running simulation in the terminal.

#include <chrono>
#include <cstdio>
#include <thread>

#include <unistd.h>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/terminal_width.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/commands.hpp"
#include "postproc/watch/watch_frame.hpp"

namespace mpfem {

namespace {

/// Time of the system's clock since its epoch (s), as in file times.
double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

class WatchCommand : public Command {
public:
  explicit WatchCommand(CLI::App& app)
      : Command(app, "watch",
                "Show a running simulation in the terminal: stage, density, stress, step, energies, remaining time and "
                "the curve so far,\nfrom the checkpoint that mpfem leaves every output.checkpoint_interval (60 s by "
                "default). It only reads files. It ends with the run, or with Ctrl-C.\n"
                "Example: postproc watch run.h5\nExample: postproc watch run.h5 --once") {
    add_later_input("run", run_, "Run file (HDF5) that mpfem will write: its --output")->required();
    add_number(options(), "--interval", interval_, Range::between(0.1, 86400), "s", "Time between two updates")
        ->capture_default_str();
    options().add_flag("--once", once_, "Print once and exit");
  }

private:
  void execute() const override {
    if (once_) refuse_given({"--interval"}, "together with --once", "one of them");
    RunProgress progress = read_progress(run_);
    show(watch_frame(progress, now(), terminal_width(STDOUT_FILENO)));
    while (!once_ && !progress.ended()) {
      std::this_thread::sleep_for(std::chrono::duration<double>(interval_));
      std::string note;
      try {
        progress = read_progress(run_);
      } catch (const InputError& error) { // keeps the last frame; the next checkpoint may be readable
        note = fmt::format("\n{}\n", error.what());
      }
      show(watch_frame(progress, now(), terminal_width(STDOUT_FILENO)) + note);
    }
  }

  /// In a terminal each frame replaces the one before.
  void show(const std::string& frame) const {
    const bool in_place = !once_ && isatty(STDOUT_FILENO) == 1;
    fmt::print("{}{}", in_place ? "\x1b[H\x1b[J" : "", frame);
    std::fflush(stdout);
    if (std::ferror(stdout) != 0) throw StorageError("standard output could not be written");
  }

  std::string run_;
  double interval_ = 5; ///< s
  bool once_ = false;
};

} // namespace

std::unique_ptr<Command> watch_command(CLI::App& app) {
  return std::make_unique<WatchCommand>(app);
}

} // namespace mpfem
