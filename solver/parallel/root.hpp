#pragma once
// What the root, the first rank, alone finds out or does, and all then know. The others do not look at the file system:
// if it is shared, they may see another state of it.

#include <string>
#include <utility>
#include <vector>

#include "solver/parallel/agree.hpp"

namespace mpfem {

/// Collective. Calls `work` on the first rank; if it throws, all ranks throw that error.
template <class Work>
void root_does(const Communicator& ranks, Work&& work) {
  agree(ranks, [&] {
    if (ranks.is_root()) work();
  });
}

/// Collective. The answer of the first rank to a yes-or-no question.
template <class Question>
bool root_finds(const Communicator& ranks, Question&& question) {
  bool answer = false;
  root_does(ranks, [&] { answer = question(); });
  return ranks.largest(answer ? 1 : 0) > 0;
}

/// Collective. The texts that the first rank finds.
template <class Find>
std::vector<std::string> root_lists(const Communicator& ranks, Find&& find) {
  std::vector<std::string> texts;
  root_does(ranks, [&] { texts = find(); });
  Bytes message;
  for (const std::string& text : texts) {
    append(message, text.size());
    append(message, std::span<const char>(text));
  }
  ranks.broadcast_from_root(message);
  texts.clear();
  for (MessageReader reader(message); !reader.done();) {
    std::string text(reader.take<std::size_t>(), ' ');
    reader.take(std::span<char>(text));
    texts.push_back(std::move(text));
  }
  return texts;
}

/// Collective. One text of the first rank.
template <class Find>
std::string root_says(const Communicator& ranks, Find&& find) {
  return root_lists(ranks, [&] { return std::vector<std::string>{find()}; }).front();
}

} // namespace mpfem
