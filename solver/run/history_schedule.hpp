#pragma once
// When rows of the history are due: evenly over the time that a stage is expected to take, and ever more rarely in a
// stage that takes much longer, so that the history stays bounded whatever a stage does. Snapshots of a stage are taken
// with some of the rows.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mpfem {

/// Expected durations of a stage over which its rows are even.
inline constexpr double even_durations = 10;

/// Time since the stage began (s) at which the row after `rows` rows is due. `duration` (s): expected for the stage;
/// `wanted`: rows in that time.
inline double next_row_time(double duration, std::int64_t rows, int wanted) {
  const double even = duration * static_cast<double>(rows) / wanted, late = even_durations * duration;
  return even <= late ? even : late * std::exp(even / late - 1);
}

/// The largest number of rows of a stage: a loading may last 50 times as long as expected, and a controlled loading
/// rate may stretch the expected time.
inline double most_rows(int wanted) {
  constexpr double longest = 100; // expected durations
  return wanted * even_durations * (1 + std::log(longest / even_durations)) + 2;
}

/// Whether a snapshot is due with the row that raises the number of rows in the stage from `before` to `after`, if
/// `snapshots` of them are wanted in the time of `rows` rows: at most one for each row, none with the stage's first.
inline bool snapshot_due(std::int64_t before, std::int64_t after, int rows, int snapshots) {
  const std::int64_t wanted = std::min(rows, snapshots);
  return (after - 1) * wanted / rows > std::max<std::int64_t>(before - 1, 0) * wanted / rows;
}

} // namespace mpfem
