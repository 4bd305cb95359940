#pragma once
// Asks the processor to bring a cache line, before it is needed.

#include <algorithm>
#include <cstddef>

namespace mpfem {

// GCC takes a function that does nothing but prefetch for one without any effect, and leaves out the calls of it. The
// empty statement is an effect, and costs no instruction.

/// Prefetches the cache line at an address that will be read. It need not be valid.
[[gnu::always_inline]] inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}

/// The same for an element of an array that will be read; its number may lie beyond the end.
template <class Array>
[[gnu::always_inline]] inline void prefetch_element(const Array& array, std::size_t number) {
  prefetch(array.data() + std::min(number, array.size()));
}

/// The same for an address that will be written.
[[gnu::always_inline]] inline void prefetch_for_writing(const void* address) {
  __builtin_prefetch(address, 1);
  asm volatile("");
}

} // namespace mpfem
