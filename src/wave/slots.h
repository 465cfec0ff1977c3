// What stages read of a path's slot and add to it.
#pragma once

#include "accel/hit.h"
#include "sampler/sampler.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE SampleKey load_sample_key(const Slots& slots, UInt slot, Mask active) {
  return {gather_uint(slots.field(&stored::Slot::key), slot, active),
          gather_uint(slots.field(&stored::Slot::index), slot, active)};
}

/// To the slots of a register that begins at `first`.
NORRSKEN_INLINE void store_sample_key(Slots& slots, std::uint32_t first, const SampleKey& key) {
  store(slots.field(&stored::Slot::key) + first, key.key);
  store(slots.field(&stored::Slot::index) + first, key.index);
}

/// Adds to the slots' radiance. One slot may occur in several lanes (several shadow rays of one hit), so the lanes
/// go one after the other; the order is the queue's, whatever the register width.
NORRSKEN_INLINE void add_radiance(Slots& slots, UInt slot, const Color& value, Mask m) {
  alignas(64) float red[kLanes], green[kLanes], blue[kLanes], index[kLanes];
  store(red, value.r), store(green, value.g), store(blue, value.b), store(index, slot);
  for (std::uint32_t rest = to_bits(m); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    std::uint32_t s;
    __builtin_memcpy(&s, &index[i], sizeof s);
    slots.field(&stored::Slot::radiance, 0)[s] += red[i];
    slots.field(&stored::Slot::radiance, 1)[s] += green[i];
    slots.field(&stored::Slot::radiance, 2)[s] += blue[i];
  }
}

/// Neither NaN nor an overflow of a model has got into the ray.
NORRSKEN_INLINE Mask is_valid(const Ray& ray) {
  return is_ray(ray.origin, ray.direction) & (sum_of(ray.throughput) < kInfinity);
}

/// Adds NaN to the slots, which is what the film drops and counts. Not inlined: no good scene needs it.
__attribute__((noinline)) inline void invalidate(Slots& slots, UInt slot, Mask lanes) {
  add_radiance(slots, slot, grey(__builtin_nanf("")), lanes);
}

/// Invalidates the samples of the active lanes that are not `valid`. Returns the lanes that are left.
NORRSKEN_INLINE Mask drop_invalid(Mask valid, UInt slot, Slots& slots, Mask active) {
  const Mask invalid = active & !valid;
  if (any(invalid)) invalidate(slots, slot, invalid);
  return active & valid;
}

}  // namespace norrsken::NORRSKEN_ISA
