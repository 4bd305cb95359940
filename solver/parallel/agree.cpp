#include "solver/parallel/agree.hpp"

#include <new>

#include "common/errors.hpp"

namespace mpfem {

namespace {

enum class Failure : std::int32_t { none, input, simulation, storage, interrupted, memory, other };

struct Outcome {
  Failure failure = Failure::none;
  double place = 0;
  std::string message;
};

Outcome outcome_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const InputError& error) {
    return {Failure::input, 0, error.what()};
  } catch (const SimulationError& error) {
    return {Failure::simulation, 0, error.what()};
  } catch (const StorageError& error) {
    return {Failure::storage, 0, error.what()};
  } catch (const Interrupted& error) {
    return {Failure::interrupted, 0, error.what()};
  } catch (const std::bad_alloc& error) {
    return {Failure::memory, 0, error.what()};
  } catch (const std::exception& error) {
    return {Failure::other, 0, error.what()};
  }
}

[[noreturn]] void fail(const Outcome& outcome) {
  switch (outcome.failure) {
  case Failure::input:
    throw InputError(outcome.message);
  case Failure::simulation:
    throw SimulationError(outcome.message);
  case Failure::storage:
    throw StorageError(outcome.message);
  case Failure::interrupted:
    throw Interrupted(outcome.message);
  case Failure::memory:
    throw std::bad_alloc();
  case Failure::none:
  case Failure::other:
    break;
  }
  throw std::runtime_error(outcome.message);
}

} // namespace

void agree(const Communicator& ranks, const std::function<void()>& work, const std::function<double()>& place) {
  if (ranks.alone()) return work();
  Outcome own = outcome_of(work);
  if (own.failure != Failure::none) own.place = place();
  Bytes message;
  append(message, own.failure);
  append(message, own.place);
  append(message, std::span<const char>(own.message));
  Outcome first;
  for (const Bytes& bytes : ranks.all_of(message)) {
    MessageReader reader(bytes);
    const auto failure = reader.take<Failure>();
    const auto failed_at = reader.take<double>();
    if (failure == Failure::none || (first.failure != Failure::none && failed_at >= first.place)) continue;
    first = {failure, failed_at, std::string(bytes.size() - sizeof failure - sizeof failed_at, ' ')};
    reader.take(std::span<char>(first.message));
  }
  if (first.failure != Failure::none) fail(first);
}

} // namespace mpfem
