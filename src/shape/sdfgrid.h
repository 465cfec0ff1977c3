// Model       The surface where values on a grid that fills the cube [0, 1]^3, interpolated trilinearly, change between
//             negative (inside) and not negative (outside). Its normals point to where the values grow.
// Parameters  none: the place and the table say the rest
// Measure     none: its area is not sampled, so as a light only rays find it
// Source      Hansson-Söderlund, Evans, Akenine-Möller, "Ray Tracing of Signed Distance Function Grids", JCGT 11(3),
//             2022, sections on normals: the interpolation's gradient, and the blend of the gradients of the eight voxels
//             around the nearest value (the dual voxel) that has no steps between voxels.
//             A voxel's gradient is, as in Mitsuba 3, that of the interpolation along each axis between the voxel's two
//             faces, at the place of the point along the other two.
// Departures  Voxels beyond any border of the grid have no part in the blend; in Mitsuba those beyond the upper borders
//             do. There are no texture coordinates and no tangents, as in Mitsuba.
#pragma once

#include "shape/shape.h"

namespace norrsken {

/// Where things are in the shape's table. The voxels are those that the surface crosses: one word each, the number of the
/// value at the lowest corner.
struct SdfGridTable {
  static constexpr std::uint32_t kSize = 0;    ///< words: values along x, y and z, 2 or more
  static constexpr std::uint32_t kSmooth = 3;  ///< word: 1 if shading normals are blended
  static constexpr std::uint32_t kValues = 4;  ///< x varies fastest, then y, then z; the voxels are behind them
};

}  // namespace norrsken

namespace norrsken::NORRSKEN_ISA {

struct SdfGridShape {
  static NORRSKEN_INLINE LocalSurface surface_at(const ElementReader& table, const Vec3f& p) {
    const UInt size[3] = {table.word(UInt(SdfGridTable::kSize)), table.word(UInt(SdfGridTable::kSize + 1)),
                          table.word(UInt(SdfGridTable::kSize + 2))};
    const Axis axes[3] = {make_axis(size[0], 1u, p.x), make_axis(size[1], size[0], p.y),
                          make_axis(size[2], size[0] * size[1], p.z)};
    const UInt first = UInt(SdfGridTable::kValues) + axes[0].offset() + axes[1].offset() + axes[2].offset();
    Float corners[8];
    for (int i = 0; i < 8; ++i) {
      UInt at = first;
      for (int a = 0; a < 3; ++a) at += UInt((i >> a) & 1 ? 1u : 0u) * axes[a].stride;
      corners[i] = table.number(at);
    }

    // The interpolation on the voxel's two faces across each axis.
    Float low[3], high[3], gradient[3];
    for (int a = 0; a < 3; ++a) {
      low[a] = across(axes, a, [&](int corner) { return corners[corner]; });
      high[a] = across(axes, a, [&](int corner) { return corners[corner | (1 << a)]; });
      gradient[a] = (high[a] - low[a]) * axes[a].voxels;
    }
    const Scaled own = unit_vector({gradient[0], gradient[1], gradient[2]});
    const Vec3f z{0.0f, 0.0f, 1.0f};
    const Vec3f normal = select(own.found, own.unit, z);

    // One step of Newton's method, of at most half a voxel: where the gradient all but vanishes it says little.
    const Float value = lerp(low[2], high[2], axes[2].within);
    const Float limit = 0.5f / max(axes[0].voxels, max(axes[1].voxels, axes[2].voxels));
    const Float step = select(own.found, min(max(value / own.length, -limit), limit), 0.0f);

    const Vec3f zero{0.0f, 0.0f, 0.0f};
    LocalSurface s{fma(normal, -step, p), normal, {0.0f, 0.0f}, zero, zero};
    const Mask smooth = table.active & (table.word(UInt(SdfGridTable::kSmooth)) != 0u);
    if (any(smooth)) {
      const Scaled blended = unit_vector(blend(table, first, axes, low, high, gradient, smooth));
      s.shading = select(smooth & blended.found, blended.unit, normal);
    }
    return s;
  }

