// Memory in pages of the largest size, where the system has them: what is read here and there waits less for addresses.
// Where it has none, or none left, nothing happens.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace norrsken {

/// Of the whole pages in between.
inline void advise_huge_pages(const void* begin, std::size_t bytes, int advice) {
  constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + kHugePage - 1) & ~(kHugePage - 1);
  const std::uintptr_t last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) & ~(kHugePage - 1);
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, advice);
}

/// For memory that has not been touched yet.
inline void ask_for_huge_pages(const void* begin, std::size_t bytes) { advise_huge_pages(begin, bytes, MADV_HUGEPAGE); }

/// For memory that has values, which are moved at once (Linux 6.1 and later).
inline void move_to_huge_pages(const void* begin, std::size_t bytes) {
  constexpr int kCollapse = 25;  // MADV_COLLAPSE, which older headers do not have
  advise_huge_pages(begin, bytes, kCollapse);
}

}  // namespace norrsken
