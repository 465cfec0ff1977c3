// One lane: plain floats. The debugger's view of every kernel, and the oracle that the wide ones are tested against.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "simd/isa_namespace.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr int kLanes = 1;

struct Mask {
  bool v;
  static NORRSKEN_INLINE Mask none() { return {false}; }
};

struct Float {
  float v;
  Float() = default;
  NORRSKEN_INLINE Float(float x) : v(x) {}
};

struct UInt {
  std::uint32_t v;
  UInt() = default;
  NORRSKEN_INLINE UInt(std::uint32_t x) : v(x) {}
};

NORRSKEN_INLINE Float operator+(Float a, Float b) { return a.v + b.v; }
NORRSKEN_INLINE Float operator-(Float a, Float b) { return a.v - b.v; }
NORRSKEN_INLINE Float operator*(Float a, Float b) { return a.v * b.v; }
NORRSKEN_INLINE Float operator/(Float a, Float b) { return a.v / b.v; }
NORRSKEN_INLINE Float operator-(Float a) { return -a.v; }
NORRSKEN_INLINE Mask operator<(Float a, Float b) { return {a.v < b.v}; }
NORRSKEN_INLINE Mask operator<=(Float a, Float b) { return {a.v <= b.v}; }
NORRSKEN_INLINE Mask operator>(Float a, Float b) { return {a.v > b.v}; }
NORRSKEN_INLINE Mask operator>=(Float a, Float b) { return {a.v >= b.v}; }
NORRSKEN_INLINE Mask operator==(Float a, Float b) { return {a.v == b.v}; }
NORRSKEN_INLINE Mask operator!=(Float a, Float b) { return {a.v != b.v}; }

#if defined(__FMA__) || defined(__aarch64__)
/// a * b + c, rounded once where the instruction set has it, twice where not.
NORRSKEN_INLINE Float fma(Float a, Float b, Float c) { return std::fma(a.v, b.v, c.v); }
NORRSKEN_INLINE Float fnma(Float a, Float b, Float c) { return std::fma(-a.v, b.v, c.v); }
#else
NORRSKEN_INLINE Float fma(Float a, Float b, Float c) { return a.v * b.v + c.v; }
NORRSKEN_INLINE Float fnma(Float a, Float b, Float c) { return c.v - a.v * b.v; }
#endif

NORRSKEN_INLINE Float sqrt(Float a) { return __builtin_sqrtf(a.v); }
NORRSKEN_INLINE Float abs(Float a) { return __builtin_fabsf(a.v); }
NORRSKEN_INLINE Float min(Float a, Float b) { return a.v < b.v ? a.v : b.v; }
NORRSKEN_INLINE Float max(Float a, Float b) { return a.v > b.v ? a.v : b.v; }
NORRSKEN_INLINE Float round(Float a) { return __builtin_rintf(a.v); }
NORRSKEN_INLINE Float floor(Float a) { return __builtin_floorf(a.v); }
NORRSKEN_INLINE Float copysign(Float magnitude, Float sign) { return __builtin_copysignf(magnitude.v, sign.v); }

NORRSKEN_INLINE UInt operator+(UInt a, UInt b) { return a.v + b.v; }
NORRSKEN_INLINE UInt operator-(UInt a, UInt b) { return a.v - b.v; }
NORRSKEN_INLINE UInt operator*(UInt a, UInt b) { return a.v * b.v; }
NORRSKEN_INLINE UInt operator^(UInt a, UInt b) { return a.v ^ b.v; }
NORRSKEN_INLINE UInt operator&(UInt a, UInt b) { return a.v & b.v; }
NORRSKEN_INLINE UInt operator|(UInt a, UInt b) { return a.v | b.v; }
NORRSKEN_INLINE Mask operator==(UInt a, UInt b) { return {a.v == b.v}; }
NORRSKEN_INLINE Mask operator!=(UInt a, UInt b) { return {a.v != b.v}; }
template <int n>
NORRSKEN_INLINE UInt shift_left(UInt a) {
  return a.v << n;
}
template <int n>
NORRSKEN_INLINE UInt shift_right(UInt a) {
  return a.v >> n;
}

NORRSKEN_INLINE UInt bits(Float a) { return std::bit_cast<std::uint32_t>(a.v); }
NORRSKEN_INLINE Float from_bits(UInt a) { return std::bit_cast<float>(a.v); }
/// Exact below 2^24, rounded to nearest up to 2^31.
NORRSKEN_INLINE Float to_float(UInt a) { return static_cast<float>(static_cast<std::int32_t>(a.v)); }
/// Truncates; a is in [0, 2^31).
NORRSKEN_INLINE UInt to_uint(Float a) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(a.v)); }

NORRSKEN_INLINE Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
NORRSKEN_INLINE Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
NORRSKEN_INLINE Mask operator^(Mask a, Mask b) { return {a.v != b.v}; }
NORRSKEN_INLINE Mask operator!(Mask a) { return {!a.v}; }
NORRSKEN_INLINE bool any(Mask m) { return m.v; }
NORRSKEN_INLINE bool all(Mask m) { return m.v; }
NORRSKEN_INLINE std::uint32_t count(Mask m) { return m.v ? 1u : 0u; }
/// Bit i is lane i.
NORRSKEN_INLINE std::uint32_t to_bits(Mask m) { return m.v ? 1u : 0u; }
/// The first n lanes (all of them if n >= kLanes).
NORRSKEN_INLINE Mask first_lanes(std::uint32_t n) { return {n > 0}; }

NORRSKEN_INLINE Float select(Mask m, Float a, Float b) { return m.v ? a.v : b.v; }
NORRSKEN_INLINE UInt select(Mask m, UInt a, UInt b) { return m.v ? a.v : b.v; }

NORRSKEN_INLINE UInt lane_index() { return 0u; }
NORRSKEN_INLINE Float load(const float* p) { return *p; }
NORRSKEN_INLINE UInt load_uint(const float* p) { return std::bit_cast<std::uint32_t>(*p); }
NORRSKEN_INLINE void store(float* p, Float a) { *p = a.v; }
NORRSKEN_INLINE void store(float* p, UInt a) { *p = std::bit_cast<float>(a.v); }
struct Compaction {
  Mask mask;
  std::uint32_t count;
};
NORRSKEN_INLINE Compaction make_compaction(Mask m) { return {m, count(m)}; }
NORRSKEN_INLINE void compress_store(float* p, Float a, const Compaction& c) {
  if (c.mask.v) *p = a.v;
}
/// base[index] in the active lanes, zero in the others.
NORRSKEN_INLINE Float gather(const float* base, UInt index, Mask m) { return m.v ? base[index.v] : 0.0f; }
NORRSKEN_INLINE UInt gather_uint(const float* base, UInt index, Mask m) {
  return m.v ? std::bit_cast<std::uint32_t>(base[index.v]) : 0u;
}

}  // namespace norrsken::NORRSKEN_ISA
