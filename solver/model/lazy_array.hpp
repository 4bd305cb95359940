#pragma once
// Arrays of fixed size, zero at first, aligned to a cache line. Memory pages that are never written take no room. So a
// rank's arrays can be as long as the whole packing's, and all ranks number nodes, tets and facets alike, although each
// holds only the grains that it needs.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include <sys/mman.h>

namespace mpfem {

/// Memory pages that the system is to use for an array.
enum class Pages {
  large, ///< large pages, if the system has them: fewer pages have to be looked up
  small  ///< small pages: for arrays with holes, which large pages would fill
};

/// An array of `size()` values, all zero at first. It does not grow.
template <class T>
class LazyArray {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

public:
  using value_type = T;

  LazyArray() = default;
  /// Throws std::bad_alloc.
  explicit LazyArray(std::size_t size, Pages pages = Pages::large) : size_(size), pages_(pages) { allocate(); }
  LazyArray(const LazyArray& other) : LazyArray(other.size_, other.pages_) {
    std::copy(other.begin(), other.end(), begin());
  }
  LazyArray(LazyArray&& other) noexcept { swap(other); }
  LazyArray& operator=(LazyArray other) noexcept {
    swap(other);
    return *this;
  }
  ~LazyArray() {
    if (mapped())
      munmap(data_, bytes());
    else
      std::free(data_);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  bool operator==(const LazyArray& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

private:
  std::size_t bytes() const { return size_ * sizeof(T); }
  /// Small arrays come from the heap, where sanitizers watch over them.
  bool mapped() const { return bytes() >= std::size_t{1} << 20; }

  void allocate() {
    if (size_ == 0) return;
    if (size_ > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    if (!mapped()) {
      data_ = static_cast<T*>(std::aligned_alloc(64, (bytes() + 63) / 64 * 64));
      if (data_ == nullptr) throw std::bad_alloc();
      std::memset(static_cast<void*>(data_), 0, bytes());
      return;
    }
    const int flags = MAP_PRIVATE | MAP_ANONYMOUS | (pages_ == Pages::small ? MAP_NORESERVE : 0);
    void* const memory = mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, flags, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    madvise(memory, bytes(), pages_ == Pages::small ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
    data_ = static_cast<T*>(memory);
  }
  void swap(LazyArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(pages_, other.pages_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  Pages pages_ = Pages::large;
};

} // namespace mpfem
