#include "solver/parallel/share_of_cores.hpp"

#include <sched.h>

#include <algorithm>
#include <optional>

#include "common/available_cores.hpp"
#include "common/machine_id.hpp"

namespace mpfem {

namespace {

/// None if the system does not tell.
std::optional<RankPlace> place_of_this_rank() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return std::nullopt;
  RankPlace place{machine_id(), {}};
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) place.cores.push_back(core);
  return place;
}

Bytes message_of(const RankPlace& place) {
  Bytes message;
  append(message, static_cast<std::int32_t>(place.cores.size()));
  append(message, std::span<const int>(place.cores));
  append(message, std::span<const char>(place.machine));
  return message;
}

RankPlace place_in(const Bytes& message) {
  MessageReader reader(message);
  RankPlace place;
  place.cores.resize(static_cast<std::size_t>(reader.take<std::int32_t>()));
  reader.take(std::span(place.cores));
  place.machine.resize(message.size() - sizeof(std::int32_t) - sizeof(int) * place.cores.size());
  reader.take(std::span<char>(place.machine));
  return place;
}

} // namespace

int share_of_cores(const RankPlace& own, std::span<const RankPlace> all) {
  double share = 0;
  for (const int core : own.cores)
    share += 1.0 / static_cast<double>(std::ranges::count_if(all, [&](const RankPlace& rank) {
               return rank.machine == own.machine && std::ranges::binary_search(rank.cores, core);
             }));
  return std::max(1, static_cast<int>(share + 1e-6));
}

int share_of_cores(const Communicator& ranks) {
  if (ranks.alone()) return available_cores();
  const RankPlace own = place_of_this_rank().value_or(RankPlace{});
  std::vector<RankPlace> all;
  for (const Bytes& message : ranks.all_of(message_of(own))) all.push_back(place_in(message));
  return own.cores.empty() ? available_cores() : share_of_cores(own, all);
}

int ranks_on_this_machine(const Communicator& ranks) {
  const std::string own = machine_id();
  const std::vector<Bytes> all = ranks.all_of(bytes_of(std::span<const char>(own)));
  return static_cast<int>(std::ranges::count(all, all[static_cast<std::size_t>(ranks.rank())]));
}

} // namespace mpfem
