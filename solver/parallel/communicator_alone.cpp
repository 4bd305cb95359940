// A build without MPI: every process is the only rank of its run.

#include <cstdlib>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

struct Communicator::Transfer::State {};
Communicator::Transfer::Transfer() = default;
Communicator::Transfer::Transfer(Transfer&&) noexcept = default;
Communicator::Transfer& Communicator::Transfer::operator=(Transfer&&) noexcept = default;
Communicator::Transfer::~Transfer() = default;
void Communicator::Transfer::finish() {}

Communicator::Communicator() = default;
Communicator::Communicator(Communicator&&) noexcept = default;
Communicator::~Communicator() = default;

Communicator Communicator::of_launcher(int&, char**&) {
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
