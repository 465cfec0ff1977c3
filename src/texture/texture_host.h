// What textures share on the host.
#pragma once

#include "scene/parameter.h"
#include "texture/texture.h"

namespace norrsken {

inline constexpr TransformParameter kToUv{.name = "to_uv", .text = "of texture coordinates, in x and y"};

inline isa_host::ToUvSlots to_uv_slots(const glm::dmat4& transform) {
  isa_host::ToUvSlots slots;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < 3; ++i) slots.rows[row][i] = static_cast<float>(transform[i < 2 ? i : 3][row]);
  }
  return slots;
}

}  // namespace norrsken
