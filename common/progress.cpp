#include "common/progress.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "common/one_line.hpp"
#include "common/terminal_width.hpp"

namespace mpfem {

namespace {

/// Without a terminal, lines follow each other after this many seconds, in a job that has taken `elapsed`.
double seconds_between_lines(double elapsed) {
  return std::max(5.0, elapsed / 100);
}

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

} // namespace

std::string duration_text(double seconds) {
  if (!(seconds >= 0)) return "unknown";
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds > 1e9) return "very long";
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(std::string_view label, std::optional<double> fraction, std::string_view detail,
                          double elapsed, std::optional<double> remaining) {
  std::string line(label);
  if (fraction) line += fmt::format(" {:5.1f} %", 100 * *fraction);
  line += fmt::format("  elapsed {}", duration_text(elapsed));
  if (remaining) line += fmt::format("  remaining {}", duration_text(*remaining));
  if (!detail.empty()) line += fmt::format("  {}", detail); // last: a narrow terminal cuts the end off
  return line;
}

Progress::Progress(std::string label, bool quiet, std::FILE* stream)
    : label_(std::move(label)), quiet_(quiet), stream_(stream), terminal_(!quiet && isatty(fileno(stream)) == 1) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stream_);
}

void Progress::update(double fraction, std::string_view detail) {
  if (quiet_ || finished_) return;
  const auto now = Clock::now();
  fraction = fraction > 0 ? std::min(fraction, 1.0) : 0.0; // also turns NaN into 0
  if (!first_fraction_) {
    first_fraction_ = fraction;
    last_fraction_ = fraction;
    first_update_ = now;
  }

  const double elapsed = seconds_between(start_, now);
  const double since = seconds_between(last_written_.value_or(start_), now);
  const bool due = terminal_ ? !last_written_ || since >= 0.2
                             : since >= seconds_between_lines(elapsed) || fraction - last_fraction_ >= 0.1;
  if (!due) return;
  last_written_ = now;
  last_fraction_ = fraction;

  std::optional<double> remaining;
  const double done = fraction - *first_fraction_;
  if (done > 0) remaining = seconds_between(first_update_, now) * (1 - fraction) / done;
  write(progress_line(label_, fraction, detail, elapsed, remaining));
}

void Progress::update(std::string_view detail) {
  if (quiet_ || finished_) return;
  const auto now = Clock::now();
  const double elapsed = seconds_between(start_, now);
  const double since = seconds_between(last_written_.value_or(start_), now);
  const double between_lines = terminal_ ? (last_written_ ? 0.2 : 1.0) : seconds_between_lines(elapsed);
  if (since < between_lines) return;
  last_written_ = now;
  write(progress_line(label_, std::nullopt, detail, elapsed, std::nullopt));
}

void Progress::write(std::string_view text) {
  const std::string line = one_line(text);
  if (terminal_) {
    rewrite_line(line);
  } else {
    fmt::print(stream_, "{}\n", line);
    std::fflush(stream_);
  }
}

void Progress::finish(std::string_view summary) {
  if (quiet_ || finished_) return;
  finished_ = true;
  const std::string line = one_line(
      fmt::format("{}  done in {}  {}", label_, duration_text(seconds_between(start_, Clock::now())), summary));
  if (line_open_) fmt::print(stream_, "\r\x1b[K");
  fmt::print(stream_, "{}\n", line);
  std::fflush(stream_);
  line_open_ = false;
}

void Progress::rewrite_line(std::string_view text) {
  // A line longer than the terminal would wrap, and only its last part would be overwritten.
  const auto width = static_cast<std::size_t>(terminal_width(fileno(stream_)));
  fmt::print(stream_, "\r{}\x1b[K", first_characters(text, width - 1));
  std::fflush(stream_);
  line_open_ = true;
}

} // namespace mpfem
