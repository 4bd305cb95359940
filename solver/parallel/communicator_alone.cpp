// A build without MPI: every process is the only rank of its run.

#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

struct Communicator::Transfer::State {};
Communicator::Transfer::Transfer() = default;
Communicator::Transfer::Transfer(Transfer&&) noexcept = default;
Communicator::Transfer& Communicator::Transfer::operator=(Transfer&&) noexcept = default;
Communicator::Transfer::~Transfer() = default;
void Communicator::Transfer::progress() {}
void Communicator::Transfer::finish() {}

Communicator::Communicator() = default;
Communicator::Communicator(Communicator&&) noexcept = default;
Communicator::~Communicator() = default;

namespace {

/// A number that a launcher has set in the environment under one of two names; `otherwise` if none has.
int number_of_launcher(const char* of_open_mpi, const char* of_pmi, int otherwise) {
  for (const char* name : {of_open_mpi, of_pmi})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return otherwise;
}

} // namespace

Communicator Communicator::of_launcher(int&, char**&) {
  // Otherwise only a message that another mpfem writes the same run would show what is wrong.
  const int processes = number_of_launcher("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1);
  if (processes > 1 && number_of_launcher("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0) == 0)
    fmt::print(stderr,
               "mpfem: warning: {} processes were started together, but this build has no MPI, so each is a run of its "
               "own; ./bootstrap --mpi build makes one for several ranks\n",
               processes);
  return {};
}
bool Communicator::has_mpi() {
  return false;
}
std::string Communicator::library() {
  return {};
}

std::vector<Bytes> Communicator::all_of(std::span<const std::byte> own) const {
  return {Bytes(own.begin(), own.end())};
}
void Communicator::all_of(std::span<const std::byte> own, std::span<const std::size_t>,
                          std::span<std::byte> all) const {
  if (!own.empty()) std::memcpy(all.data(), own.data(), own.size());
}
std::vector<Bytes> Communicator::exchange(const std::vector<Bytes>& to) const {
  return to;
}
double Communicator::largest(double own) const {
  return own;
}
void Communicator::combine(std::span<std::int64_t>, std::span<double>) const {}
void Communicator::broadcast_from_root(Bytes&) const {}
void Communicator::send(int, std::span<const std::byte>) const {}
void Communicator::receive(int, std::span<std::byte>) const {}
Communicator::Transfer Communicator::start(const std::vector<Outgoing>&, const std::vector<Incoming>&) const {
  return {};
}
bool Communicator::all_arrive_within(double) const {
  return true;
}
void Communicator::abort(int exit_code) const {
  std::exit(exit_code);
}

} // namespace mpfem
