#pragma once
// A temporary folder of a test, and commands run as a user would.

#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mpfem::test {

/// A separate folder for every test, removed at its end.
class Folder {
public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "mpfem-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
  std::filesystem::path path_;
};

/// What a command returned and printed.
struct Outcome {
  int exit_code = -1;
  std::string messages; ///< standard error
  std::string output;   ///< standard output
  double seconds = 0;   ///< wall-clock time

  /// Whether every line is a warning.
  bool only_warnings(const std::string& program) const {
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with(program + ": warning: ")) return false;
    return true;
  }
  /// Exactly one line, which begins as every error does.
  bool one_error_line(const std::string& program) const {
    return messages.starts_with(program + ": error: ") && messages.find('\n') == messages.size() - 1;
  }
};

/// The whole file; empty if it cannot be opened.
inline std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Writes a file, and creates its folder if it does not exist.
inline void write_text(const std::string& path, const std::string& text) {
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  std::ofstream(path, std::ios::binary) << text;
}

/// Runs a shell command; standard error and output are kept apart.
inline Outcome run_command(const std::string& command) {
  const Folder scratch;
  const auto start = std::chrono::steady_clock::now();
  const int status =
      std::system(("( " + command + " ) >'" + (scratch / "out") + "' 2>'" + (scratch / "err") + "'").c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.messages = read_text(scratch / "err");
  outcome.output = read_text(scratch / "out");
  return outcome;
}

} // namespace mpfem::test
