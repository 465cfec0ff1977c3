#include "scene/within_memory.h"

#include <algorithm>
#include <new>

#include "base/memory.h"

namespace norrsken {

std::string accepted_memory(std::uint64_t left) {
  return (left > 0 ? "up to " + memory_text(left) + ", or " : "") + "a larger --max-memory";
}

void within_memory(const SourceLocation& place, const std::string& what, Diagnostics& diagnostics,
                   const std::function<void()>& load) {
  const auto& budget = MemoryScope::current();
  const std::uint64_t before = budget ? budget->used() : 0;
  const std::string complaint = what + " does not fit into memory: ";
  try {
    load();
    return;
  } catch (const MemoryExceeded& e) {
    const std::uint64_t needed = e.used - std::min(before, e.used) + e.wanted,
                        left = e.limit - std::min(before, e.limit);
    diagnostics.error(place, complaint + shortage_text("it needs at least", needed, left, e.limit),
                      accepted_memory(left));
  } catch (const std::bad_alloc&) {
    diagnostics.error(place, complaint + "the system gives no more", "less, or a system with more memory");
  }
  throw LoadingStopped{};
}

}  // namespace norrsken
