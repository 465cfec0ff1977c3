#include "render/wave_arena.h"

namespace norrsken {

WaveArena::WaveArena(std::uint32_t slots) {
  const std::uint32_t capacity = (slots + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  // Compressed stores may write a full register past the end. One more cache line keeps fields from falling into the
  // same cache sets.
  const std::uint32_t stride = capacity + 2 * kMaxLanes;
  const auto for_each_queue = [&](const auto& visit) {
    visit(memory_.slots, kSlotFieldCount);
    visit(memory_.rays, kRayFieldCount);
    visit(memory_.next_rays, kRayFieldCount);
    for (Queue& q : memory_.hits) visit(q, kHitFieldCount);
    visit(memory_.unresolved_hits, kHitFieldCount);
    visit(memory_.light_hits, kHitFieldCount);
    visit(memory_.misses, kRayFieldCount);
    visit(memory_.shadow_rays, kShadowFieldCount);
  };
  std::size_t values = 0;
  for_each_queue([&](Queue&, std::uint32_t fields) { values += std::size_t{fields} * stride; });
  block_.resize(values);  // zeros, for lanes beyond a queue's end are read, masked
  float* at = block_.data();
  for_each_queue([&](Queue& q, std::uint32_t fields) {
    q = {at, stride, 0, capacity};
    at += std::size_t{fields} * stride;
  });
}

}  // namespace norrsken
