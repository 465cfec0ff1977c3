// Exponentials, inverse trigonometric and error functions of lanes: full lanes, no branches, no approximate
// instructions.
//
// Polynomials are minimax fits (Lawson's reweighted least squares, in 40 digits) of the function that the line says,
// over the interval that the reduction leaves. Errors are in units of the result's last place (ulp), measured over
// dense ranges by special_test.cpp on every instruction set.
// NaN comes out where NaN goes in.
#pragma once

#include <limits>

#include "math/trig.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr float kInf = std::numeric_limits<float>::infinity();

/// c0 + c1 x + c2 x^2 ..., by Horner's rule.
template <class... Rest>
NORRSKEN_INLINE Float polynomial(Float x, float c0, Rest... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return Float(c0);
  } else {
    return fma(polynomial(x, rest...), x, Float(c0));
  }
}

/// Within 1 ulp (1 of the smallest normal's where the result is subnormal); 0 below -104, infinite above 88.73.
NORRSKEN_INLINE Float exp(Float x) {
  // The constants come first: a NaN in x passes.
  const Float clamped = min(89.0f, max(-104.0f, x));
  const Float n = round(clamped * 1.442695041f);
  // ln 2 in two parts, the first so short that its product with n is exact (Cody and Waite).
  const Float r = fnma(n, 1.42860677e-6f, fnma(n, 0.693145751953125f, clamped));
  // (e^r - 1 - r) / r^2
  const Float p = polynomial(r, 0.4999999403953552f, 0.16666515171527863f, 0.04166845604777336f, 0.008369418792426586f,
                             0.0013813142431899905f);
  const Float e = fma(r * r, p, r) + 1.0f;
  // 2^n as two factors: neither is out of range, so large results overflow and small ones fade out as they should.
  const UInt biased = to_uint(n + 256.0f);
  const UInt first = shift_right<1>(biased), second = biased - first;
  const auto power = [](UInt k) { return from_bits(shift_left<23>(k - 1u)); };
  return e * power(first) * power(second);
}

/// Within 1 ulp; log(0) is minus infinity, NaN below.
NORRSKEN_INLINE Float log(Float x) {
  const Mask subnormal = x < 0x1p-126f;
  const Float scaled = select(subnormal, x * 0x1p23f, x);
  // x = 2^e (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)).
  constexpr std::uint32_t kSqrtHalf = 0x3f3504f3u, kOne = 0x3f800000u;
  const UInt shifted = bits(scaled) + UInt(kOne - kSqrtHalf);
  const Float e = to_float(shift_right<23>(shifted)) - select(subnormal, Float(150.0f), Float(127.0f));
  const Float f = from_bits((shifted & UInt(0x7fffffu)) + kSqrtHalf) - 1.0f;
  // log(1 + f) = 2 atanh(s) = f - (f^2/2 - s (f^2/2 + R)) with R = 2 atanh(s)/s - 2 (the arrangement of fdlibm's log).
  const Float s = f / (2.0f + f), s2 = s * s;
  const Float r = s2 * polynomial(s2, 0.6666678190231323f, 0.3997707962989807f, 0.2988519072532654f);
  const Float half_f2 = 0.5f * f * f;
  const Float low = fma(s, half_f2 + r, e * 1.42860677e-6f);
  const Float value = fma(e, 0.693145751953125f, f - (half_f2 - low));
  const Float edge = select(x == 0.0f, Float(-kInf), Float(std::numeric_limits<float>::quiet_NaN()));
  return select(x > 0.0f, select(x < Float(kInf), value, x), edge);
}

/// x^y for x >= 0. Within 1 + 2 |y log x| ulp: the exponential magnifies the logarithm's rounding.
NORRSKEN_INLINE Float pow(Float x, Float y) { return select(y == 0.0f, 1.0f, exp(y * log(x))); }

/// The angle of (x, y) in [-pi, pi], of finite x and y; within 3 ulp. atan2(0, 0) is 0.
NORRSKEN_INLINE Float atan2(Float y, Float x) {
  const Float ax = abs(x), ay = abs(y);
  const Float lower = min(ax, ay), upper = max(ax, ay);
  // Beyond pi/8: atan(q) = pi/4 + atan((q - 1) / (q + 1)), taken before the one division.
  const Mask beyond = lower > upper * 0.41421356f;
  const Float divisor = select(beyond, lower + upper, upper);
  const Float q = select(beyond, lower - upper, lower) / select(divisor == 0.0f, 1.0f, divisor);
  const Float q2 = q * q;
  // atan(q)/q - 1, in q^2
  const Float p = q2 * polynomial(q2, -0.33333316445350647f, 0.1999848335981369f, -0.1424373835325241f,
                                  0.10595136135816574f, -0.06081148236989975f);
  const Float octant = fma(q, p, q) + select(beyond, Float(0.785398163f), Float(0.0f));
  const Float quadrant = select(ay > ax, 1.57079633f - octant, octant);
  return copysign(select(x < 0.0f, 3.14159265f - quadrant, quadrant), y);
}

