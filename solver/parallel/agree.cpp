#include "solver/parallel/agree.hpp"

#include <stdexcept>

#include "common/errors.hpp"

namespace mpfem {

namespace {

enum class Kind : std::int32_t { none, input, simulation, storage, interrupted, other };

struct Outcome {
  Kind failure = Kind::none;
  double place = 0;
  std::string message;
};

Kind kind_of(ExitCode code) {
  switch (code) {
  case ExitCode::bad_input:
    return Kind::input;
  case ExitCode::storage_failed:
    return Kind::storage;
  case ExitCode::interrupted:
    return Kind::interrupted;
  case ExitCode::done:
  case ExitCode::simulation_failed:
    break;
  }
  return Kind::other;
}

Outcome outcome_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const SimulationError& error) { // the catcher saves the state; not so for other failures of that code
    return {Kind::simulation, 0, error.what()};
  } catch (...) {
    const Failure failure = present_failure();
    return {kind_of(failure.code), 0, failure.message};
  }
}

[[noreturn]] void fail(const Outcome& outcome) {
  switch (outcome.failure) {
  case Kind::input:
    throw InputError(outcome.message);
  case Kind::simulation:
    throw SimulationError(outcome.message);
  case Kind::storage:
    throw StorageError(outcome.message);
  case Kind::interrupted:
    throw Interrupted(outcome.message);
  case Kind::none:
  case Kind::other:
    break;
  }
  throw std::runtime_error(outcome.message);
}

} // namespace

void agree(const Communicator& ranks, const std::function<void()>& work, const std::function<double()>& place) {
  if (ranks.alone()) return work();
  Outcome own = outcome_of(work);
  if (own.failure != Kind::none) own.place = place();
  Bytes message;
  append(message, own.failure);
  append(message, own.place);
  append(message, std::span<const char>(own.message));
  Outcome first;
  for (const Bytes& bytes : ranks.all_of(message)) {
    MessageReader reader(bytes);
    const auto failure = reader.take<Kind>();
    const auto failed_at = reader.take<double>();
    if (failure == Kind::none || (first.failure != Kind::none && failed_at >= first.place)) continue;
    first = {failure, failed_at, std::string(bytes.size() - sizeof failure - sizeof failed_at, ' ')};
    reader.take(std::span<char>(first.message));
  }
  if (first.failure != Kind::none) fail(first);
}

} // namespace mpfem
