// How much memory loading, rendering and comparing may take.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>

namespace norrsken {

/// What large arrays, the film and the acceleration structure are taken from before they are allocated. Buffers that are
/// freed are given back, so it is the peak that counts. May be shared by any number of scenes, renderings and threads.
class MemoryBudget {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  explicit MemoryBudget(std::uint64_t limit = kUnlimited) : limit_(limit) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  /// Nine tenths of what this process can still get: of the machine's available memory, of what is left of its control
  /// group's limit, and of its address space.
  static std::shared_ptr<MemoryBudget> of_machine();
  /// For the whole process: what it holds already counts.
  static std::shared_ptr<MemoryBudget> of_process(std::uint64_t limit);

  std::uint64_t limit() const { return limit_; }
  std::uint64_t used() const { return used_.load(std::memory_order_relaxed); }
  std::uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }
  std::uint64_t left() const;

  /// False, and nothing is taken, if so much is not left.
  bool take(std::uint64_t bytes) noexcept;
  void give_back(std::uint64_t bytes) noexcept { used_.fetch_sub(bytes, std::memory_order_relaxed); }

 private:
  const std::uint64_t limit_;
  std::atomic<std::uint64_t> used_{0}, peak_{0};
};

}  // namespace norrsken
