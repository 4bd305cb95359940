#pragma once
// How a packing begins: initial velocities, and checks that grains are apart.

#include <vector>

#include "solver/boundary/box.hpp"
#include "solver/boundary/tools.hpp"
#include "solver/kernels/contact_forces.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// Collective. Gives all grains the scenario's initial velocities. Returns their kinetic energy, mJ. Throws InputError
/// if there is not one velocity for each grain.
double set_initial_velocities(Model& model, const Scenario& scenario, const Communicator& ranks);

/// Collective. Throws InputError if two grains overlap or a grain reaches through a wall. Evaluates contact forces,
/// which are left in the model.
void check_apart(Model& model, Contact& contact, const Box& box, const std::vector<Bounds>& bounds,
                 const std::string& packing_file, const Communicator& ranks);

/// Collective. Throws InputError if a grain reaches into a tool.
void check_clear_of_tools(const Model& model, const Tools& tools, const std::string& packing_file,
                          const Communicator& ranks);

} // namespace mpfem
