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
    std::uint32_t texels, table;
    std::uint32_t flags;  ///< see below
  };
  /// Of `flags`: floats per texel, that is 0, 1 or 3; the wrap modes of u and v; the texel nearest to a place alone; and
  /// that to_uv changes something.
  static constexpr std::uint32_t kStride = 3, kWrapShift = 2, kWrapModes = 15u << kWrapShift, kNearest = 64,
                                 kMapped = 128;

  /// The image of each lane, and the four texels around a place.
  struct Lookup {
    UInt table, stride;
    UInt at[2][2];  ///< where they begin: [row][column]
    Vec2f weight;   ///< of the second column and row
    Vec2f size;
    Mask bilinear;
  };

  static NORRSKEN_INLINE Color evaluate(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Lookup l = look_up(scene, offset, point, active);
    const Mask blend = active & l.bilinear;
    if (none(blend)) return texel(scene, l, l.at[0][0], gather(scene.texels, l.at[0][0], active), active);
    const Texels t = texels(scene, l, active);
    const Color top = mix(t.color[0][0], t.color[0][1], l.weight.x);
    const Color bottom = mix(t.color[1][0], t.color[1][1], l.weight.x);
    return select(blend, mix(top, bottom, l.weight.y), t.color[0][0]);
  }

  /// How the luminance changes with u and v: the derivative of the interpolant; 0 without interpolation.
  static NORRSKEN_INLINE Vec2f gradient(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Lookup l = look_up(scene, offset, point, active);
    const Mask blend = active & l.bilinear;
    const Texels around = texels(scene, l, blend);
    Float f[2][2];
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) f[row][column] = luminance(around.color[row][column]);
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
    l.table = stored(&Stored::table);
    const UInt texels = stored(&Stored::texels), flags = stored(&Stored::flags);
    l.stride = flags & kStride;
    l.bilinear = (flags & kNearest) == 0u;

    Vec2f uv = point.uv;
    const Mask mapped = active & ((flags & kMapped) != 0u);
    if (any(mapped)) uv = select(mapped, to_uv(scene, offset, uv, mapped), uv);
    const Float half = select(l.bilinear, Float(0.5f), Float(0.0f));
    const Float x = fma(uv.x, l.size.x, -half), y = fma(uv.y, l.size.y, -half);
    const Float x0 = floor(x), y0 = floor(y);
    l.weight = {x - x0, y - y0};
    const Float width = l.size.x;
    Places columns, rows;
    if (none(active & ((flags & kWrapModes) != 0u))) {
      columns = repeated(x0, width), rows = repeated(y0, l.size.y);
    } else {
      const UInt wrap_u = shift_right<kWrapShift>(flags) & 3u, wrap_v = shift_right<kWrapShift + 2>(flags) & 3u;
      columns = {wrapped(x0, width, wrap_u), wrapped(x0 + 1.0f, width, wrap_u)};
      rows = {wrapped(y0, l.size.y, wrap_v), wrapped(y0 + 1.0f, l.size.y, wrap_v)};
    }
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        const UInt place = rows.at[row] * to_uint(width) + columns.at[column];
        l.at[row][column] = texels + place * select(l.stride == 3u, UInt(3u), UInt(1u));
      }
    }
    return l;
  }

  /// The texels of [0, size) that stand at a place of the endless plane and at the next; places and sizes are integers.
  struct Places {
    UInt at[2];
  };

  static NORRSKEN_INLINE Places repeated(Float i, Float size) {
    const Float first = inside(fnma(floor(i / size), size, i), size), next = first + 1.0f;
    return {to_uint(first), to_uint(select(next < size, next, 0.0f))};
  }

  /// The same of one place with whatever mode.
  static NORRSKEN_INLINE UInt wrapped(Float i, Float size, UInt wrap) {
    const Float clamped = min(max(i, 0.0f), size - 1.0f);
    const Float repeated = fnma(floor(i / size), size, i);
    const Float period = size + size;
    const Float within = fnma(floor(i / period), period, i);
    const Float mirrored = min(within, period - 1.0f - within);
    return to_uint(inside(select(wrap == 0u, repeated, select(wrap == 1u, mirrored, clamped)), size));
  }

  /// Far out, where floats have no fractions, and for what is no number at all: anything inside.
  static NORRSKEN_INLINE Float inside(Float place, Float size) {
    return select((place >= 0.0f) & (place <= size - 1.0f), place, 0.0f);
  }

  struct Texels {
    Color color[2][2];
  };

  /// The first word of all four first: so the memory of all is asked for before anything waits for one.
  static NORRSKEN_INLINE Texels texels(const SceneView& scene, const Lookup& l, Mask active) {
    Float words[4];
    for (int k = 0; k < 4; ++k) words[k] = gather(scene.texels, l.at[k / 2][k % 2], active);
    Texels t;
    for (int k = 0; k < 4; ++k) t.color[k / 2][k % 2] = texel(scene, l, l.at[k / 2][k % 2], words[k], active);
    return t;
  }

  /// The texel that begins at `at` with the word `first`.
  static NORRSKEN_INLINE Color texel(const SceneView& scene, const Lookup& l, UInt at, Float first, Mask active) {
    const Mask packed = active & (l.stride == 0u), floats = active & (l.stride != 0u);
    Color color = black();
    if (any(packed)) {
      const UInt bytes = bits(first);
      const auto value = [&](UInt byte) { return gather(scene.texels, l.table + (byte & 255u), packed); };
      color = {value(bytes), value(shift_right<8>(bytes)), value(shift_right<16>(bytes))};
    }
    if (any(floats)) {
      const UInt step = select(l.stride == 3u, UInt(1u), UInt(0u));
      const auto value = [&](UInt k) { return gather(scene.texels, k, floats); };
      color = select(floats, Color{first, value(at + step), value(at + step + step)}, color);
    }
    return color;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
