#pragma once
// Random numbers that are the same on every standard library (std::uniform_real_distribution is not).

#include <cmath>
#include <cstdint>
#include <random>

#include <Eigen/Geometry>

namespace mpfem {

/// A generator (64-bit Mersenne Twister) that gives the same numbers for the same seed everywhere.
class Random {
public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  /// Uniform in 0 … count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }
  /// Uniformly distributed rotation (random unit quaternion by rejection in the 4-ball).
  Eigen::Matrix3d rotation() {
    for (;;) {
      const Eigen::Quaterniond q(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
      const double norm = q.norm();
      if (norm > 0.1 && norm < 1) return q.normalized().toRotationMatrix();
    }
  }

private:
  std::mt19937_64 generator_;
};

} // namespace mpfem