 private:
  /// Where a point is along one axis.
  struct Axis {
    UInt stride;   ///< of the values
    Float voxels;  ///< how many there are
    Float voxel;   ///< that the point is in
    Float within;  ///< from its lower face, 0, to its upper, 1

    NORRSKEN_INLINE UInt offset() const { return to_uint(voxel) * stride; }
  };
  static NORRSKEN_INLINE Axis make_axis(UInt size, UInt stride, Float x) {
    const Float zero(0.0f), one(1.0f);
    const Float voxels = to_float(size - 1u);
    const Float at = x * voxels;
    const Float voxel = max(min(floor(at), voxels - one), zero);
    return {stride, voxels, voxel, max(min(at - voxel, one), zero)};
  }

  static NORRSKEN_INLINE Float lerp(Float a, Float b, Float w) { return fma(w, b - a, a); }

  /// Interpolates bilinearly at the point's place along the two axes other than `a`; `value` knows corners by number.
  template <class Value>
  static NORRSKEN_INLINE Float across(const Axis axes[3], int a, const Value& value) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    return lerp(lerp(value(0), value(1 << b), axes[b].within),
                lerp(value(1 << c), value((1 << b) | (1 << c)), axes[b].within), axes[c].within);
  }

  struct Scaled {
    Vec3f unit;
    Float length;
    Mask found;  ///< false: too short to have a direction
  };
  /// Of vectors whose squares may be no floats.
  static NORRSKEN_INLINE Scaled unit_vector(const Vec3f& v) {
    constexpr float kLeast = 0x1p-120f;
    const Float size = largest(v);
    const Mask found = size > Float(kLeast);
    const Vec3f scaled = v * (1.0f / select(found, size, 1.0f));
    const Float length = select(found, sqrt(dot(scaled, scaled)), 1.0f);
    return {scaled * (1.0f / length), size * length, found};
  }

  /// The unit gradients of the voxels around the value that is nearest to the point, weighted by how near the voxels'
  /// centres are. The point's own voxel is one of them; along each axis there is one other.
  static NORRSKEN_INLINE Vec3f blend(const ElementReader& table, UInt first, const Axis axes[3], const Float low[3],
                                     const Float high[3], const Float own[3], Mask active) {
    const Float half(0.5f), one(1.0f);
    Float other[3], weight[3];
    for (int a = 0; a < 3; ++a) {
      const Axis& axis = axes[a];
      const Mask above = axis.within >= half, below = !above;
      const Mask exists = (above & (axis.voxel + one < axis.voxels)) | (below & (axis.voxel > 0.0f));
      const ElementReader there{table.table, table.offset, table.element, active & exists};
      const UInt face = select(above, first + axis.stride * 2u, first - axis.stride);
      const Float far = across(axes, a, [&](int corner) {
        UInt at = face;
        for (int k = 0; k < 3; ++k) at += UInt((corner >> k) & 1 ? 1u : 0u) * axes[k].stride;
        return there.number(at);
      });
      other[a] = select(exists, select(above, far - high[a], low[a] - far) * axis.voxels, own[a]);
      weight[a] = select(exists, one - abs(axis.within - half), one);
    }
    Vec3f sum{0.0f, 0.0f, 0.0f};
    for (int i = 0; i < 8; ++i) {
      const Scaled n = unit_vector(
          {(i & 1) != 0 ? other[0] : own[0], (i & 2) != 0 ? other[1] : own[1], (i & 4) != 0 ? other[2] : own[2]});
      Float w = one;
      for (int a = 0; a < 3; ++a) w *= ((i >> a) & 1) != 0 ? one - weight[a] : weight[a];
      sum = fma(n.unit, zero_unless(n.found, w), sum);
    }
    return sum;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
