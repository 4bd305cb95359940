#pragma once
// A checkpoint or a run that belongs to another scenario: what differs.

#include <string>

namespace mpfem {

/// ": key 'material.density': 1.5e-09 there, 2e-09 in the scenario": the first key that differs from the `earlier`
/// scenario. Empty if the texts differ in nothing that is read.
std::string scenario_difference(const std::string& earlier, const std::string& scenario);

} // namespace mpfem
