#pragma once
// One of the programs, run with little memory and little time, as a user would run it on a file that is not what it
// seems.

#include <string>
#include <vector>

namespace mpfem::test {

struct LimitedOutcome {
  int exit_code = -1;   ///< -1: ended by a signal
  bool in_time = true;  ///< it ended by itself
  std::string messages; ///< standard error
};

/// Runs a program without a shell. Address space 1 GiB (without sanitizers), 5 s of processor time, 60 s in all.
LimitedOutcome run_limited(const std::string& program, const std::vector<std::string>& arguments);

/// Checks that a program refuses an input as every program does: exit code 2, in time, one line "PROGRAM: error: …"
/// of at most 400 characters that has `names` in it. Gives an empty text, or what was wrong.
std::string fault_of_refusal(const std::string& program, const std::vector<std::string>& arguments,
                             const std::vector<std::string>& names);

/// The same for a message that a reader has thrown.
std::string fault_of_message(const std::string& message, const std::vector<std::string>& names);

} // namespace mpfem::test
