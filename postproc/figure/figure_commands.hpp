#pragma once
// The subcommands that work on a figure's file: depends, table, fits, plot, verdict and report.

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace mpfem {

/// Adds them to the program; after parsing, run() executes the one that was given.
class FigureCommands {
public:
  /// `check_words` throws InputError for words of a metric or a picture that postproc refuses.
  FigureCommands(CLI::App& app, std::function<void(const std::vector<std::string>&)> check_words);
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
