#pragma once
// The subcommands that work on a figure's file: depends, table, fits, plot, verdict and report.

#include <memory>

namespace CLI {
class App;
}

namespace mpfem {

/// Adds them to the program; after parsing, run() executes the one that was given.
class FigureCommands {
public:
  explicit FigureCommands(CLI::App& app);
  ~FigureCommands();
  FigureCommands(const FigureCommands&) = delete;
  FigureCommands& operator=(const FigureCommands&) = delete;

  /// Does nothing if none of them was given. Throws InputError, SimulationError (gnuplot), StorageError.
  void run() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace mpfem
