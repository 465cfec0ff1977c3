// Three components of any number type: of `float` on the host, of lanes in kernels.
#pragma once

#include <type_traits>

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

template <class F>
struct Vec3 {
  F x, y, z;
};

using Vec3f = Vec3<Float>;

template <class F>
NORRSKEN_INLINE Vec3<F> operator+(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
NORRSKEN_INLINE Vec3<F> operator-(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
NORRSKEN_INLINE Vec3<F> operator-(const Vec3<F>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class F>
NORRSKEN_INLINE Vec3<F> operator*(const Vec3<F>& a, std::type_identity_t<F> s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class F>
NORRSKEN_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
template <class F>
NORRSKEN_INLINE Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {fms(a.y, b.z, a.z * b.y), fms(a.z, b.x, a.x * b.z), fms(a.x, b.y, a.y * b.x)};
}
/// a * s + b
template <class F>
NORRSKEN_INLINE Vec3<F> fma(const Vec3<F>& a, F s, const Vec3<F>& b) {
  return {fma(a.x, s, b.x), fma(a.y, s, b.y), fma(a.z, s, b.z)};
}
template <class F>
NORRSKEN_INLINE Vec3<F> normalize(const Vec3<F>& a) {
  return a * (F(1.0f) / sqrt(dot(a, a)));
}

/// What to hand to a function that is not inlined: made component by component, so that GCC keeps the original in
/// registers (docs/dev/lanes.md).
NORRSKEN_INLINE Vec3f copied(const Vec3f& a) { return {a.x, a.y, a.z}; }

/// The largest absolute component.
NORRSKEN_INLINE Float largest(const Vec3f& a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }

/// A point that was computed lies off its surface, and the next intersection with that surface is off, by a few ulps of
/// the largest coordinate that takes part; 64 of them leave room for the triangle tests of every intersector.
inline constexpr float kOffsetUlps = 64.0f * 0x1p-24f;

NORRSKEN_INLINE Vec3f select(Mask m, const Vec3f& a, const Vec3f& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
NORRSKEN_INLINE Vec3f broadcast(const float v[3]) { return {Float(v[0]), Float(v[1]), Float(v[2])}; }
/// base[index], base[index + 1], base[index + 2]
NORRSKEN_INLINE Vec3f gather3(const float* base, UInt index, Mask active) {
  return {gather(base, index, active), gather(base + 1, index, active), gather(base + 2, index, active)};
}

}  // namespace norrsken::NORRSKEN_ISA
