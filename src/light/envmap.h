// Model       The radiance around the scene from an image in latitude-longitude format, interpolated bilinearly: its
//             columns go around the local y axis, its first row is at +y, its last at -y, its first column at -z, its middle at +z.
// Measure     pdf_sa: proportional to the interpolated product of luminance and the rows' sine of the polar angle; a
//             patch between four texels by inverting its row's and its column's distribution, a point in it by inverting
//             the two linear densities. With MIS compensation the luminance is what exceeds its mean
// Source      mapping: Mitsuba 3, emitter `envmap`; inversion with a guide: Chen and Asau, "On Generating Random Variates
//             from an Empirical Distribution", 1974; linear densities: Pharr, Jakob, Humphreys, "Physically Based
//             Rendering", 4th ed., section A.4.1; Karlik, Sik, Vevoda, Skrivan, Krivanek, "MIS Compensation: Optimizing
//             Sampling Techniques in Multiple Importance Sampling", 2019
// Departures  the mean luminance is that over all directions, where Mitsuba's is over all pixels; at the poles the sine is that of a quarter of a row, not 0, so that no light there has density 0
#pragma once

#include <bit>

#include "color/srgb.h"
#include "light/emit.h"
#include "math/special.h"

namespace norrsken::NORRSKEN_ISA {

/// edge1, edge2 and normal are the local axes, `emission` the scale. There is one such light, so its parameters are
/// scalars; src/light/envmap.cpp fills them.
struct EnvmapEnvironment {
  /// Cumulated probabilities of the cells of one dimension, the first 0, the last 1; behind them, for each number k of a
  /// power of two (and 1 more), the cell that k / guide_size falls into.
  struct Distribution {
    std::uint32_t cells, guide_size;
  };
  struct Stored {
    std::uint32_t texels, rows, columns;  ///< offsets: of the two first among the texels; else as in Map
    Distribution row, column;
    float density_scale, darkest;
  };
  struct Map {
    const float* texels;    ///< 3 floats each
    const float* rows;      ///< a Distribution of the patches' rows
    std::uint32_t columns;  ///< offset from `rows` of the Distributions of the patches in each row
    Distribution row, column;
    float density_scale;  ///< from weight to density on the unit square, over 2 pi^2
    float darkest;        ///< luminance up to which density is 0
  };
  static NORRSKEN_INLINE Map load(const SceneView& scene) {
    const float* first = scene.parameters + scene.lights[scene.environment].parameters;
    std::array<float, sizeof(Stored) / sizeof(float)> block;
    for (std::size_t i = 0; i < block.size(); ++i) block[i] = first[i];
    const Stored s = std::bit_cast<Stored>(block);
    return {scene.texels + s.texels, scene.texels + s.rows, s.columns, s.row, s.column, s.density_scale, s.darkest};
  }

  /// The four texels around a place, and where between them it is.
  struct Patch {
    Color color[2][2];  ///< [row][column]
    Float weight[2][2];
  };
  static NORRSKEN_INLINE Patch load_patch(const Map& map, Float column, Float row, Mask active) {
    const float width = static_cast<float>(map.column.cells), last_row = static_cast<float>(map.row.cells);
    const Float next = column + 1.0f;
    const UInt columns[2] = {to_uint(column), to_uint(select(next < Float(width), next, 0.0f))};
    const auto share = [](int k) { return Float(static_cast<float>(kSrgbLuminance[k])); };
    UInt at[2][2];
    for (int r = 0; r < 2; ++r) {
      const UInt first = to_uint(row + Float(static_cast<float>(r))) * UInt(map.column.cells);
      for (int c = 0; c < 2; ++c) at[r][c] = (first + columns[c]) * 3u;
    }
    Patch patch;
    // Component by component: the memory of all four is asked for before anything waits for one.
    for (int k = 0; k < 4; ++k) patch.color[k / 2][k % 2].r = gather(map.texels, at[k / 2][k % 2], active);
    for (int k = 0; k < 4; ++k) patch.color[k / 2][k % 2].g = gather(map.texels + 1, at[k / 2][k % 2], active);
    for (int k = 0; k < 4; ++k) patch.color[k / 2][k % 2].b = gather(map.texels + 2, at[k / 2][k % 2], active);
    for (int r = 0; r < 2; ++r) {
      const Float y = row + Float(static_cast<float>(r));
      const Float inside = min(max(y, 0.25f), Float(last_row - 0.25f));
      const Float sine = sin_cos_turns(inside * Float(0.5f / last_row)).sin;
      for (int c = 0; c < 2; ++c) {
        const Color& color = patch.color[r][c];
        const Float luminance = fma(color.r, share(0), fma(color.g, share(1), color.b * share(2)));
        patch.weight[r][c] = max(luminance - Float(map.darkest), 0.0f) * sine;
      }
    }
    return patch;
  }
  template <class T>
  static NORRSKEN_INLINE T mix(const T& a, const T& b, Float t) {
    return a * (1.0f - t) + b * t;
  }
  template <class T>
  static NORRSKEN_INLINE T mix(const T (&v)[2][2], Vec2f at) {
    return mix(mix(v[0][0], v[0][1], at.x), mix(v[1][0], v[1][1], at.x), at.y);
  }
  static NORRSKEN_INLINE Float density(const Map& map, const Patch& patch, Vec2f at, Float sin_theta) {
    return mix(patch.weight, at) * Float(map.density_scale) / max(sin_theta, 0x1p-40f);
  }

