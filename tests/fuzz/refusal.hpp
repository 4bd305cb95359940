#pragma once
// What a fuzzer demands of a reader: it takes a text, or refuses it in one short line.

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/errors.hpp"

namespace mpfem::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size}; // the bytes are the text
}

/// Calls the reader. Aborts, and so keeps the input, where another exception than InputError leaves it, or where a
/// message has several lines or is long.
template <class Reader>
void read_or_refuse(Reader reader) {
  constexpr std::size_t longest = 1600; // bytes; 400 characters of at most four
  try {
    reader();
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    if (message.empty() || message.size() > longest || message.find('\n') != std::string_view::npos) std::abort();
  }
}

} // namespace mpfem::fuzz
