#include "limited_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace mpfem::test {

namespace {

constexpr rlim_t most_memory = rlim_t{1} << 30U; // bytes
constexpr rlim_t most_processor_time = 5;        // s
constexpr auto most_time = std::chrono::seconds(60);
constexpr std::size_t longest_message = 400; // characters
constexpr std::size_t most_kept = 100'000;   // bytes of standard error

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true; // its shadow memory needs an address space without limit
#else
constexpr bool sanitized = false;
#endif

template <class Resource>
void limit(Resource resource, rlim_t most) {
  const rlimit both{most, most + 1}; // a signal as a warning first, then the end
  setrlimit(resource, &both);
}

[[noreturn]] void become(const std::string& program, std::vector<char*>& words, int errors) {
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  if (!sanitized) limit(RLIMIT_AS, most_memory);
  if (!sanitized) limit(RLIMIT_CPU, most_processor_time);
  limit(RLIMIT_CORE, 0);
  execv(program.c_str(), words.data());
  _exit(127);
}

/// What comes through a pipe until it closes, or until the time is over.
bool collect(int pipe_end, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + most_time;
  std::array<char, 4096> piece{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd waiting{pipe_end, POLLIN, 0};
    if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) <= 0) return false;
    const ssize_t size = read(pipe_end, piece.data(), piece.size());
    if (size <= 0) return true;
    if (text.size() < most_kept) text.append(piece.data(), static_cast<std::size_t>(size));
  }
}

std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

LimitedOutcome run_limited(const std::string& program, const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) become(program, pointers, ends[1]);
  close(ends[1]);
  LimitedOutcome outcome;
  outcome.in_time = collect(ends[0], outcome.messages);
  close(ends[0]);
  if (!outcome.in_time) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) outcome.in_time = false;
  return outcome;
}

std::string fault_of_message(const std::string& message, const std::vector<std::string>& names) {
  if (message.find('\n') != std::string::npos) return "more than one line: " + message.substr(0, 1000);
  if (characters(message) > longest_message) return fmt::format("a line of {} characters", characters(message));
  for (const std::string& name : names)
    if (message.find(name) == std::string::npos) return fmt::format("'{}' is not in: {}", name, message);
  return {};
}

std::string fault_of_refusal(const std::string& program, const std::vector<std::string>& arguments,
                             const std::vector<std::string>& names) {
  const LimitedOutcome outcome = run_limited(program, arguments);
  const std::string begins = std::filesystem::path(program).filename().string() + ": error: ";
  if (!outcome.in_time) return "not done in time";
  if (outcome.exit_code != 2) return fmt::format("exit code {}: {}", outcome.exit_code, outcome.messages);
  if (!outcome.messages.starts_with(begins)) return "begins otherwise: " + outcome.messages.substr(0, 1000);
  if (!outcome.messages.ends_with('\n')) return "no whole line: " + outcome.messages.substr(0, 1000);
  return fault_of_message(outcome.messages.substr(0, outcome.messages.size() - 1), names);
}

} // namespace mpfem::test
