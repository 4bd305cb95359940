// The only file that knows MPI.

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>

#include <mpi.h>

#include "solver/parallel/communicator.hpp"

namespace mpfem {

namespace {

/// For ranks that have failed: their messages must not mix with those that the others still exchange.
MPI_Comm failing = MPI_COMM_NULL;

/// Whether MPI gives this core to other programs each time it looks for messages and finds none. Open MPI does so where
/// ranks share cores, and where the user wants it (`mpi_yield_when_idle`).
bool gives_core_away = false;

/// Reads this setting through MPI's tool interface. Other implementations have no such setting: false.
bool yields_when_idle() {
  int provided = 0, index = 0, count = 0, value = 0;
  if (MPI_T_init_thread(MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS) return false;
  MPI_T_cvar_handle setting = MPI_T_CVAR_HANDLE_NULL;
  if (MPI_T_cvar_get_index("mpi_yield_when_idle", &index) == MPI_SUCCESS &&
      MPI_T_cvar_handle_alloc(index, nullptr, &setting, &count) == MPI_SUCCESS) {
    MPI_T_cvar_read(setting, &value); // one byte or four
    MPI_T_cvar_handle_free(&setting);
  }
  MPI_T_finalize();
  return value != 0;
}

/// MPI counts in int: larger messages go in pieces.
constexpr std::size_t largest_piece = std::size_t{1} << 30;

int count_of(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a message between ranks is larger than 2 GiB");
  return static_cast<int>(bytes);
}

/// Where each rank's part begins, as int, which MPI requires.
std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offset(counts.size(), 0);
  std::size_t sum = 0;
  for (std::size_t rank = 0; rank < counts.size(); ++rank) {
    offset[rank] = count_of(sum);
    sum += static_cast<std::size_t>(counts[rank]);
  }
  return offset;
}

std::size_t end_of(const std::vector<int>& offsets, const std::vector<int>& counts) {
  return static_cast<std::size_t>(offsets.back()) + static_cast<std::size_t>(counts.back());
}

std::vector<Bytes> divided(const Bytes& all, const std::vector<int>& offsets, const std::vector<int>& counts) {
  std::vector<Bytes> parts;
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
    parts.emplace_back(all.begin() + offsets[rank], all.begin() + offsets[rank] + counts[rank]);
  return parts;
}

/// A message of combine(): the number of sums, the sums, and the largest numbers as their bits.
using Numbers = std::vector<std::int64_t>;

/// Combines messages of this kind; MPI calls it with whole ones, since they are one element each.
extern "C" void combine_numbers(void* own, void* all, int* messages, MPI_Datatype* type) {
  int bytes = 0;
  MPI_Type_size(*type, &bytes);
  const std::size_t size = static_cast<std::size_t>(bytes) / sizeof(std::int64_t);
  const auto* from = static_cast<const std::int64_t*>(own);
  auto* to = static_cast<std::int64_t*>(all);
  for (int message = 0; message < *messages; ++message, from += size, to += size) {
    const auto sums = static_cast<std::size_t>(from[0]);
    for (std::size_t i = 1; i <= sums; ++i) to[i] += from[i];
    for (std::size_t i = sums + 1; i < size; ++i)
      to[i] = std::bit_cast<std::int64_t>(std::max(std::bit_cast<double>(to[i]), std::bit_cast<double>(from[i])));
  }
}

} // namespace

struct Communicator::Transfer::State {
  std::vector<MPI_Request> request;
};
Communicator::Transfer::Transfer() = default;
Communicator::Transfer::Transfer(Transfer&&) noexcept = default;
Communicator::Transfer& Communicator::Transfer::operator=(Transfer&&) noexcept = default;
Communicator::Transfer::~Transfer() = default;

void Communicator::Transfer::progress() {
  if (!state_ || gives_core_away) return; // a core given away costs more than waiting messages
  int complete = 0;
  MPI_Testall(static_cast<int>(state_->request.size()), state_->request.data(), &complete, MPI_STATUSES_IGNORE);
}

void Communicator::Transfer::finish() {
  if (!state_) return;
  MPI_Waitall(static_cast<int>(state_->request.size()), state_->request.data(), MPI_STATUSES_IGNORE);
  state_.reset();
}

Communicator::Communicator() = default;
Communicator::Communicator(Communicator&& other) noexcept
    : rank_(other.rank_), size_(other.size_), ends_mpi_(std::exchange(other.ends_mpi_, false)),
      seconds_in_sums_(other.seconds_in_sums_) {}
Communicator::~Communicator() {
  if (ends_mpi_) MPI_Finalize();
}

Communicator Communicator::of_launcher(int& argc, char**& argv) {
  Communicator communicator;
  // A process that no launcher started needs no MPI, and starts faster without.
  const auto set = [](const char* name) { return std::getenv(name) != nullptr; };
  if (!set("OMPI_COMM_WORLD_SIZE") && !set("PMI_SIZE") && !set("PMIX_RANK") && !set("PMI_RANK")) return communicator;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  communicator.ends_mpi_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &communicator.rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &communicator.size_);
  MPI_Comm_dup(MPI_COMM_WORLD, &failing);
  gives_core_away = yields_when_idle();
  return communicator;
}
bool Communicator::has_mpi() {
  return true;
}
std::string Communicator::library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(length));
  return whole.substr(0, whole.find(','));
}

