// A worker's memory for waves: one allocation, all queues in it.
#pragma once

#include <cstdint>

#include "base/aligned.h"
#include "tables/wave_types.h"

namespace norrsken {

/// Slots per wave: small enough that the queues stay in the second-level cache, large enough that the partly filled
/// last register of every queue does not matter. Measured, see docs/performance.md.
inline constexpr std::uint32_t kWaveSlots = 1024;

/// Splats that a wave's memory has room for, per slot: those of so many bounces at least.
inline constexpr std::uint32_t kSplatsPerSlot = 4;

class WaveArena {
 public:
  /// Queues for waves of at most `slots` slots; those of paths from the lights only if asked for.
  explicit WaveArena(std::uint32_t slots = kWaveSlots, bool from_lights = false);
  WaveMemory& memory() { return memory_; }

  /// What one takes.
  static std::uint64_t bytes(std::uint32_t slots, bool from_lights);

 private:
  AlignedVector<float> block_;
  WaveMemory memory_;
};

}  // namespace norrsken
