#pragma once
// Exit codes and the exceptions that lead to them: one convention for the three executables.

#include <stdexcept>
#include <string>

namespace mpfem {

/// Exit codes shared by pack-gen, mpfem and postproc.
enum class ExitCode : int {
  done = 0,
  bad_input = 2,         ///< bad usage, or input that cannot be used
  simulation_failed = 3, ///< the computation failed; its state was saved
  storage_failed = 4,    ///< a file could not be written; the last checkpoint is intact
  interrupted = 5,       ///< interrupted or out of time; resumable
};

/// Input that cannot be used. The message is one line: file, key or line, what was found, what is allowed.
class InputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The simulation cannot continue (inverted element, values not finite, unreachable target…).
class SimulationError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A file could not be written or read back because of the storage, not because of its content.
class StorageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The run was interrupted by a signal or by its time limit; it can be resumed.
class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A failure as a program reports it.
struct Failure {
  std::string message;
  ExitCode code;
};

/// What the exception that is being handled means. Any other std::exception counts as simulation_failed.
Failure present_failure();

/// Prints one line "PROGRAM: error: MESSAGE" on standard error and returns the exit code.
int report(const char* program, const Failure& failure);

/// Runs `body`, prints one line "PROGRAM: error: MESSAGE" on standard error for any exception, and returns the exit
/// code that belongs to it.
int run_program(const char* program, int (*body)(int argc, char** argv), int argc, char** argv);

} // namespace mpfem
