#pragma once
// A checkpoint that belongs to another scenario: what differs.

#include <string>

namespace mpfem {

/// "; key 'material.density': 1.5e-09 in the checkpoint, 2e-09 in the scenario": the first key that differs. Empty if
/// the texts differ in nothing that is read.
std::string scenario_difference(const std::string& in_checkpoint, const std::string& scenario);

} // namespace mpfem
