#pragma once
// Asks the processor to bring a cache line, before it is needed.

#include <cstddef>
#include <cstdint>

namespace mpfem {

// GCC takes a function that does nothing but prefetch for one without any effect, and leaves out the calls of it. The
// empty statement is an effect, and costs no instruction.

/// Prefetches the cache line at an address that will be read. It need not be valid.
[[gnu::always_inline]] inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}

/// The same for a place in an array, which may lie beyond its end.
template <class T>
[[gnu::always_inline]] inline void prefetch_place(const T* array, std::size_t index) {
  prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(array) + index * sizeof(T)));
}

/// The same for an address that will be written.
[[gnu::always_inline]] inline void prefetch_for_writing(const void* address) {
  __builtin_prefetch(address, 1);
  asm volatile("");
}

} // namespace mpfem
