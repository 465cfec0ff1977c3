// Values that differ from place to place: constants, and grids whose values are interpolated.
#pragma once

#include "color/color.h"
#include "math/affine.h"
#include "math/gather.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// Along one axis: the two values on either side of a place, and how far it is from the first to the second.
struct GridPlace {
  Float first, second, fraction;
};

/// Which value of an axis stands at place `i` of a grid that goes on by `wrap`.
NORRSKEN_INLINE Float wrapped(Float i, Float size, UInt wrap) {
  const Float clamped = min(max(i, 0.0f), size - 1.0f);
  const Float repeated = fnma(floor((i + 0.5f) / size), size, i);
  const Float twice = size + size;
  const Float in_both = fnma(floor((i + 0.5f) / twice), twice, i);
  const Float mirrored = min(in_both, twice - 1.0f - in_both);
  const Float other = select(wrap == UInt(static_cast<std::uint32_t>(VolumeWrap::repeat)), repeated, mirrored);
  return select(wrap == UInt(static_cast<std::uint32_t>(VolumeWrap::clamp)), clamped, other);
}

NORRSKEN_INLINE GridPlace grid_place(Float local, Float size, UInt wrap, Mask nearest) {
  // Far beyond the grid, where its numbers end, it is all the same.
  const Float at = min(max(local * size, -1e6f), 1e6f);
  const Float shifted = select(nearest, at, at - 0.5f), low = floor(shifted);
  return {wrapped(low, size, wrap), wrapped(low + 1.0f, size, wrap), select(nearest, 0.0f, shifted - low)};
}

/// The first `n` channels at `position`; a constant, and a grid of one channel, has the same in all of them.
template <int n>
struct VolumeValues {
  Float channel[n];
};

template <int n>
NORRSKEN_INLINE VolumeValues<n> evaluate_channels(const SceneView& scene, UInt volume, const Vec3f& position,
                                                  Mask active) {
  const auto of_volume = [&](auto member) { return gather(scene.volumes, member, volume, active); };
  VolumeValues<n> values;
  const Vec3f constant = of_volume(&VolumeRecord::value);
  for (int c = 0; c < n; ++c) values.channel[c] = c % 3 == 0 ? constant.x : c % 3 == 1 ? constant.y : constant.z;
  const Float nx = of_volume(&VolumeRecord::size_x);
  const Mask grid = active & (nx > 0.0f);
  if (none(grid)) return values;

  const Float ny = of_volume(&VolumeRecord::size_y), nz = of_volume(&VolumeRecord::size_z);
  const Vec3f local = of_volume(&VolumeRecord::local_from_world).point(position);
  const UInt wrap = of_volume(&VolumeRecord::wrap), channels = of_volume(&VolumeRecord::channels);
  const Mask nearest = of_volume(&VolumeRecord::filter) == UInt(static_cast<std::uint32_t>(VolumeFilter::nearest));
  const GridPlace x = grid_place(local.x, nx, wrap, nearest), y = grid_place(local.y, ny, wrap, nearest),
                  z = grid_place(local.z, nz, wrap, nearest);
  const UInt first = of_volume(&VolumeRecord::first), row = to_uint(nx), slice = to_uint(nx) * to_uint(ny);
  const Mask several = grid & (channels != 1u);
  const int looked_up = any(several) ? n : 1;
  Float sums[n];
  for (Float& sum : sums) sum = Float(0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const bool right = (corner & 1) != 0, upper = (corner & 2) != 0, back = (corner & 4) != 0;
    const Float weight = (right ? x.fraction : 1.0f - x.fraction) * (upper ? y.fraction : 1.0f - y.fraction) *
                         (back ? z.fraction : 1.0f - z.fraction);
    const UInt place = to_uint(right ? x.second : x.first) + to_uint(upper ? y.second : y.first) * row +
                       to_uint(back ? z.second : z.first) * slice;
    const UInt at = first + place * channels;
    // Not what no part of is taken: it may be anything.
    const Mask taken = grid & (weight > 0.0f);
    if (none(taken)) continue;
    for (int c = 0; c < looked_up; ++c) {
      const UInt channel = select(several, UInt(static_cast<std::uint32_t>(c)), UInt(0u));
      sums[c] = fma(gather(scene.texels, at + channel, taken), select(taken, weight, 0.0f), sums[c]);
    }
  }
  for (int c = 0; c < n; ++c) {
    const Float found = c < looked_up ? sums[c] : sums[0];
    values.channel[c] = select(grid, found, values.channel[c]);
  }
  return values;
}

/// Not inlined: it is large, and rays are sent on between two look-ups.
__attribute__((noinline)) inline Color evaluate_volume(const SceneView& scene, UInt volume, Vec3f position,
                                                       Mask active) {
  const auto values = evaluate_channels<3>(scene, volume, position, active);
  return {values.channel[0], values.channel[1], values.channel[2]};
}

}  // namespace norrsken::NORRSKEN_ISA
