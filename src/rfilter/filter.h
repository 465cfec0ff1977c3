// Model       Reconstruction filters, sampled: a sample lies where it counts for one pixel, as often as the filter's
//             absolute value says, and carries the sign and the scale that the filter has to that as its weight.
// Parameters  FilterRecord and its table: the filter along one axis, piecewise linear between `nodes` from 0 to its
//             radius (it is even, and separable), scaled so that its absolute value integrates to 1 over that half.
//             Arrays, one behind the other:
//               position[nodes], value[nodes], cdf[nodes]  of the nodes, cdf that of the absolute value
//               guide[cells + 1]                           the interval that cdf = i / cells falls into
//               absolute[edges + 1], signed[edges + 1]     integrals from 0 to i + 1/2; the last ones over everything
// Measure     density of the offset over the film: |f(x)| |f(y)| over its integral
// Source      Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006; guided inversion of the cumulative
//             distribution: Chen and Asau, "On Generating Random Variates from an Empirical Distribution", 1974
// Departures  none
#pragma once

#include "math/warp.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// Where a sample of a pixel lies, from the pixel's top left corner, and what it counts. The mean weight is 1.
struct FilterSample {
  Float dx, dy, weight;
};

/// Every point of the pixel counts alike.
struct BoxFilter {
  static constexpr bool kWeighted = false;

  NORRSKEN_INLINE FilterSample sample(UInt, UInt, Vec2f u, Mask) const { return {u.x, u.y, 1.0f}; }
};

class TabulatedFilter {
 public:
  static constexpr bool kWeighted = true;

  NORRSKEN_INLINE explicit TabulatedFilter(const SceneView& scene)
      : film_(scene.film),
        position_(scene.filter),
        value_(position_ + film_.filter.nodes),
        cdf_(value_ + film_.filter.nodes),
        guide_(cdf_ + film_.filter.nodes),
        absolute_(guide_ + film_.filter.cells + 1),
        signed_(absolute_ + film_.filter.edges + 1) {}

  /// `x` and `y` count the pixels of what is rendered.
  NORRSKEN_INLINE FilterSample sample(UInt x, UInt y, Vec2f u, Mask active) const {
    const AxisSample sx = sample_axis(x, static_cast<std::uint32_t>(film_.width), u.x, active);
    const AxisSample sy = sample_axis(y, static_cast<std::uint32_t>(film_.height), u.y, active);
    return {sx.offset, sy.offset, sx.weight * sy.weight};
  }

 private:
  struct AxisSample {
    Float offset, weight;
  };

  NORRSKEN_INLINE AxisSample sample_axis(UInt pixel, std::uint32_t size, Float u, Mask active) const {
    // What the filter covers to both sides: everything, or what of it is on the film.
    const UInt everything(film_.filter.edges);
    UInt before = everything, after = everything;
    if (!film_.sample_border) {
      before = smaller(pixel, everything);
      after = smaller(UInt(size - 1) - pixel, everything);
    }
    const Float absolute_before = gather(absolute_, before, active), absolute_after = gather(absolute_, after, active);
    const Float absolute = absolute_before + absolute_after;
    const Float scale = absolute / (gather(signed_, before, active) + gather(signed_, after, active));
    const Float t = fma(u, absolute, -absolute_before);
    const AxisSample half = invert(min(abs(t), 1.0f), active);
    return {0.5f + copysign(half.offset, t), copysign(scale, half.weight)};
  }

  /// The distance from the centre where the cumulative distribution is t, in [0, 1]; the weight has the filter's sign.
  NORRSKEN_INLINE AxisSample invert(Float t, Mask active) const {
    const UInt cell = to_uint(t * Float(static_cast<float>(film_.filter.cells)));
    UInt low = gather_uint(guide_, smaller(cell, UInt(film_.filter.cells - 1)), active);
    UInt high = gather_uint(guide_ + 1, smaller(cell, UInt(film_.filter.cells - 1)), active) + 1u;
    while (any(active & (low + 1u != high))) {
      const UInt middle = shift_right<1>(low + high);
      const Mask below = gather(cdf_, middle, active) <= t;
      low = select(below, middle, low);
      high = select(below, high, middle);
    }
    const Float x0 = gather(position_, low, active), x1 = gather(position_ + 1, low, active);
    const Float f0 = gather(value_, low, active), f1 = gather(value_ + 1, low, active);
    // From an interval of width w whose density goes from a to b: s w with a s + (b - a) s^2 / 2 = q, where q w is the
    // probability that is left.
    const Float a = abs(f0), b = abs(f1), w = x1 - x0;
    const Float q = max((t - gather(cdf_, low, active)) / w, 0.0f);
    const Float root = sqrt(max(fma(a, a, 2.0f * (b - a) * q), 0.0f));
    const Float s = min((q + q) / max(a + root, 1e-30f), 1.0f);
    return {fma(s, w, x0), f0 + f1};
  }

  /// Counts below 2^24, of which floats tell the smaller.
  static NORRSKEN_INLINE UInt smaller(UInt a, UInt b) { return select(to_float(a) < to_float(b), a, b); }

  const FilmSettings& film_;
  const float *position_, *value_, *cdf_, *guide_, *absolute_, *signed_;
};

}  // namespace norrsken::NORRSKEN_ISA
