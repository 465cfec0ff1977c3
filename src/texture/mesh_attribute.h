// Model       Values that come with a mesh: interpolated between the corners of a triangle, or one for each triangle.
// Source      linear interpolation in barycentric coordinates
// Departures  none
#pragma once

#include "texture/texture.h"

namespace norrsken::NORRSKEN_ISA {

struct MeshAttribute {
  struct Stored {
    static constexpr TextureKind kKind = TextureKind::mesh_attribute;
    float scale;
    /// Offset of a table among the texels, with two words for each shape: where the value of the scene's vertex or triangle
    /// 0 would be, and the number of channels with 4 added for one value per triangle. 0: the shape has no such attribute.
    std::uint32_t table;
  };

  static NORRSKEN_INLINE Color evaluate(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Float scale = gather_slot(scene.parameters, &Stored::scale, offset, active);
    const UInt entry = gather_slot(scene.parameters, &Stored::table, offset, active) + point.shape + point.shape;
    const UInt first = gather_uint(scene.texels, entry, active), layout = gather_uint(scene.texels + 1, entry, active);
    const UInt channels = layout & 3u;
    active &= channels != 0u;
    const UInt step = select(channels == 3u, UInt(1u), UInt(0u));
    const auto value_of = [&](UInt element, Mask m) {
      const UInt at = first + element * channels;
      const auto value = [&](UInt k) { return gather(scene.texels, k, m); };
      return Color{value(at), value(at + step), value(at + step + step)};
    };

    const Mask per_face = active & ((layout & 4u) != 0u), per_vertex = active & !per_face;
    Color value = black();
    if (any(per_face)) value = value_of(point.primitive, per_face);
    if (any(per_vertex)) {
      const Vec2f b = point.barycentric;
      const Float weights[3] = {1.0f - b.x - b.y, b.x, b.y};
      Color sum = black();
      for (int k = 0; k < 3; ++k) {
        const UInt vertex = gather(scene.triangle_vertices + k, point.primitive * 3u, per_vertex);
        sum = fma(value_of(vertex, per_vertex), weights[k], sum);
      }
      value = select(per_vertex, sum, value);
    }
    return {zero_unless(active, value.r * scale), zero_unless(active, value.g * scale),
            zero_unless(active, value.b * scale)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