  /// The cell that u falls into, and how far into it, in [0, 1).
  struct Cell {
    UInt index;
    Float inside;
  };
  /// `base` is at the first cumulated probability, the lanes' tables at `offset` behind it.
  static NORRSKEN_INLINE Cell invert(const float* base, UInt offset, Distribution d, Float u, Mask active) {
    // Exact, because the guide's size is a power of two.
    const UInt step = offset + UInt(d.cells + 1) + to_uint(u * Float(static_cast<float>(d.guide_size)));
    UInt low = gather_uint(base, step, active), high = gather_uint(base + 1, step, active);
    for (Mask open = active & (low != high); any(open); open = active & (low != high)) {
      const UInt middle = shift_right<1>(low + high);
      const Mask before = u < gather(base + 1, offset + middle, open);
      low = select(open & !before, middle + 1u, low);
      high = select(open & before, middle, high);
    }
    const Float begin = gather(base, offset + low, active), end = gather(base + 1, offset + low, active);
    return {low, min((u - begin) / max(end - begin, 0x1p-126f), 0x1.fffffep-1f)};
  }

  /// x of density proportional to a (1 - x) + b x.
  static NORRSKEN_INLINE Float sample_linear(Float u, Float a, Float b) {
    const Float root = sqrt(mix(a * a, b * b, u));
    return min(u * (a + b) / max(a + root, 0x1p-126f), 1.0f);
  }

  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    const Map map = load(scene);
    const Cell row = invert(map.rows, 0u, map.row, u.y, active);
    const UInt columns = UInt(map.columns) + row.index * UInt(map.column.cells + map.column.guide_size + 2);
    const Cell column = invert(map.rows, columns, map.column, u.x, active);
    const Float i = to_float(column.index), j = to_float(row.index);
    const Patch patch = load_patch(map, i, j, active);
    const auto& w = patch.weight;
    Vec2f at;
    at.y = sample_linear(row.inside, w[0][0] + w[0][1], w[1][0] + w[1][1]);
    at.x = sample_linear(column.inside, mix(w[0][0], w[1][0], at.y), mix(w[0][1], w[1][1], at.y));

    const Float turns = (i + at.x + 0.5f) * Float(1.0f / static_cast<float>(map.column.cells));
    const SinCos phi = sin_cos_turns(turns - floor(turns));
    const SinCos theta = sin_cos_turns((j + at.y) * Float(0.5f / static_cast<float>(map.row.cells)));
    const Vec3f direction =
        fma(light.edge1, phi.sin * theta.sin, fma(light.edge2, theta.cos, light.normal * (-phi.cos * theta.sin)));
    const Float pdf = density(map, patch, at, theta.sin);
    return {fma(direction, distance_to_lights_around(scene), reference), pdf, light.emission * mix(patch.color, at),
            active & (pdf > 0.0f)};
  }

  /// What lies in a direction of the world.
  struct Place {
    Patch patch;
    Vec2f at;
    Float sin_theta;
  };
  static NORRSKEN_INLINE Place look_up(const Map& map, const Light& light, const Vec3f& direction, Mask active) {
    const Float x = dot(light.edge1, direction), y = dot(light.edge2, direction), z = dot(light.normal, direction);
    const Float width(static_cast<float>(map.column.cells)), last_row(static_cast<float>(map.row.cells));
    const Float sin_theta = sqrt(fma(x, x, z * z));
    const Float u = fma(atan2(x, -z), Float(0.5f * kInvPi) * width, -0.5f);
    const Float v = min(atan2(sin_theta, y) * kInvPi * last_row, last_row);
    const Float column = floor(u), row = min(floor(v), last_row - 1.0f);
    const Float wrapped = select(column < 0.0f, column + width, column);
    return {load_patch(map, wrapped, row, active), {u - column, v - row}, sin_theta};
  }

  static NORRSKEN_INLINE SeenLight seen(const SceneView& scene, const Light& light, const Vec3f& direction,
                                        Mask active) {
    const Map map = load(scene);
    const Place place = look_up(map, light, direction, active);
    return {light.emission * mix(place.patch.color, place.at), density(map, place.patch, place.at, place.sin_theta)};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView& scene, const Light& light, const Vec3f&, const Vec3f& direction,
                                      Float, Mask active) {
    return seen(scene, light, direction, active).pdf_sa;
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    return emit_from_afar<EnvmapEnvironment>(scene, light, position, direction, active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
