// Model       An image. Texel (column i, row j from the top) of w x h covers [i/w, (i+1)/w] x [j/h, (j+1)/h] of uv: uv
//             (0, 0) is the image's upper left corner.
// Source      Mitsuba 3's documentation of its bitmap texture; bilinear interpolation between texel centres
// Departures  8-bit texels are kept as such, where Mitsuba stores 16-bit floats
#pragma once

#include "texture/texture.h"

namespace norrsken::NORRSKEN_ISA {

struct Bitmap {
  /// See StoredImage in compile/images.h.
  struct Stored {
    static constexpr TextureKind kKind = TextureKind::bitmap;
    ToUvSlots to_uv;
    float width, height;
    std::uint32_t texels, stride, table;
    std::uint32_t wrap_modes;  ///< that of u, and 4 times that of v
    std::uint32_t nearest;     ///< 1 if it is
  };

  /// The image of each lane, and the four texels around a place.
  struct Lookup {
    UInt texels, stride, table;
    UInt i[2][2];  ///< [row][column]
    Vec2f weight;  ///< of the second column and row
    Vec2f size;
    Mask bilinear;
  };

  static NORRSKEN_INLINE Color evaluate(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Lookup l = look_up(scene, offset, point, active);
    const Color first = texel(scene, l, l.i[0][0], active);
    const Mask blend = active & l.bilinear;
    if (none(blend)) return first;
    const Color top = mix(first, texel(scene, l, l.i[0][1], blend), l.weight.x);
    const Color bottom = mix(texel(scene, l, l.i[1][0], blend), texel(scene, l, l.i[1][1], blend), l.weight.x);
    return select(blend, mix(top, bottom, l.weight.y), first);
  }

  /// How the luminance changes with u and v: the derivative of the interpolant; 0 without interpolation.
  static NORRSKEN_INLINE Vec2f gradient(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Lookup l = look_up(scene, offset, point, active);
    const Mask blend = active & l.bilinear;
    Float f[2][2];
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) f[row][column] = luminance(texel(scene, l, l.i[row][column], blend));
    }
    const auto between = [](Float a, Float b, Float t) { return fma(b - a, t, a); };
    // Along the image's own axes, from texel to texel; then through to_uv and the image's size.
    const Float dx = between(f[0][1] - f[0][0], f[1][1] - f[1][0], l.weight.y) * l.size.x;
    const Float dy = between(f[1][0] - f[0][0], f[1][1] - f[0][1], l.weight.x) * l.size.y;
    const auto element = [&](int k) { return gather(scene.parameters + k, offset, active); };
    return {zero_unless(blend, fma(element(0), dx, element(3) * dy)),
            zero_unless(blend, fma(element(1), dx, element(4) * dy))};
  }

 private:
  static NORRSKEN_INLINE Lookup look_up(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const auto stored = [&](auto member) { return gather_slot(scene.parameters, member, offset, active); };
    Lookup l;
    l.size = {stored(&Stored::width), stored(&Stored::height)};
    l.texels = stored(&Stored::texels), l.stride = stored(&Stored::stride), l.table = stored(&Stored::table);
    const UInt wrap = stored(&Stored::wrap_modes), wrap_u = wrap & 3u, wrap_v = shift_right<2>(wrap);
    l.bilinear = stored(&Stored::nearest) == 0u;

    const Vec2f uv = to_uv(scene, offset, point.uv, active);
    const Float half = select(l.bilinear, Float(0.5f), Float(0.0f));
    const Float x = fma(uv.x, l.size.x, -half), y = fma(uv.y, l.size.y, -half);
    const Float x0 = floor(x), y0 = floor(y);
    l.weight = {x - x0, y - y0};
    const Float width = l.size.x;
    const UInt columns[2] = {wrapped(x0, width, wrap_u), wrapped(x0 + 1.0f, width, wrap_u)};
    const UInt rows[2] = {wrapped(y0, l.size.y, wrap_v), wrapped(y0 + 1.0f, l.size.y, wrap_v)};
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) l.i[row][column] = rows[row] * to_uint(width) + columns[column];
    }
    return l;
  }

  /// The texel of [0, size) that stands at place i of the endless plane; i and size are integers.
  static NORRSKEN_INLINE UInt wrapped(Float i, Float size, UInt wrap) {
    const Float last = size - 1.0f;
    const Float clamped = min(max(i, 0.0f), last);
    const Float repeated = fnma(floor(i / size), size, i);
    const Float period = size + size;
    const Float within = fnma(floor(i / period), period, i);
    const Float mirrored = min(within, period - 1.0f - within);
    const Float chosen = select(wrap == 0u, repeated, select(wrap == 1u, mirrored, clamped));
    // Far out, where floats have no fractions, and for what is no number at all: anything inside.
    return to_uint(select((chosen >= 0.0f) & (chosen <= last), chosen, 0.0f));
  }

  static NORRSKEN_INLINE Color texel(const SceneView& scene, const Lookup& l, UInt i, Mask active) {
    const Mask packed = active & (l.stride == 0u), floats = active & (l.stride != 0u);
    Color color = black();
    if (any(packed)) {
      const UInt bytes = gather_uint(scene.texels, l.texels + i, packed);
      const auto value = [&](UInt byte) { return gather(scene.texels, l.table + (byte & 255u), packed); };
      color = {value(bytes), value(shift_right<8>(bytes)), value(shift_right<16>(bytes))};
    }
    if (any(floats)) {
      const UInt first = l.texels + i * l.stride, step = select(l.stride == 3u, UInt(1u), UInt(0u));
      const auto value = [&](UInt k) { return gather(scene.texels, k, floats); };
      color = select(floats, Color{value(first), value(first + step), value(first + step + step)}, color);
    }
    return color;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