std::vector<Bytes> Communicator::all_of(std::span<const std::byte> own) const {
  if (alone()) return {Bytes(own.begin(), own.end())};
  const int count = count_of(own.size());
  std::vector<int> counts(static_cast<std::size_t>(size_));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const std::vector<int> offsets = offsets_of(counts);
  Bytes all(end_of(offsets, counts));
  MPI_Allgatherv(own.data(), count, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, MPI_COMM_WORLD);
  return divided(all, offsets, counts);
}

void Communicator::all_of(std::span<const std::byte> own, std::span<const std::size_t> bytes_of_rank,
                          std::span<std::byte> all) const {
  if (alone()) {
    if (!own.empty()) std::memcpy(all.data(), own.data(), own.size());
    return;
  }
  std::vector<int> counts;
  for (const std::size_t bytes : bytes_of_rank) counts.push_back(count_of(bytes));
  const std::vector<int> offsets = offsets_of(counts);
  MPI_Allgatherv(own.data(), count_of(own.size()), MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE,
                 MPI_COMM_WORLD);
}

std::vector<Bytes> Communicator::exchange(const std::vector<Bytes>& to) const {
  if (alone()) return to;
  std::vector<int> counts_out, counts_in(to.size());
  for (const Bytes& bytes : to) counts_out.push_back(count_of(bytes.size()));
  MPI_Alltoall(counts_out.data(), 1, MPI_INT, counts_in.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const std::vector<int> offsets_out = offsets_of(counts_out), offsets_in = offsets_of(counts_in);
  Bytes out, in(end_of(offsets_in, counts_in));
  out.reserve(end_of(offsets_out, counts_out));
  for (const Bytes& bytes : to) out.insert(out.end(), bytes.begin(), bytes.end());
  MPI_Alltoallv(out.data(), counts_out.data(), offsets_out.data(), MPI_BYTE, in.data(), counts_in.data(),
                offsets_in.data(), MPI_BYTE, MPI_COMM_WORLD);
  return divided(in, offsets_in, counts_in);
}

double Communicator::largest(double own) const {
  if (alone()) return own;
  const double start = MPI_Wtime();
  double largest = own;
  MPI_Allreduce(&own, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  seconds_in_sums_ += MPI_Wtime() - start;
  return largest;
}

void Communicator::combine(std::span<std::int64_t> sums, std::span<double> largest) const {
  if (alone()) return;
  Numbers own{static_cast<std::int64_t>(sums.size())};
  own.insert(own.end(), sums.begin(), sums.end());
  for (const double number : largest) own.push_back(std::bit_cast<std::int64_t>(number));
  Numbers all(own.size());
  MPI_Datatype message = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(own.size()), MPI_INT64_T, &message);
  MPI_Type_commit(&message);
  MPI_Op combination = MPI_OP_NULL;
  MPI_Op_create(combine_numbers, 1, &combination);
  const double start = MPI_Wtime();
  MPI_Allreduce(own.data(), all.data(), 1, message, combination, MPI_COMM_WORLD);
  seconds_in_sums_ += MPI_Wtime() - start;
  MPI_Op_free(&combination);
  MPI_Type_free(&message);
  const auto end_of_sums = all.begin() + 1 + static_cast<std::ptrdiff_t>(sums.size());
  std::copy(all.begin() + 1, end_of_sums, sums.begin());
  std::transform(end_of_sums, all.end(), largest.begin(),
                 [](std::int64_t bits) { return std::bit_cast<double>(bits); });
}

void Communicator::broadcast_from_root(Bytes& bytes) const {
  if (alone()) return;
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(size);
  for (std::size_t begin = 0; begin < size; begin += largest_piece)
    MPI_Bcast(bytes.data() + begin, static_cast<int>(std::min(largest_piece, size - begin)), MPI_BYTE, 0,
              MPI_COMM_WORLD);
}

void Communicator::send(int rank, std::span<const std::byte> bytes) const {
  MPI_Send(bytes.data(), count_of(bytes.size()), MPI_BYTE, rank, 0, MPI_COMM_WORLD);
}
void Communicator::receive(int rank, std::span<std::byte> bytes) const {
  MPI_Recv(bytes.data(), count_of(bytes.size()), MPI_BYTE, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

Communicator::Transfer Communicator::start(const std::vector<Outgoing>& out, const std::vector<Incoming>& in) const {
  Transfer transfer;
  if (out.empty() && in.empty()) return transfer;
  transfer.state_ = std::make_unique<Transfer::State>();
  auto& request = transfer.state_->request;
  constexpr int tag = 1; // send() and receive() have 0
  for (const Incoming& message : in)
    MPI_Irecv(message.bytes.data(), count_of(message.bytes.size()), MPI_BYTE, message.rank, tag, MPI_COMM_WORLD,
              &request.emplace_back());
  for (const Outgoing& message : out)
    MPI_Isend(message.bytes.data(), count_of(message.bytes.size()), MPI_BYTE, message.rank, tag, MPI_COMM_WORLD,
              &request.emplace_back());
  return transfer;
}

bool Communicator::all_arrive_within(double seconds) const {
  if (alone()) return true;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(failing, &request);
  const double end = MPI_Wtime() + seconds;
  for (int come = 0;;) {
    MPI_Test(&request, &come, MPI_STATUS_IGNORE);
    if (come != 0) return true;
    if (MPI_Wtime() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void Communicator::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

} // namespace mpfem
