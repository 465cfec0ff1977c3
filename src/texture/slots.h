// Reading a block of parameters (tables/slots.h) by its members.
#pragma once

#include <type_traits>

#include "color/color.h"
#include "tables/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Floats of a block before one of its members.
template <class Block, class Slot>
NORRSKEN_INLINE std::uint32_t floats_before(Slot Block::*member) {
  const Block block{};
  const auto* begin = reinterpret_cast<const char*>(&block);
  const auto bytes = static_cast<std::uint32_t>(reinterpret_cast<const char*>(&(block.*member)) - begin);
  return bytes / std::uint32_t{sizeof(float)};
}
/// The same before a member of a block inside of it.
template <class Block, class Inner, class Slot>
NORRSKEN_INLINE std::uint32_t floats_before(Inner Block::*block, Slot Inner::*member) {
  return floats_before(block) + floats_before(member);
}

/// A float, a word, or three floats, of the blocks at `offset`.
template <class Block, class Slot>
NORRSKEN_INLINE auto gather_slot(const float* parameters, Slot Block::*member, UInt offset, Mask active) {
  const float* first = parameters + floats_before(member);
  if constexpr (std::is_same_v<Slot, float>) {
    return gather(first, offset, active);
  } else if constexpr (std::is_same_v<Slot, std::uint32_t>) {
    return gather_uint(first, offset, active);
  } else {
    static_assert(std::is_same_v<Slot, ValuesSlot>);
    return gather_color(first, offset, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
