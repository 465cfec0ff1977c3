// Large memory of zeros that costs nothing before it is touched: a film is there at once, whatever its size, and its pages
// are made by the threads that write to them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace norrsken {

/// Bytes on the border of a page, all zero. Throws std::bad_alloc if the system has not so much address space.
class ZeroedMemory {
 public:
  ZeroedMemory() = default;
  explicit ZeroedMemory(std::size_t bytes);
  ~ZeroedMemory();
  ZeroedMemory(ZeroedMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  ZeroedMemory& operator=(ZeroedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  void* data() const { return data_; }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

/// An array of a size that stays. Aligned to more than a pair of cache lines.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_default_constructible_v<T>);

 public:
  // NOLINTBEGIN(readability-identifier-naming): the standard's names
  using value_type = T;
  // NOLINTEND(readability-identifier-naming)

  explicit ZeroedArray(std::size_t size = 0) : memory_(size * sizeof(T)), size_(size) {}
  ZeroedArray(ZeroedArray&& other) noexcept : memory_(std::move(other.memory_)), size_(std::exchange(other.size_, 0)) {}
  ZeroedArray& operator=(ZeroedArray&& other) noexcept {
    memory_ = std::move(other.memory_);
    std::swap(size_, other.size_);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return static_cast<T*>(memory_.data()); }
  const T* data() const { return static_cast<const T*>(memory_.data()); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  ZeroedMemory memory_;
  std::size_t size_;
};

}  // namespace norrsken
