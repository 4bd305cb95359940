#include "solver/parallel/agree.hpp"

#include <new>

#include "common/errors.hpp"

namespace mpfem {

namespace {

enum class Kind : std::int32_t { none, input, simulation, storage, interrupted, memory, other };

struct Outcome {
  Kind failure = Kind::none;
  double place = 0;
  std::string message;
};

Outcome outcome_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const InputError& error) {
    return {Kind::input, 0, error.what()};
  } catch (const SimulationError& error) {
    return {Kind::simulation, 0, error.what()};
  } catch (const StorageError& error) {
    return {Kind::storage, 0, error.what()};
  } catch (const Interrupted& error) {
    return {Kind::interrupted, 0, error.what()};
  } catch (const std::bad_alloc& error) {
    return {Kind::memory, 0, error.what()};
  } catch (const std::exception& error) {
    return {Kind::other, 0, error.what()};
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
  case Kind::memory:
    throw std::bad_alloc();
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
