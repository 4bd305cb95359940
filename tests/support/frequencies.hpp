#pragma once
// All eigenfrequencies of one grain, by brute force.

#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include <Eigen/Dense>

#include "solver/kernels/element_step.hpp"
#include "solver/model/model.hpp"

namespace mpfem::test {

/// Angular frequencies squared (1/s^2) of all modes of a free elastic grain, ascending: eigenvalues of its stiffness,
/// taken from the forces of small moves of every coordinate, with its lumped masses. `added` 1/s^2, [nodes]: to each
/// node's own.
inline Eigen::VectorXd squared_frequencies(Model model, const std::vector<double>& added = {}) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  const auto size = static_cast<Eigen::Index>(3 * nodes);
  const TetBlocks fresh = model.blocks;
  const double move = 1e-7, step = 1e-9; // mm: 1e-6 of a radius
  Eigen::MatrixXd stiffness(size, size);
  const auto forces_at = [&](std::size_t n, std::size_t axis, double by) {
    model.blocks = fresh;
    model.position[4 * n + axis] += by;
    model.velocity[4 * n + axis] = by / step;
    if (!element_forces(model, 0, step).admissible) throw std::runtime_error("not admissible");
    model.position[4 * n + axis] -= by;
    model.velocity[4 * n + axis] = 0;
    Eigen::VectorXd force(size);
    for (std::size_t m = 0; m < nodes; ++m)
      for (std::size_t a = 0; a < 3; ++a) force[static_cast<Eigen::Index>(3 * m + a)] = model.force[4 * m + a];
    return force;
  };
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t axis = 0; axis < 3; ++axis)
      stiffness.col(static_cast<Eigen::Index>(3 * n + axis)) =
          (forces_at(n, axis, -move) - forces_at(n, axis, move)) / (2 * move);
  // The step turns and strains by the half-step configuration: symmetric but for terms of the order of the move.
  const double asymmetry = (stiffness - stiffness.transpose()).norm() / stiffness.norm();
  CHECK(asymmetry < 1e-5);
  Eigen::VectorXd root(size);
  for (Eigen::Index i = 0; i < size; ++i) root[i] = std::sqrt(model.inverse_mass[static_cast<std::size_t>(i / 3)]);
  Eigen::MatrixXd scaled = root.asDiagonal() * (0.5 * (stiffness + stiffness.transpose())) * root.asDiagonal();
  for (Eigen::Index i = 0; i < size && !added.empty(); ++i) scaled(i, i) += added[static_cast<std::size_t>(i / 3)];
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
}

} // namespace mpfem::test
