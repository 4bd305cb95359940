#pragma once
// Progress of a long job on standard error: one updating line on a terminal, plain lines otherwise.

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace mpfem {

/// "1:02:03", "2:03" or "4.5 s".
std::string duration_text(double seconds);

/// "LABEL  42.0 %  elapsed 1:02  remaining 1:25  DETAIL"; `remaining` in seconds. It and the fraction are left out
/// where they are not known.
std::string progress_line(std::string_view label, std::optional<double> fraction, std::string_view detail,
                          double elapsed, std::optional<double> remaining);

/// Reports a job's progress. Cheap enough to call every step: it reads the clock and writes only when a line is due (on
/// a terminal five times a second; otherwise after 10 % of the job or 5 s, later after 1 % of the time spent).
class Progress {
public:
  /// Writes nothing at all when `quiet`. `stream` stays open as long as this object lives.
  Progress(std::string label, bool quiet, std::FILE* stream = stderr);
  /// Ends an unfinished line, so that an error message begins on a separate line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the whole job done, clamped to 0 … 1. A job resumed in the middle may begin at any fraction: the
  /// remaining time is estimated from what was done since the first call.
  void update(double fraction, std::string_view detail);
  /// The same for a job of which nobody knows how much is left: `detail` says by what its end is judged. Nothing is
  /// written in its first second.
  void update(std::string_view detail);
  /// Last line: "LABEL  done in 1:02  SUMMARY". Further calls write nothing.
  void finish(std::string_view summary);

private:
  using Clock = std::chrono::steady_clock;
  void write(std::string_view text);
  void rewrite_line(std::string_view text);

  std::string label_;
  bool quiet_;
  std::FILE* stream_;
  bool terminal_;
  bool line_open_ = false;
  bool finished_ = false;
  Clock::time_point start_ = Clock::now();
  std::optional<Clock::time_point> last_written_;
  double last_fraction_ = 0;
  std::optional<double> first_fraction_;
  Clock::time_point first_update_{};
};

} // namespace mpfem
