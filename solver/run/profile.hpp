#pragma once
// Wall-clock time of the parts of a step, measured on every thread.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "solver/output/profile_parts.hpp"

namespace mpfem {

/// Adds up seconds per part and thread. Parts that run on the calling thread alone count for all threads (the others
/// wait), so that the sum over parts, divided by the threads, plus waiting, is the wall-clock time.
class Profile {
public:
  explicit Profile(int threads) : seconds_(static_cast<std::size_t>(threads)) {}

  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

  void add(Part part, int thread, double seconds) {
    seconds_[static_cast<std::size_t>(thread)].part[index(part)] += seconds;
  }
  void add_serial(Part part, double seconds) {
    for (auto& thread : seconds_) thread.part[index(part)] += seconds;
  }
  /// Seconds of wall-clock time in a part.
  double seconds(Part part) const {
    double total = 0;
    for (const auto& thread : seconds_) total += thread.part[index(part)];
    return total / static_cast<double>(seconds_.size());
  }

private:
  static std::size_t index(Part part) { return static_cast<std::size_t>(part); }
  struct alignas(64) PerThread {
    std::array<double, profile_parts> part{};
  };
  std::vector<PerThread> seconds_;
};

/// A line of the table of wall-clock times.
struct PartTime {
  std::string name;
  double seconds = 0;
};
/// The table: `seconds` of all parts, and what they leave of the wall-clock time (s).
inline std::vector<PartTime> part_times(const std::array<double, profile_parts>& seconds, double wall_time) {
  std::vector<PartTime> times;
  double accounted = 0;
  for (std::size_t i = 0; i < profile_parts; ++i) {
    times.push_back({part_names[i], seconds[i]});
    accounted += seconds[i];
  }
  times.push_back({"waiting and rest", std::max(0.0, wall_time - accounted)});
  return times;
}

/// Measures one part after another on one thread: mark(part) closes the part that began at the last mark.
class Stopwatch {
public:
  Stopwatch(Profile& profile, int thread) : profile_(profile), thread_(thread), start_(Profile::Clock::now()) {}
  void mark(Part part) {
    const auto now = Profile::Clock::now();
    profile_.add(part, thread_, std::chrono::duration<double>(now - start_).count());
    start_ = now;
  }

private:
  Profile& profile_;
  int thread_;
  Profile::Clock::time_point start_;
};

} // namespace mpfem
