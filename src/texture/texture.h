// What every texture gives to those whose parameters it stands for.
//
// A texture is a struct with
//   static Color evaluate(const SceneView&, UInt offset, const TexturePoint&, Mask active);
// where `offset` is that of its own floats in the scene's parameters. Numbers are textures too: theirs is the
// luminance of the colour.
#pragma once

#include "color/color.h"
#include "math/warp.h"
#include "tables/wave_types.h"
#include "texture/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// A place on a surface, as textures see it.
struct TexturePoint {
  Vec2f uv;
  UInt primitive;
  UInt shape;
  Vec2f barycentric;  ///< of triangles: weights of the second and third corner
};
NORRSKEN_INLINE TexturePoint copied(const TexturePoint& p) {
  return {{p.uv.x, p.uv.y}, p.primitive, p.shape, {p.barycentric.x, p.barycentric.y}};
}

/// The affine map of texture coordinates that a texture's block begins with, row by row.
struct ToUvSlots {
  float rows[2][3];
};

/// The map at `offset`.
NORRSKEN_INLINE Vec2f to_uv(const SceneView& scene, UInt offset, Vec2f uv, Mask active) {
  const auto element = [&](int k) { return gather(scene.parameters + k, offset, active); };
  return {fma(element(0), uv.x, fma(element(1), uv.y, element(2))),
          fma(element(3), uv.x, fma(element(4), uv.y, element(5)))};
}

/// The colour of the textures that `words` name: see texture/parameter_reader.h.
Color evaluate_texture(const SceneView& scene, UInt words, TexturePoint point, Mask active);

/// A colour of a texture's own block, or what the texture in its place has. The host bounds how deep they are nested.
template <class Block>
NORRSKEN_INLINE Color gather_color_or_texture(const SceneView& scene, ColorSlot Block::*member, UInt offset,
                                              const TexturePoint& point, Mask active) {
  const float* first = scene.parameters + floats_before(member);
  const Color value = gather_color(first, offset, active);
  const UInt word = gather_uint(first + 3, offset, active);
  const Mask textured = active & (word != 0u);
  return any(textured) ? select(textured, evaluate_texture(scene, word, copied(point), textured), value) : value;
}

}  // namespace norrsken::NORRSKEN_ISA
