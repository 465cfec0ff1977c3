#include "render/wave_arena.h"

namespace norrsken {
namespace {

/// Calls visit(queue, fields, stride, capacity) for the queues in memory.
template <class Visit>
void for_each_queue(WaveMemory& memory, std::uint32_t slots, bool from_lights, const Visit& visit_queue) {
  const std::uint32_t capacity = (slots + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  // Compressed stores may write a full register past the end. One more cache line keeps fields from falling into the
  // same cache sets.
  constexpr std::uint32_t kPadding = 2 * kMaxLanes;
  const auto visit = [&](Queue& queue, std::uint32_t fields, std::uint32_t records) {
    visit_queue(queue, fields, records + kPadding, records);
  };
  visit(memory.slots, kSlotFieldCount, capacity);
  visit(memory.rays, kRayFieldCount, capacity);
  visit(memory.next_rays, kRayFieldCount, capacity);
  for (Queue& q : memory.hits) visit(q, kHitFieldCount, capacity);
  visit(memory.unresolved_hits, kHitFieldCount, capacity);
  visit(memory.light_hits, kHitFieldCount, capacity);
  visit(memory.misses, kRayFieldCount, capacity);
  visit(memory.shadow_rays, kShadowFieldCount, capacity);
  if (!from_lights) return;
  visit(memory.connections, kConnectionFieldCount, capacity);
  visit(memory.splats, kSplatFieldCount, kSplatsPerSlot * capacity);
}

}  // namespace

std::uint64_t WaveArena::bytes(std::uint32_t slots, bool from_lights) {
  WaveMemory unused;
  std::uint64_t values = 0;
  for_each_queue(unused, slots, from_lights, [&](Queue&, std::uint32_t fields, std::uint32_t stride, std::uint32_t) {
    values += std::uint64_t{fields} * stride;
  });
  return values * sizeof(float);
}

WaveArena::WaveArena(std::uint32_t slots, bool from_lights) {
  block_.resize(bytes(slots, from_lights) / sizeof(float));  // zeros, for lanes beyond a queue's end are read, masked
  float* at = block_.data();
  for_each_queue(memory_, slots, from_lights,
                 [&](Queue& q, std::uint32_t fields, std::uint32_t stride, std::uint32_t records) {
                   q = {at, stride, 0, records};
                   at += std::size_t{fields} * stride;
                 });
}

}  // namespace norrsken
