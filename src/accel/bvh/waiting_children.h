// The children that a ray has yet to come back to: how more of them are put there, and how a hit takes some away.
#pragma once

#include "accel/bvh/ray_state.h"

namespace norrsken::NORRSKEN_ISA {

#if NORRSKEN_LANES >= 8

using OctetWords = hn::Vec<hn::FixedTag<std::uint32_t, 8>>;

NORRSKEN_INLINE OctetWords load_octet_words(const std::uint32_t* p) {
  return hn::Load(hn::FixedTag<std::uint32_t, 8>(), p);
}

/// Those whose bit is set, one behind the other.
NORRSKEN_INLINE OctetWords packed(OctetWords words, std::uint32_t bits) {
  const hn::FixedTag<std::uint32_t, 8> tag;
#if NORRSKEN_LANES == 16
  const std::uint8_t byte[8] = {static_cast<std::uint8_t>(bits)};
  return hn::Compress(words, hn::LoadMaskBits(tag, byte));
#else
  const auto row = hn::PromoteTo(tag, hn::Load(hn::FixedTag<std::uint8_t, 8>(), kCompactionTable.rows[bits]));
  return hn::TableLookupLanes(words, hn::IndicesFromVec(tag, row));
#endif
}

#endif

/// Drops those that begin behind a hit, so that whatever is left can be taken without a look.
NORRSKEN_INLINE void drop_behind(RayState& r, float limit) {
  std::uint32_t kept = 0;
#if NORRSKEN_LANES >= 8
  const hn::FixedTag<std::uint32_t, 8> tag;
  for (std::uint32_t i = 0; i < r.waiting; i += 8) {
    const Octet entries = load_octet(r.entry + i);
    const std::uint32_t there = r.waiting - i < 8 ? (1u << (r.waiting - i)) - 1u : 0xffu;
    const std::uint32_t stay = to_bits(entries <= Octet(limit)) & there;
    // Not further than what has been read.
    hn::StoreU(packed(load_octet_words(r.child + i), stay), tag, r.child + kept);
    hn::StoreU(packed(hn::BitCast(tag, entries.v), stay), tag, reinterpret_cast<std::uint32_t*>(r.entry) + kept);
    kept += static_cast<std::uint32_t>(__builtin_popcount(stay));
  }
#else
  for (std::uint32_t i = 0; i < r.waiting; ++i) {
    r.child[kept] = r.child[i];
    r.entry[kept] = r.entry[i];
    kept += r.entry[i] <= limit ? 1u : 0u;
  }
#endif
  r.waiting = kept;
}

/// In the order of the node.
NORRSKEN_INLINE void push_unsorted(RayState& r, const BvhNode& node, std::uint32_t bits) {
#if NORRSKEN_LANES >= 8
  hn::StoreU(packed(load_octet_words(node.child), bits), hn::FixedTag<std::uint32_t, 8>(), r.child + r.waiting);
  r.waiting += static_cast<std::uint32_t>(__builtin_popcount(bits));
#else
  for (; bits != 0; bits &= bits - 1) r.child[r.waiting++] = node.child[__builtin_ctz(bits)];
#endif
}

/// Distances with the child's number in place of their last three bits: they are not negative, so that their words are in
/// the same order.
inline constexpr std::uint32_t kChildBits = kBvhWidth - 1;

/// One after the other, which is for sets without wide registers, and for more than four.
NORRSKEN_INLINE void push_by_insertion(RayState& r, const BvhNode& node, const std::uint32_t* keys,
                                       std::uint32_t bits) {
  std::uint32_t sorted[kBvhWidth], count = 0;
  for (; bits != 0; bits &= bits - 1, ++count) {
    const std::uint32_t key = keys[__builtin_ctz(bits)];
    std::uint32_t at = count;
    for (; at > 0 && sorted[at - 1] < key; --at) sorted[at] = sorted[at - 1];
    sorted[at] = key;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    r.child[r.waiting + i] = node.child[sorted[i] & kChildBits];
    r.entry[r.waiting + i] = __builtin_bit_cast(float, sorted[i] & ~kChildBits);
  }
  r.waiting += count;
}

#if NORRSKEN_LANES >= 8

/// Four words, the largest first, by a network of five comparators (Knuth, The Art of Computer Programming 3, 5.3.4).
NORRSKEN_INLINE hn::Vec<hn::FixedTag<std::uint32_t, 4>> sorted_four(hn::Vec<hn::FixedTag<std::uint32_t, 4>> v) {
  const hn::FixedTag<std::uint32_t, 4> tag;
  using Words = hn::Vec<decltype(tag)>;
  const auto exchange = [&](Words a, Words b, std::uint8_t smaller) {
    const std::uint8_t bits[8] = {smaller};
    return hn::IfThenElse(hn::LoadMaskBits(tag, bits), hn::Min(a, b), hn::Max(a, b));
  };
  v = exchange(v, hn::Shuffle1032(v), 0b1100);
  v = exchange(v, hn::Shuffle2301(v), 0b1010);
  // Of the two in the middle; the outer ones, which meet themselves, stay.
  alignas(16) static constexpr std::uint32_t kMiddle[4] = {0, 2, 1, 3};
  return exchange(v, hn::TableLookupLanes(v, hn::SetTableIndices(tag, kMiddle)), 0b0100);
}

#endif

/// The nearest last.
NORRSKEN_INLINE void push_sorted(RayState& r, const BvhNode& node, const Octet& entry, std::uint32_t bits) {
#if NORRSKEN_LANES >= 8
  const hn::FixedTag<std::uint32_t, 8> tag;
  const hn::FixedTag<std::uint32_t, 4> half;
  const auto keys = hn::Or(hn::AndNot(hn::Set(tag, kChildBits), hn::BitCast(tag, entry.v)), hn::Iota(tag, 0u));
  const auto count = static_cast<std::uint32_t>(__builtin_popcount(bits));
  if (__builtin_expect(count <= 4, 1)) {
    // What is no key is zero, and so comes last: it is written over by the next.
    const auto some = hn::LowerHalf(packed(keys, bits));
    const auto sorted = sorted_four(hn::IfThenElseZero(hn::FirstN(half, count), some));
    const auto indices = hn::And(hn::Combine(tag, sorted, sorted), hn::Set(tag, kChildBits));
    const auto children = hn::TableLookupLanes(load_octet_words(node.child), hn::IndicesFromVec(tag, indices));
    hn::StoreU(hn::LowerHalf(children), half, r.child + r.waiting);
    hn::StoreU(hn::BitCast(hn::FixedTag<float, 4>(), hn::AndNot(hn::Set(half, kChildBits), sorted)),
               hn::FixedTag<float, 4>(), r.entry + r.waiting);
    r.waiting += count;
    return;
  }
  alignas(32) std::uint32_t stored[kBvhWidth];
  hn::Store(keys, tag, stored);
#else
  alignas(32) float distances[kBvhWidth];
  store_octet(distances, entry);
  std::uint32_t stored[kBvhWidth];
  for (std::uint32_t i = 0; i < kBvhWidth; ++i) {
    stored[i] = (__builtin_bit_cast(std::uint32_t, distances[i]) & ~kChildBits) | i;
  }
#endif
  push_by_insertion(r, node, stored, bits);
}

}  // namespace norrsken::NORRSKEN_ISA