/// asin of a where a = |x| <= 1/2; above, asin of sqrt((1 - a) / 2), which is (pi/2 - asin a) / 2.
struct HalfArcsine {
  Float value;
  Mask folded;
};
NORRSKEN_INLINE HalfArcsine half_arcsine(Float x) {
  const Float a = min(1.0f, abs(x));
  const Mask folded = a > 0.5f;
  const Float s2 = select(folded, fnma(a, Float(0.5f), Float(0.5f)), a * a);
  const Float s = select(folded, sqrt(s2), a);
  // asin(s)/s - 1, in s^2
  const Float p = s2 * polynomial(s2, 0.16666659712791443f, 0.07500512152910233f, 0.044515471905469894f,
                                  0.031819820404052734f, 0.014393805526196957f, 0.03757815808057785f);
  return {fma(s, p, s), folded};
}

/// Within 1.5 ulp; arguments beyond [-1, 1] are taken for its ends.
NORRSKEN_INLINE Float acos(Float x) {
  const HalfArcsine h = half_arcsine(x);
  const Float twice = h.value + h.value;
  const Float above = select(x < 0.0f, 3.14159265f - twice, twice);
  return select(h.folded, above, 1.57079633f - copysign(h.value, x));
}

/// Within 3 ulp; arguments beyond [-1, 1] are taken for its ends.
NORRSKEN_INLINE Float asin(Float x) {
  const HalfArcsine h = half_arcsine(x);
  return copysign(select(h.folded, 1.57079633f - (h.value + h.value), h.value), x);
}

/// 2/sqrt(pi) times the integral of exp(-t^2) from 0 to x; within 1.5 ulp.
NORRSKEN_INLINE Float erf(Float x) {
  const Float a = abs(x), x2 = x * x;
  // erf(x)/x - 1, in x^2
  const Float p =
      polynomial(x2, 0.12837916612625122f, -0.37612634897232056f, 0.11283719539642334f, -0.026860753074288368f,
                 0.005204435903578997f, -0.0008181927260011435f, 8.53883902891539e-05f);
  // -log(1 - erf(a)), in a; from 4 on, erf rounds to 1
  const Float q =
      polynomial(min(4.0f, a), 0.00017748723621480167f, 1.1277495622634888f, 0.6370596885681152f, 0.10403741896152496f,
                 -0.022277116775512695f, 0.003055615583434701f, -0.00019718262774404138f);
  return select(a < 0.9f, fma(x, p, x), copysign(1.0f - exp(-q), x));
}

/// The x of which erf(x) = y, y in [-1, 1]; within 4 ulp. The ends give infinities.
/// Source of the reduction: Giles, "Approximating the erfinv function", 2012.
NORRSKEN_INLINE Float erf_inv(Float y) {
  const Float w = -log((1.0f - y) * (1.0f + y));
  // erf_inv(y)/y, in w - 2.5 below w = 5, in sqrt(w) - 3 above
  const Float near = polynomial(w - 2.5f, 1.5014094114303589f, 0.24664072692394257f, -0.004177707713097334f,
                                -0.001253707567229867f, 0.00021860218839719892f, -4.396781150717288e-06f,
                                -3.5288594517624006e-06f, 3.43727066365318e-07f, 2.8534790530443388e-08f);
  const Float far =
      polynomial(sqrt(max(w, 5.0f)) - 3.0f, 2.832977056503296f, 1.0016745328903198f, 0.009432901628315449f,
                 -0.007630494888871908f, 0.0057787811383605f, -0.0036411555483937263f, 0.0012643286027014256f,
                 6.771488551748917e-05f, -0.00013984281395096332f);
  const Float value = y * select(w < 5.0f, near, far);
  const Mask end = abs(y) == 1.0f;
  return select(end, copysign(Float(kInf), y), value);
}

}  // namespace norrsken::NORRSKEN_ISA
