// Textures evaluated by one instruction set, for tests.
#pragma once

#include <cstdint>

#include "tables/wave_types.h"

namespace norrsken {

/// Arrays are padded to whole registers. Outputs: red, green, blue, and the gradient of bitmaps.
struct TextureCheck {
  const char* name;
  void (*evaluate)(const SceneView&, TextureWord, const float* u, const float* v, const std::uint32_t* primitive,
                   const std::uint32_t* shape, float* const out[5], std::uint32_t count);
};

}  // namespace norrsken
