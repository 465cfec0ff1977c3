// Memory on the borders of cache lines: full registers load it without crossing lines, and threads that write
// neighbouring parts do not share a line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace norrsken {

/// Two lines, because processors fetch them in pairs.
inline constexpr std::size_t kCacheLinePair = 128;

/// Standard allocator that aligns what it gives to kCacheLinePair bytes.
template <class T>
struct AlignedAllocator {
  using value_type = T;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kCacheLinePair}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kCacheLinePair}); }

  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace norrsken
