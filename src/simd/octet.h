// Eight values at once, for what is eight wide whatever the register: the children of a node, the triangles of a block.
// One register from AVX2 on, two for SSE4.2 and NEON, eight values of one lane each otherwise.
//
// No operation rounds twice or fuses two, so the results have the same bits in every instruction set.
#pragma once

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr std::uint32_t kOctetLanes = 8;

#if NORRSKEN_LANES >= 8

using OctetTag = hn::FixedTag<float, 8>;

struct OctetMask {
  hn::Mask<OctetTag> v;
};

struct Octet {
  hn::Vec<OctetTag> v;
  Octet() = default;
  NORRSKEN_INLINE Octet(float x) : v(hn::Set(OctetTag(), x)) {}
  NORRSKEN_INLINE Octet(hn::Vec<OctetTag> x) : v(x) {}
};

NORRSKEN_INLINE Octet operator+(Octet a, Octet b) { return hn::Add(a.v, b.v); }
NORRSKEN_INLINE Octet operator-(Octet a, Octet b) { return hn::Sub(a.v, b.v); }
NORRSKEN_INLINE Octet operator*(Octet a, Octet b) { return hn::Mul(a.v, b.v); }
NORRSKEN_INLINE Octet operator/(Octet a, Octet b) { return hn::Div(a.v, b.v); }
NORRSKEN_INLINE Octet min(Octet a, Octet b) { return hn::Min(a.v, b.v); }
NORRSKEN_INLINE Octet max(Octet a, Octet b) { return hn::Max(a.v, b.v); }
NORRSKEN_INLINE OctetMask operator<(Octet a, Octet b) { return {hn::Lt(a.v, b.v)}; }
NORRSKEN_INLINE OctetMask operator<=(Octet a, Octet b) { return {hn::Le(a.v, b.v)}; }
NORRSKEN_INLINE OctetMask operator!=(Octet a, Octet b) { return {hn::Not(hn::Eq(a.v, b.v))}; }
NORRSKEN_INLINE OctetMask operator&(OctetMask a, OctetMask b) { return {hn::And(a.v, b.v)}; }
NORRSKEN_INLINE OctetMask operator|(OctetMask a, OctetMask b) { return {hn::Or(a.v, b.v)}; }
/// Bit i is lane i.
NORRSKEN_INLINE std::uint32_t to_bits(OctetMask m) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(OctetTag(), m.v, bits);
  return bits[0];
}
NORRSKEN_INLINE Octet load_octet(const float* p) { return hn::Load(OctetTag(), p); }
NORRSKEN_INLINE void store_octet(float* p, Octet a) { hn::Store(a.v, OctetTag(), p); }

#else

/// Twice what one half has.
template <class Half>
struct Two {
  Half low, high;
  Two() = default;
  NORRSKEN_INLINE Two(float x) : low(x), high(x) {}
  NORRSKEN_INLINE Two(Half l, Half h) : low(l), high(h) {}
};

template <class Half>
struct TwoMasks {
  Half low, high;
  NORRSKEN_INLINE TwoMasks(Half l, Half h) : low(l), high(h) {}
};

#define NORRSKEN_OCTET_OF_HALVES(Name, Result, Argument)                        \
  template <class Half>                                                         \
  NORRSKEN_INLINE auto Name(const Argument<Half>& a, const Argument<Half>& b) { \
    return Result{Name(a.low, b.low), Name(a.high, b.high)};                    \
  }
NORRSKEN_OCTET_OF_HALVES(operator+, Two, Two)
NORRSKEN_OCTET_OF_HALVES(operator-, Two, Two)
NORRSKEN_OCTET_OF_HALVES(operator*, Two, Two)
NORRSKEN_OCTET_OF_HALVES(operator/, Two, Two)
NORRSKEN_OCTET_OF_HALVES(min, Two, Two)
NORRSKEN_OCTET_OF_HALVES(max, Two, Two)
NORRSKEN_OCTET_OF_HALVES(operator<, TwoMasks, Two)
NORRSKEN_OCTET_OF_HALVES(operator<=, TwoMasks, Two)
NORRSKEN_OCTET_OF_HALVES(operator!=, TwoMasks, Two)
NORRSKEN_OCTET_OF_HALVES(operator&, TwoMasks, TwoMasks)
NORRSKEN_OCTET_OF_HALVES(operator|, TwoMasks, TwoMasks)
#undef NORRSKEN_OCTET_OF_HALVES

#if NORRSKEN_LANES == 4
using Octet = Two<Float>;
using OctetMask = TwoMasks<Mask>;
#else
using Octet = Two<Two<Two<Float> > >;
using OctetMask = TwoMasks<TwoMasks<TwoMasks<Mask> > >;
#endif

inline constexpr int lanes_of(const Float*) { return kLanes; }
template <class Half>
constexpr int lanes_of(const Two<Half>*) {
  return 2 * lanes_of(static_cast<const Half*>(nullptr));
}
inline constexpr int lanes_of(const Mask*) { return kLanes; }
template <class Half>
constexpr int lanes_of(const TwoMasks<Half>*) {
  return 2 * lanes_of(static_cast<const Half*>(nullptr));
}

template <class Half>
NORRSKEN_INLINE std::uint32_t to_bits(const TwoMasks<Half>& m) {
  return to_bits(m.low) | to_bits(m.high) << lanes_of(&m.low);
}
NORRSKEN_INLINE void load_part(const float* p, Float& a) { a = load(p); }
NORRSKEN_INLINE void store_part(float* p, const Float& a) { store(p, a); }
template <class Half>
NORRSKEN_INLINE void load_part(const float* p, Two<Half>& a) {
  load_part(p, a.low), load_part(p + lanes_of(&a.low), a.high);
}
template <class Half>
NORRSKEN_INLINE void store_part(float* p, const Two<Half>& a) {
  store_part(p, a.low), store_part(p + lanes_of(&a.low), a.high);
}
NORRSKEN_INLINE Octet load_octet(const float* p) {
  Octet a;
  load_part(p, a);
  return a;
}
NORRSKEN_INLINE void store_octet(float* p, const Octet& a) { store_part(p, a); }

#endif

NORRSKEN_INLINE Octet size(const Octet& a) { return max(a, Octet(0.0f) - a); }

}  // namespace norrsken::NORRSKEN_ISA
