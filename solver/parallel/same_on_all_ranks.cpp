#include "solver/parallel/same_on_all_ranks.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// The first line in which two texts differ, as each has it.
std::pair<std::string, std::string> first_difference(const std::string& one, const std::string& other) {
  std::istringstream lines(one), other_lines(other);
  std::string line, other_line;
  const auto read = [](std::istringstream& from, std::string& to) {
    if (!std::getline(from, to)) to = "nothing more";
  };
  do {
    read(lines, line), read(other_lines, other_line);
  } while (line == other_line && (lines || other_lines));
  return {line, other_line};
}

std::string text_of(const Bytes& message) {
  return {reinterpret_cast<const char*>(message.data()), message.size()};
}

} // namespace

void refuse_differences(const Communicator& ranks, const std::string& own, const std::string& allowed) {
  if (ranks.alone()) return;
  const std::vector<Bytes> all = ranks.all_of(bytes_of(std::span<const char>(own)));
  const auto other = std::ranges::find_if(all, [&](const Bytes& text) { return text != all.front(); });
  if (other == all.end()) return;
  const auto [first, differing] = first_difference(text_of(all.front()), text_of(*other));
  throw InputError(
      fmt::format("found {} on rank 0 and {} on rank {}, allowed: {}", first, differing, other - all.begin(), allowed));
}

void refuse_different_builds(const Communicator& ranks, const std::string& own) {
  refuse_differences(
      ranks, own, "one build on all ranks; MPFEM_INSTRUCTION_SET=v2, v3 or v4 selects one that all machines can run");
}

} // namespace mpfem
