// Sine and cosine where sampling needs them.
#pragma once

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

struct SinCos {
  Float sin, cos;
};

/// sin and cos of x in [-pi/4, pi/4]; Taylor polynomials to x^9 and x^10, error below 2^-23.
NORRSKEN_INLINE SinCos sin_cos_quarter(Float x) {
  const Float x2 = x * x;
  Float s = fma(x2, Float(1.0f / 362880.0f), Float(-1.0f / 5040.0f));
  s = fma(s, x2, Float(1.0f / 120.0f));
  s = fma(s, x2, Float(-1.0f / 6.0f));
  Float c = fma(x2, Float(-1.0f / 3628800.0f), Float(1.0f / 40320.0f));
  c = fma(c, x2, Float(-1.0f / 720.0f));
  c = fma(c, x2, Float(1.0f / 24.0f));
  c = fma(c, x2, -0.5f);
  return {fma(s * x2, x, x), fma(c, x2, 1.0f)};
}

/// sin and cos of 2 pi u, u in [0, 1].
NORRSKEN_INLINE SinCos sin_cos_turns(Float u) {
  const Float quadrant = round(u * 4.0f);
  const SinCos q = sin_cos_quarter((fma(u, 4.0f, -quadrant)) * 1.57079632679f);
  const UInt k = to_uint(quadrant);
  const Mask odd = (k & 1u) == 1u;
  const Float s = select(odd, q.cos, q.sin), c = select(odd, q.sin, q.cos);
  // Quadrants 2 and 3 negate the sine, 1 and 2 the cosine.
  const UInt sin_sign = shift_left<30>(k & 2u);
  const UInt cos_sign = shift_left<30>((k + 1u) & 2u);
  return {from_bits(bits(s) ^ sin_sign), from_bits(bits(c) ^ cos_sign)};
}

}  // namespace norrsken::NORRSKEN_ISA
