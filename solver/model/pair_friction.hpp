#pragma once
// Coulomb's coefficient between grains, by the materials of both.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mpfem {

/// Coulomb's mu of every pair of materials. One number for all pairs, unless `set` says otherwise.
class PairFriction {
public:
  PairFriction() = default;
  /// `materials` >= 1: number of materials; `everywhere` >= 0: mu of all pairs.
  PairFriction(std::size_t materials, double everywhere)
      : materials_(materials), coefficient_(materials * materials, everywhere) {}

  /// mu of two materials, in either order.
  void set(std::size_t first, std::size_t second, double coefficient) {
    coefficient_[first * materials_ + second] = coefficient_[second * materials_ + first] = coefficient;
  }
  double of(std::size_t first, std::size_t second) const { return coefficient_[first * materials_ + second]; }
  /// Whether any two materials rub.
  bool present() const {
    return std::any_of(coefficient_.begin(), coefficient_.end(), [](double coefficient) { return coefficient > 0; });
  }

private:
  std::size_t materials_ = 0;
  std::vector<double> coefficient_; ///< [materials, materials], symmetric
};

} // namespace mpfem
