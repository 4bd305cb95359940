#pragma once
// The subcommands that read one number off a run, and the one that fits points.

#include <memory>

namespace CLI {
class App;
}

namespace mpfem {

/// Adds them to the program; after parsing, run() does the one that was given.
class MetricCommands {
public:
  explicit MetricCommands(CLI::App& app);
  ~MetricCommands();
  MetricCommands(const MetricCommands&) = delete;
  MetricCommands& operator=(const MetricCommands&) = delete;

  /// Does nothing where none of them was given. Throws InputError, StorageError.
  void run() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace mpfem
