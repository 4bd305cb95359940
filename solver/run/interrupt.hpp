#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGUSR1 as requests to stop. The run answers them when its state can be saved.

#include <string>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// From now on the first SIGINT, SIGTERM, SIGHUP or SIGUSR1 is a request only. Another one some seconds later acts as
/// usual. SIGHUP stays ignored where it is, as under nohup. May be called again.
void catch_interrupts();

/// Whether a stop has been requested.
bool interrupt_requested();

/// Collective. Throws Interrupted if a stop has been requested from any rank before the first step. The message says
/// whether the run can be resumed, which depends on whether `checkpoint` exists.
void stop_before_first_step(const Communicator& ranks, const std::string& checkpoint);

} // namespace mpfem
