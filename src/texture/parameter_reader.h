// A model's parameters in lanes: values, or what their texture has at the place.
#pragma once

#include "texture/models.h"
#include "texture/slots.h"
#include "texture/texture.h"

namespace norrsken::NORRSKEN_ISA {

/// The colour of the textures that `words` (see TextureWord) name; for lanes where they name one.
inline Color evaluate_texture(const SceneView& scene, UInt words, TexturePoint point, Mask active) {
  Color color = black();
  const UInt kind_bits = words & kTextureKindMask, offset = words & kTextureOffsetMask;
#define NORRSKEN_TEXTURE(kind, Model)                                                                 \
  if (scene.texture_kinds & (1u << static_cast<std::uint32_t>(TextureKind::kind))) {                  \
    const Mask of_kind = active & (kind_bits == UInt(make_texture(TextureKind::kind, 0)));            \
    if (any(of_kind)) color = select(of_kind, Model::evaluate(scene, offset, point, of_kind), color); \
  }
#include "lists/texture.def"
#undef NORRSKEN_TEXTURE
  return color;
}

/// The parameters of the model that is stored at `offset`, for lanes of one kind of model: `get(&Stored::roughness)`.
struct ParameterReader {
  const SceneView& scene;
  UInt offset;
  const TexturePoint& point;
  Mask active;
  bool any_textures = scene.texture_kinds != 0;  ///< told apart, for a PlainScene knows it when it is compiled

  /// A member of the block, or of a block inside of it: what its texture has at the place, if it has one.
  template <class... Members>
  NORRSKEN_INLINE auto get(Members... path) const {
    return slot<SlotOf<Members...>>(floats_before(path...));
  }

 private:
  template <class... Members>
  struct Last;
  template <class Block, class Slot>
  struct Last<Slot Block::*> {
    using Type = Slot;
  };
  template <class First, class Second>
  struct Last<First, Second> : Last<Second> {};
  template <class... Members>
  using SlotOf = typename Last<Members...>::Type;

  template <class Slot>
  NORRSKEN_INLINE auto slot(std::uint32_t k) const {
    if constexpr (std::is_same_v<Slot, float>) {
      return number(k);
    } else if constexpr (std::is_same_v<Slot, std::uint32_t>) {
      return gather_uint(scene.parameters + k, offset, active);
    } else if constexpr (std::is_same_v<Slot, ColorSlot>) {
      return color(k);
    } else {
      static_assert(std::is_same_v<Slot, NumberSlot>);
      return scalar(k);
    }
  }
  NORRSKEN_INLINE Float number(std::uint32_t k) const { return gather(scene.parameters + k, offset, active); }
  NORRSKEN_INLINE Color color(std::uint32_t k) const {
    const Color value = gather_color(scene.parameters + k, offset, active);
    if (!any_textures) return value;
    const UInt texture = gather_uint(scene.parameters + k + 3, offset, active);
    const Mask textured = active & (texture != 0u);
    return any(textured) ? select(textured, evaluate_texture(scene, texture, copied(point), textured), value) : value;
  }
  NORRSKEN_INLINE Float scalar(std::uint32_t k) const {
    const Float value = number(k);
    if (!any_textures) return value;
    const UInt texture = gather_uint(scene.parameters + k + 1, offset, active);
    const Mask textured = active & (texture != 0u);
    return any(textured) ? select(textured, luminance(evaluate_texture(scene, texture, copied(point), textured)), value)
                         : value;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
