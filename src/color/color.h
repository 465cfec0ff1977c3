// Light in kernels: radiance, throughput, reflectance, emission, as red, green and blue of linear sRGB. No direction can
// stand in its place, and what knows how many channels there are, and which, is here and in tables/records.def.
#pragma once

#include "math/vec3.h"

namespace norrsken::NORRSKEN_ISA {

struct Color {
  Float r, g, b;
};

NORRSKEN_INLINE Color grey(Float a) { return {a, a, a}; }
NORRSKEN_INLINE Color black() { return grey(0.0f); }
NORRSKEN_INLINE Color white() { return grey(1.0f); }

NORRSKEN_INLINE Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
NORRSKEN_INLINE Color operator-(const Color& a, const Color& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
NORRSKEN_INLINE Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
NORRSKEN_INLINE Color operator*(const Color& a, Float s) { return {a.r * s, a.g * s, a.b * s}; }
/// a * s + b
NORRSKEN_INLINE Color fma(const Color& a, Float s, const Color& b) {
  return {fma(a.r, s, b.r), fma(a.g, s, b.g), fma(a.b, s, b.b)};
}
/// From a, where t is 0, to b.
NORRSKEN_INLINE Color mix(const Color& a, const Color& b, Float t) { return fma(b - a, t, a); }

NORRSKEN_INLINE Color select(Mask m, const Color& a, const Color& b) {
  return {select(m, a.r, b.r), select(m, a.g, b.g), select(m, a.b, b.b)};
}
NORRSKEN_INLINE Float max_component(const Color& a) { return max(a.r, max(a.g, a.b)); }
/// Finite where all channels are.
NORRSKEN_INLINE Float sum_of(const Color& a) { return a.r + a.g + a.b; }

/// For the numbers that textures of three channels stand for.
NORRSKEN_INLINE Float luminance(const Color& c) { return fma(c.r, 0.212671f, fma(c.g, 0.715160f, c.b * 0.072169f)); }

/// What to hand to a function that is not inlined: see Vec3f's.
NORRSKEN_INLINE Color copied(const Color& a) { return {a.r, a.g, a.b}; }

// Out of tables of floats.
NORRSKEN_INLINE Color broadcast_color(const float v[3]) { return {v[0], v[1], v[2]}; }
/// base[index], base[index + 1], base[index + 2]
NORRSKEN_INLINE Color gather_color(const float* base, UInt index, Mask active) {
  return {gather(base, index, active), gather(base + 1, index, active), gather(base + 2, index, active)};
}

}  // namespace norrsken::NORRSKEN_ISA
