#include "render/wave_arena.h"

namespace norrsken {
namespace {

/// Calls visit(queue, stride, capacity) for the queues in memory.
template <class Visit>
void for_each_queue(WaveMemory& memory, std::uint32_t slots, const WaveNeeds& needs, const Visit& visit_queue) {
  const std::uint32_t capacity = (slots + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  // Compressed stores may write a full register past the end. One more cache line keeps fields from falling into the
  // same cache sets.
  constexpr std::uint32_t kPadding = 2 * kMaxLanes;
  const auto visit = [&](auto& queue, std::uint32_t records) { visit_queue(queue, records + kPadding, records); };
  visit(memory.slots, capacity);
  visit(memory.rays, capacity);
  visit(memory.next_rays, capacity);
  for (auto& hits : memory.found.hits) visit(hits, capacity);
  visit(memory.found.unresolved_hits, capacity);
  visit(memory.found.light_hits, capacity);
  visit(memory.found.misses, capacity);
  visit(memory.shadow_rays, capacity);
  if (needs.connections) {
    visit(memory.connections, capacity);
    visit(memory.splats, kSplatsPerSlot * capacity);
  }
  if (needs.media) {
    MediaQueues& media = memory.media;
    for (auto& scatters : media.scatters) visit(scatters, capacity);
    visit(media.passed, capacity);
    visit(media.tracks, capacity);
    visit(media.next_tracks, capacity);
    visit(media.next_shadow_rays, capacity);
    visit(media.shadow_tracks, capacity);
    visit(media.next_shadow_tracks, capacity);
  }
}

}  // namespace

std::uint64_t WaveArena::bytes(std::uint32_t slots, const WaveNeeds& needs) {
  WaveMemory unused;
  std::uint64_t values = 0;
  for_each_queue(unused, slots, needs, [&](const auto& queue, std::uint32_t stride, std::uint32_t) {
    values += std::uint64_t{queue.kFields} * stride;
  });
  return values * sizeof(float);
}

WaveArena::WaveArena(std::uint32_t slots, const WaveNeeds& needs) {
  block_.resize(bytes(slots, needs) / sizeof(float));  // zeros, for lanes beyond a queue's end are read, masked
  float* at = block_.data();
  for_each_queue(memory_, slots, needs, [&](auto& queue, std::uint32_t stride, std::uint32_t capacity) {
    queue = {at, stride, capacity};
    at += std::size_t{queue.kFields} * stride;
  });
}

}  // namespace norrsken
