#pragma once
// gnuplot as a child process, and what it reads and writes.

#include <string>

namespace mpfem {

/// A file in the temporary folder that goes away with the object.
class ScratchFile {
public:
  /// Throws StorageError.
  explicit ScratchFile(const std::string& content);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::string& path() const { return path_; }
  /// All that stands in it now.
  std::string content() const;

private:
  std::string path_;
};

/// The text as a gnuplot string. In single quotes, since gnuplot would run `commands` inside double ones.
std::string gnuplot_string(const std::string& text);

/// Runs a script, without the user's start-up file. Throws SimulationError where gnuplot is missing or fails, with the
/// beginning of what it said.
void run_gnuplot(const std::string& script);

} // namespace mpfem
