#include "common/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <stdexcept>

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mpfem {

namespace {

/// Runs in the child: never returns, and does not touch what the parent has yet to write or clean up.
[[noreturn]] void be_child(const std::function<void(const std::function<void(std::string_view)>&)>& body, int pipe) {
  constexpr rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTERM, SIGINT}) std::signal(signal, SIG_DFL);
  try {
    body([pipe](std::string_view text) {
      while (!text.empty()) {
        const ssize_t written = write(pipe, text.data(), text.size());
        if (written < 0 && errno != EINTR) _exit(1);
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
      }
    });
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

/// Reads everything from the pipe until its end. False if that takes longer than `seconds`.
bool read_until_end(int pipe, double seconds, std::string& output) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::array<char, 4096> buffer;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{pipe, POLLIN, 0};
    constexpr long longest_wait = 60'000;
    if (poll(&ready, 1, static_cast<int>(std::min<long>(left, longest_wait))) <= 0) continue;
    const ssize_t count = read(pipe, buffer.data(), buffer.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return true;
    if (count > 0) output.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

} // namespace

ChildEnd run_in_child(const std::function<void(const std::function<void(std::string_view)>&)>& body, double seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("cannot open a pipe to a child process");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]), close(ends[1]);
    throw std::runtime_error("cannot start a child process");
  }
  if (child == 0) {
    close(ends[0]);
    be_child(body, ends[1]);
  }
  close(ends[1]);
  ChildEnd result;
  result.out_of_time = !read_until_end(ends[0], seconds, result.output);
  if (result.out_of_time) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

} // namespace mpfem
