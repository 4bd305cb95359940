#pragma once
// What the command line says of a run, besides its scenario.

#include <optional>
#include <string>

namespace mpfem {

/// When grains change their owners while several ranks run (redistribution.hpp).
enum class Redistribute {
  when_it_pays, ///< by the measured work of the ranks
  never,
  always ///< all of them at every checkpoint in between: a trial that results do not depend on owners
};

/// Options of `mpfem run`.
struct RunOptions {
  std::string output;              ///< RUN.h5
  std::string scenario_file;       ///< never to be overwritten
  bool resume = false;             ///< go on from the rolling checkpoint if there is one
  bool redistributed = false;      ///< with `resume`: only the owners of grains have changed; nobody has resumed it
  bool keeps_earlier_run = false;  ///< that is there when it begins afresh (earlier_run.hpp); not with --resume
  std::optional<std::string> from; ///< begin the first stage from this checkpoint's state
  int threads = 1;
  bool quiet = false;
  Redistribute redistribute = Redistribute::when_it_pays;
  double time_limit = 0; ///< s of wall-clock time from the first step on, 0 none
};

} // namespace mpfem
