#include "base/memory.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/machine_memory.h"

namespace norrsken {
namespace {

std::shared_ptr<MemoryBudget>& current_budget() {
  thread_local std::shared_ptr<MemoryBudget> budget;
  return budget;
}

std::string exact_text(std::uint64_t bytes) { return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes"); }

}  // namespace

std::uint64_t MemoryBudget::left() const {
  const std::uint64_t now = used();
  return limit_ - std::min(now, limit_);
}

bool MemoryBudget::take(std::uint64_t bytes) noexcept {
  std::uint64_t before = used();
  do {
    if (before > limit_ || bytes > limit_ - before) return false;
  } while (!used_.compare_exchange_weak(before, before + bytes, std::memory_order_relaxed));
  std::uint64_t highest = peak();
  while (highest < before + bytes && !peak_.compare_exchange_weak(highest, before + bytes, std::memory_order_relaxed)) {
  }
  return true;
}

std::shared_ptr<MemoryBudget> MemoryBudget::of_machine() {
  const std::uint64_t available = std::min(available_memory(), available_address_space());
  return std::make_shared<MemoryBudget>(available == kUnlimited ? kUnlimited : available / 10 * 9);
}

std::shared_ptr<MemoryBudget> MemoryBudget::of_process(std::uint64_t limit) {
  auto budget = std::make_shared<MemoryBudget>(limit);
  budget->take(std::min(resident_memory(), limit));
  return budget;
}

std::string memory_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits = {"KiB", "MiB", "GiB", "TiB"};
  if (bytes < 1024) return exact_text(bytes);
  double value = static_cast<double>(bytes) / 1024;
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < kUnits.size(); ++unit) value /= 1024;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f %s", value < 10 ? 2 : value < 100 ? 1 : 0, value, kUnits[unit]);
  return text.data();
}

std::string shortage_text(const char* needs, std::uint64_t needed, std::uint64_t left, std::uint64_t limit) {
  std::string needed_text = memory_text(needed), left_text = memory_text(left);
  if (needed_text == left_text) needed_text = exact_text(needed), left_text = exact_text(left);
  return std::string(needs) + " " + needed_text + ", and " + left_text + " of " + memory_text(limit) + " are left";
}

MemoryExceeded::MemoryExceeded(std::uint64_t bytes_wanted, const MemoryBudget& budget)
    : wanted(bytes_wanted),
      used(budget.used()),
      limit(budget.limit()),
      text_(shortage_text("it needs another", wanted, limit - std::min(used, limit), limit)) {}

MemoryScope::MemoryScope(std::shared_ptr<MemoryBudget> budget)
    : outer_(std::exchange(current_budget(), std::move(budget))) {}

MemoryScope::~MemoryScope() { current_budget() = std::move(outer_); }

const std::shared_ptr<MemoryBudget>& MemoryScope::current() { return current_budget(); }

MemoryReservation::MemoryReservation(std::uint64_t bytes, std::shared_ptr<MemoryBudget> budget)
    : budget_(std::move(budget)) {
  grow(bytes);
}

void MemoryReservation::grow(std::uint64_t bytes) {
  if (!budget_) return;
  if (!budget_->take(bytes)) throw MemoryExceeded(bytes, *budget_);
  bytes_ += bytes;
}

void MemoryReservation::release() noexcept {
  if (budget_) budget_->give_back(std::exchange(bytes_, 0));
}

}  // namespace norrsken
