// Checks of the lane types, compiled once per instruction set for src/simd/lanes_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace norrsken {

/// What went wrong first, for the test's message; `failures` counts all.
struct LaneReport {
  std::uint32_t failures = 0;
  std::uint32_t checks = 0;
  const char* first = nullptr;
  std::uint32_t pattern = 0;  ///< the mask at hand
  int lane = 0;
  float got = 0, wanted = 0;
};

struct LaneCheck {
  const char* name;
  int lanes;
  /// Every one of the 2^lanes masks through select, count, any, all, gather and compress_store.
  void (*all_masks)(LaneReport&);
  /// first_lanes(n) for every n up to twice the width.
  void (*tails)(LaneReport&);
  /// Arithmetic of `count` (a multiple of the width) triples against plain floats.
  void (*arithmetic)(const float* a, const float* b, const float* c, std::uint32_t count, LaneReport&);
};

}  // namespace norrsken
