#include "solver/run/interrupt.hpp"

#include <csignal>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "solver/parallel/root.hpp"

namespace mpfem {

namespace {

/// Signals that follow each other within this time (s) are one request: batch systems send several at a time limit.
constexpr std::time_t one_request = 5;

volatile std::sig_atomic_t requested = 0;
volatile std::sig_atomic_t requested_at = 0; // s

extern "C" void request_interrupt(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (requested == 0) {
    requested_at = static_cast<std::sig_atomic_t>(now.tv_sec);
    requested = 1;
  } else if (now.tv_sec - requested_at > one_request) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

} // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = request_interrupt;
  action.sa_flags = SA_RESTART; // reading a packing goes on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction at_hangup {};
  sigaction(SIGHUP, nullptr, &at_hangup);
  if (at_hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr); // nohup wants it ignored
  sigaction(SIGUSR1, &action, nullptr); // mpirun passes it on, and then does not end the ranks as it does at SIGTERM
}

bool interrupt_requested() {
  return requested != 0;
}

void stop_before_first_step(const Communicator& ranks, const std::string& checkpoint) {
  if (ranks.largest(interrupt_requested() ? 1 : 0) == 0) return;
  if (root_finds(ranks, [&] { return std::filesystem::exists(checkpoint); }))
    throw Interrupted(fmt::format("interrupted before the first step; {} is unchanged; continue with --resume",
                                  one_line(checkpoint)));
  throw Interrupted("interrupted before the first step; nothing to resume");
}

} // namespace mpfem
