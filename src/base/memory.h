// Counting memory: what is large asks a MemoryBudget before it is allocated.
//
// Arrays whose size a file decides are of type Array, whose allocator asks, so that no growth and no copy on the way can
// be forgotten, and which gives back what is freed. Which budget that is, is not passed through every reader and plugin:
// an array belongs to the budget of the MemoryScope that its thread was in when it was created, and keeps to it, whoever
// moves or frees it. What others allocate (files as they are read, image decoders, Embree) is reserved beside it.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "norrsken/memory.h"

namespace norrsken {

/// The budget has not so much left. (No bad_alloc: the system might have had it.)
class MemoryExceeded : public std::exception {
 public:
  MemoryExceeded(std::uint64_t bytes_wanted, const MemoryBudget& budget);
  const char* what() const noexcept override { return text_.c_str(); }

  std::uint64_t wanted, used, limit;  ///< bytes: those asked for, and how the budget stood then

 private:
  std::string text_;
};

/// "1.25 GiB", "17 bytes".
std::string memory_text(std::uint64_t bytes);
/// "it needs 1.25 GiB, and 512 MiB of 4 GiB are left". In bytes, if both would read the same.
std::string shortage_text(const char* needs, std::uint64_t needed, std::uint64_t left, std::uint64_t limit);

/// While it lives, arrays that this thread creates belong to the budget.
class MemoryScope {
 public:
  explicit MemoryScope(std::shared_ptr<MemoryBudget> budget);
  ~MemoryScope();
  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

  /// The innermost one's; null outside of any: nothing is counted.
  static const std::shared_ptr<MemoryBudget>& current();

 private:
  std::shared_ptr<MemoryBudget> outer_;
};

/// Bytes that are counted while it lives, without being allocated here.
class MemoryReservation {
 public:
  MemoryReservation() = default;
  /// MemoryExceeded if there are not so many. Without a budget nothing is counted.
  explicit MemoryReservation(std::uint64_t bytes, std::shared_ptr<MemoryBudget> budget = MemoryScope::current());
  ~MemoryReservation() { release(); }
  MemoryReservation(MemoryReservation&& other) noexcept
      : budget_(std::move(other.budget_)), bytes_(std::exchange(other.bytes_, 0)) {}
  MemoryReservation& operator=(MemoryReservation&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  /// MemoryExceeded, without a change, if there are not so many more.
  void grow(std::uint64_t bytes);
  void release() noexcept;
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_ = 0;
};

/// Standard allocator that asks the budget first.
template <class T>
class CountedAllocator {
 public:
  using value_type = T;
  // What is moved is not copied: a budget goes with its memory.
  // NOLINTBEGIN(readability-identifier-naming): the standard's names
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;
  // NOLINTEND(readability-identifier-naming)

  CountedAllocator() noexcept : budget_(MemoryScope::current()) {}
  template <class U>
  CountedAllocator(const CountedAllocator<U>& other) noexcept : budget_(other.budget()) {}

  T* allocate(std::size_t n) {
    if (budget_ && n > MemoryBudget::kUnlimited / sizeof(T)) throw std::bad_array_new_length();
    if (budget_ && !budget_->take(n * sizeof(T))) throw MemoryExceeded(n * sizeof(T), *budget_);
    try {
      return std::allocator<T>().allocate(n);
    } catch (...) {
      if (budget_) budget_->give_back(n * sizeof(T));
      throw;
    }
  }
  void deallocate(T* p, std::size_t n) noexcept {
    std::allocator<T>().deallocate(p, n);
    if (budget_) budget_->give_back(n * sizeof(T));
  }

  const std::shared_ptr<MemoryBudget>& budget() const { return budget_; }
  friend bool operator==(const CountedAllocator& a, const CountedAllocator& b) { return a.budget_ == b.budget_; }

 private:
  std::shared_ptr<MemoryBudget> budget_;
};

/// For what may be large.
template <class T>
using Array = std::vector<T, CountedAllocator<T>>;

}  // namespace norrsken
