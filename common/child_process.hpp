#pragma once
// Work in a separate process: what crashes there does not end the program.

#include <functional>
#include <string>
#include <string_view>

namespace mpfem {

/// How the child ended, and what it had written.
struct ChildEnd {
  std::string output;
  int exit_code = 0; ///< of a child that ended by itself
  int signal = 0;    ///< that ended it; 0: none
  bool out_of_time = false;
};

/// Runs `body(write)` in a child process and waits for its end; write(text) appends to the result. After `seconds` the
/// child is killed. An exception that leaves `body` ends the child with exit code 1. Must not be called while other
/// threads of this process hold locks that `body` needs. Throws std::runtime_error if no process can be started.
ChildEnd run_in_child(const std::function<void(const std::function<void(std::string_view)>& write)>& body,
                      double seconds);

} // namespace mpfem
