#include "base/zeroed_array.h"

#include <sys/mman.h>

#include <new>

#include "base/huge_pages.h"

namespace norrsken {

ZeroedMemory::ZeroedMemory(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  void* data = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) throw std::bad_alloc();
  data_ = data;
  // Fewer and larger pages, where there are any; without them all is well, too.
  constexpr std::size_t kLargePages = std::size_t{4} << 20;
  if (bytes >= kLargePages) ask_for_huge_pages(data, bytes);
}

ZeroedMemory::~ZeroedMemory() {
  if (data_ != nullptr) munmap(data_, bytes_);
}

}  // namespace norrsken
