#pragma once
// gnuplot as a child process, and the files that it reads and writes.

#include <string>

namespace mpfem {

/// A file in the temporary folder that is deleted with the object.
class TemporaryFile {
public:
  /// Throws StorageError where the file cannot be made or written.
  explicit TemporaryFile(const std::string& content);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }
  /// Its current content.
  std::string content() const;

private:
  std::string path_;
};

/// The text as a gnuplot string. In single quotes, since gnuplot would run `commands` inside double ones.
std::string gnuplot_string(const std::string& text);

/// A picture of gnuplot's terminal svg with points as its terminal pngcairo draws them: less than half as large, with
/// outlines as wide as lines. studies/common/svg-points.sed does the same for scripts of gnuplot.
std::string with_points_as_in_png(std::string svg);

/// Runs a script without the user's start-up file. Throws SimulationError where gnuplot is missing or fails, with the
/// beginning of its message.
void run_gnuplot(const std::string& script);

} // namespace mpfem
