#include "render/wave_arena.h"

namespace norrsken {

WaveArena::WaveArena(std::uint32_t slots, bool from_lights) {
  const std::uint32_t capacity = (slots + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  // Compressed stores may write a full register past the end. One more cache line keeps fields from falling into the
  // same cache sets.
  constexpr std::uint32_t kPadding = 2 * kMaxLanes;
  const auto for_each_queue = [&](const auto& visit) {
    visit(memory_.slots, kSlotFieldCount, capacity);
    visit(memory_.rays, kRayFieldCount, capacity);
    visit(memory_.next_rays, kRayFieldCount, capacity);
    for (Queue& q : memory_.hits) visit(q, kHitFieldCount, capacity);
    visit(memory_.unresolved_hits, kHitFieldCount, capacity);
    visit(memory_.light_hits, kHitFieldCount, capacity);
    visit(memory_.misses, kRayFieldCount, capacity);
    visit(memory_.shadow_rays, kShadowFieldCount, capacity);
    if (!from_lights) return;
    visit(memory_.connections, kConnectionFieldCount, capacity);
    visit(memory_.splats, kSplatFieldCount, kSplatsPerSlot * capacity);
  };
  std::size_t values = 0;
  for_each_queue([&](Queue&, std::uint32_t fields, std::uint32_t records) {
    values += std::size_t{fields} * (records + kPadding);
  });
  block_.resize(values);  // zeros, for lanes beyond a queue's end are read, masked
  float* at = block_.data();
  for_each_queue([&](Queue& q, std::uint32_t fields, std::uint32_t records) {
    q = {at, records + kPadding, 0, records};
    at += std::size_t{fields} * (records + kPadding);
  });
}

}  // namespace norrsken
