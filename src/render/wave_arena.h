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

/// Which queues there are besides those of paths over surfaces.
struct WaveNeeds {
  bool connections = false;  ///< of paths from the lights
  bool media = false;

  static WaveNeeds of(const IntegratorSettings& integrator) {
    return {.connections = integrator.from_lights, .media = integrator.media};
  }
};

class WaveArena {
 public:
  /// Queues for waves of at most `slots` slots.
  explicit WaveArena(std::uint32_t slots = kWaveSlots, const WaveNeeds& needs = {});
  WaveMemory& memory() { return memory_; }

  /// What one takes.
  static std::uint64_t bytes(std::uint32_t slots, const WaveNeeds& needs);

 private:
  AlignedVector<float> block_;
  WaveMemory memory_;
};

}  // namespace norrsken
