#pragma once
// The processes of a run, its ranks, and how they exchange bytes. Two files implement this: communicator_mpi.cpp, the
// only one that knows MPI, and communicator_alone.cpp, for builds without it, where every process is the only rank.
//
// A function marked "collective" has to be called by all ranks, in the same order, from their first threads.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace mpfem {

using Bytes = std::vector<std::byte>;

/// The ranks of a run as one of them sees them.
class Communicator {
public:
  /// This process alone, whatever others there are.
  Communicator();
  /// The ranks that mpirun or srun started together; this process alone if neither did. To be called once, before
  /// anything else. The object returned ends MPI when it is destroyed. May change the arguments of main.
  static Communicator of_launcher(int& argc, char**& argv);
  Communicator(Communicator&&) noexcept;
  Communicator(const Communicator&) = delete;
  ~Communicator();

  int rank() const { return rank_; } ///< 0 … size() - 1
  int size() const { return size_; }
  bool alone() const { return size_ == 1; }
  /// Whether this is the root, rank 0, which reads and writes files for all, and reports.
  bool is_root() const { return rank_ == 0; }
  /// Whether this build has MPI.
  static bool has_mpi();
  /// Name and version of the MPI library, such as "Open MPI v4.1.4"; empty in a build without MPI.
  static std::string library();

  /// Collective. The bytes of every rank, by rank.
  std::vector<Bytes> all_of(std::span<const std::byte> own) const;
  /// Collective. The same, if the number of bytes of every rank is known: `all` holds them one after another.
  void all_of(std::span<const std::byte> own, std::span<const std::size_t> bytes_of_rank,
              std::span<std::byte> all) const;
  /// Collective. `to` holds what goes to each rank; returns what came from each.
  std::vector<Bytes> exchange(const std::vector<Bytes>& to) const;
  /// Collective. The largest of all ranks' numbers; none may be NaN.
  double largest(double own) const;
  /// Collective. Replaces each of `sums` by the sum of all ranks' numbers, and each of `largest` by the largest of
  /// them; none of these may be NaN.
  void combine(std::span<std::int64_t> sums, std::span<double> largest) const;
  /// s that this rank has spent in largest() and combine(), most of it waiting for the slowest rank.
  double seconds_in_sums() const { return seconds_in_sums_; }
  /// Collective. Copies what the first rank has to all others.
  void broadcast_from_root(Bytes& bytes) const;

  /// Sends to one rank, which must receive the same number of bytes.
  void send(int rank, std::span<const std::byte> bytes) const;
  void receive(int rank, std::span<std::byte> bytes) const;

  /// One message to or from a rank.
  struct Outgoing {
    int rank;
    std::span<const std::byte> bytes;
  };
  struct Incoming {
    int rank;
    std::span<std::byte> bytes; ///< room for the largest message that may come
  };
  /// Messages on their way; their memory must stay until finish().
  class Transfer {
  public:
    Transfer();
    Transfer(Transfer&&) noexcept;
    Transfer& operator=(Transfer&&) noexcept;
    ~Transfer();
    /// Moves the messages on, without waiting. To be called now and then from the first thread while it computes: MPI
    /// may move large messages only within its own functions. Does nothing where MPI gives the core to other programs
    /// each time it finds no message, as with more ranks than cores.
    void progress();
    /// Waits until all messages have been sent and received.
    void finish();

  private:
    friend class Communicator;
    struct State;
    std::unique_ptr<State> state_;
  };
  /// Starts messages to and from some ranks, at most one each way with each.
  Transfer start(const std::vector<Outgoing>& out, const std::vector<Incoming>& in) const;

  /// Whether all ranks call this within a time (s). A rank that fails finds out from it whether all have failed.
  bool all_arrive_within(double seconds) const;
  /// Ends all ranks at once, with this exit code, when one has failed and the others wait for it.
  [[noreturn]] void abort(int exit_code) const;

private:
  int rank_ = 0, size_ = 1;
  bool ends_mpi_ = false;
  mutable double seconds_in_sums_ = 0;
};

/// The bytes of numbers and of plain structs of them.
template <class T>
std::span<const std::byte> bytes_of(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(values);
}

/// Appends a plain value or some of them to a message.
template <class T>
void append(Bytes& message, std::span<const T> values) {
  const auto bytes = bytes_of(values);
  message.insert(message.end(), bytes.begin(), bytes.end());
}
/// The same for one value.
template <class T>
void append(Bytes& message, const T& value) {
  append(message, std::span<const T>(&value, 1));
}

/// Reads a message in the order in which it was put together.
class MessageReader {
public:
  explicit MessageReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  bool done() const { return rest_.empty(); }
  template <class T>
  void take(std::span<T> into) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!into.empty()) std::memcpy(into.data(), rest_.data(), into.size_bytes());
    rest_ = rest_.subspan(into.size_bytes());
  }
  template <class T>
  T take() {
    T value{};
    take(std::span<T>(&value, 1));
    return value;
  }

private:
  std::span<const std::byte> rest_;
};

} // namespace mpfem
