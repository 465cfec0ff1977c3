// Two halves of a recursion, side by side.
#pragma once

#include <cstdint>
#include <exception>
#include <thread>

namespace norrsken {

/// How many of `threads` to share out among the halves of so many references: few are not worth a thread of their own.
inline int threads_worth(std::uint32_t references, int threads) {
  constexpr std::uint32_t kWorthAThread = 16'384;
  return references < kWorthAThread ? 1 : threads;
}

/// Runs both, in a thread of its own each where there are `threads` to share between them. Neither may throw. Both are
/// told how many threads they have.
template <class First, class Second>
void fork(int threads, const First& first, const Second& second) {
  if (threads > 1) {
    try {
      const std::jthread other([&] { second(threads / 2); });
      first(threads - threads / 2);
      return;
    } catch (const std::exception&) {
      // The system has no more threads, or no memory for one.
    }
  }
  first(1);
  second(1);
}

}  // namespace norrsken
