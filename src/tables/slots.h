// Blocks of parameters as host and kernels share them. A model's `Stored` is a struct of these slots, of floats and of
// words: the host fills it by name, and kernels read it by member (texture/slots.h, texture/parameter_reader.h).
#pragma once

#include <array>
#include <bit>
#include <type_traits>

#include "tables/scene_tables.h"

namespace norrsken {

/// A colour, or with a texture a colour to describe it by.
struct ColorSlot {
  float rgb[3];
  TextureWord texture;
};

/// A number, or with a texture one to describe it by.
struct NumberSlot {
  float value;
  TextureWord texture;
};

/// Three plain floats.
struct ValuesSlot {
  float values[3];
};

/// A block as it stands in SceneTables::parameters.
template <class Block>
std::array<float, sizeof(Block) / sizeof(float)> floats_of(const Block& block) {
  static_assert(std::is_aggregate_v<Block> && alignof(Block) == sizeof(float), "a block is made of slots and words");
  return std::bit_cast<std::array<float, sizeof(Block) / sizeof(float)>>(block);
}

}  // namespace norrsken
