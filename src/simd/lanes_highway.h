// 4 (SSE4.2, NEON), 8 (AVX2) or 16 (AVX-512) lanes on Google's Highway, statically compiled for the set at hand.
// docs/dev/lanes.md says why Highway, with figures.
#pragma once

#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include <cstdint>

#include "simd/isa_namespace.h"

namespace norrsken::NORRSKEN_ISA {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kLanes = NORRSKEN_LANES;
using FloatTag = hn::FixedTag<float, kLanes>;
using UIntTag = hn::FixedTag<std::uint32_t, kLanes>;
using IntTag = hn::FixedTag<std::int32_t, kLanes>;

struct Mask {
  hn::Mask<FloatTag> v;
  Mask() = default;
  /// Of nothing else: a truth of one bit would be the first lane's.
  NORRSKEN_INLINE Mask(hn::Mask<FloatTag> x) : v(x) {}
  static NORRSKEN_INLINE Mask none() { return {hn::FirstN(FloatTag(), 0)}; }
};

struct Float {
  hn::Vec<FloatTag> v;
  Float() = default;
  NORRSKEN_INLINE Float(float x) : v(hn::Set(FloatTag(), x)) {}
  NORRSKEN_INLINE Float(hn::Vec<FloatTag> x) : v(x) {}
};

struct UInt {
  hn::Vec<UIntTag> v;
  UInt() = default;
  NORRSKEN_INLINE UInt(std::uint32_t x) : v(hn::Set(UIntTag(), x)) {}
  NORRSKEN_INLINE UInt(hn::Vec<UIntTag> x) : v(x) {}
};

NORRSKEN_INLINE Float operator+(Float a, Float b) { return hn::Add(a.v, b.v); }
NORRSKEN_INLINE Float operator-(Float a, Float b) { return hn::Sub(a.v, b.v); }
NORRSKEN_INLINE Float operator*(Float a, Float b) { return hn::Mul(a.v, b.v); }
NORRSKEN_INLINE Float operator/(Float a, Float b) { return hn::Div(a.v, b.v); }
NORRSKEN_INLINE Float operator-(Float a) { return hn::Neg(a.v); }
NORRSKEN_INLINE Mask operator<(Float a, Float b) { return {hn::Lt(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator<=(Float a, Float b) { return {hn::Le(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator>(Float a, Float b) { return {hn::Gt(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator>=(Float a, Float b) { return {hn::Ge(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator==(Float a, Float b) { return {hn::Eq(a.v, b.v)}; }
// Of NaN it is true, as everywhere else in C++; AVX-512's Ne of Highway says no.
NORRSKEN_INLINE Mask operator!=(Float a, Float b) { return {hn::Not(hn::Eq(a.v, b.v))}; }

/// a * b + c, rounded once where the instruction set has it, twice where not (SSE4.2).
NORRSKEN_INLINE Float fma(Float a, Float b, Float c) { return hn::MulAdd(a.v, b.v, c.v); }
NORRSKEN_INLINE Float fnma(Float a, Float b, Float c) { return hn::NegMulAdd(a.v, b.v, c.v); }

NORRSKEN_INLINE Float sqrt(Float a) { return hn::Sqrt(a.v); }
NORRSKEN_INLINE Float abs(Float a) { return hn::Abs(a.v); }
NORRSKEN_INLINE Float min(Float a, Float b) { return hn::Min(a.v, b.v); }
NORRSKEN_INLINE Float max(Float a, Float b) { return hn::Max(a.v, b.v); }
NORRSKEN_INLINE Float round(Float a) { return hn::Round(a.v); }
NORRSKEN_INLINE Float floor(Float a) { return hn::Floor(a.v); }
NORRSKEN_INLINE Float copysign(Float magnitude, Float sign) { return hn::CopySign(magnitude.v, sign.v); }

NORRSKEN_INLINE UInt operator+(UInt a, UInt b) { return hn::Add(a.v, b.v); }
NORRSKEN_INLINE UInt operator-(UInt a, UInt b) { return hn::Sub(a.v, b.v); }
NORRSKEN_INLINE UInt operator*(UInt a, UInt b) { return hn::Mul(a.v, b.v); }
NORRSKEN_INLINE UInt operator^(UInt a, UInt b) { return hn::Xor(a.v, b.v); }
NORRSKEN_INLINE UInt operator&(UInt a, UInt b) { return hn::And(a.v, b.v); }
NORRSKEN_INLINE UInt operator|(UInt a, UInt b) { return hn::Or(a.v, b.v); }
NORRSKEN_INLINE Mask operator==(UInt a, UInt b) { return {hn::RebindMask(FloatTag(), hn::Eq(a.v, b.v))}; }
NORRSKEN_INLINE Mask operator!=(UInt a, UInt b) { return {hn::RebindMask(FloatTag(), hn::Ne(a.v, b.v))}; }
template <int n>
NORRSKEN_INLINE UInt shift_left(UInt a) {
  return hn::ShiftLeft<n>(a.v);
}
template <int n>
NORRSKEN_INLINE UInt shift_right(UInt a) {
  return hn::ShiftRight<n>(a.v);
}

NORRSKEN_INLINE UInt bits(Float a) { return hn::BitCast(UIntTag(), a.v); }
NORRSKEN_INLINE Float from_bits(UInt a) { return hn::BitCast(FloatTag(), a.v); }
/// Exact below 2^24, rounded to nearest up to 2^31.
NORRSKEN_INLINE Float to_float(UInt a) { return hn::ConvertTo(FloatTag(), hn::BitCast(IntTag(), a.v)); }
/// Truncates; a is in [0, 2^31).
NORRSKEN_INLINE UInt to_uint(Float a) { return hn::BitCast(UIntTag(), hn::ConvertTo(IntTag(), a.v)); }

NORRSKEN_INLINE Mask operator&(Mask a, Mask b) { return {hn::And(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator|(Mask a, Mask b) { return {hn::Or(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator^(Mask a, Mask b) { return {hn::Xor(a.v, b.v)}; }
NORRSKEN_INLINE Mask operator!(Mask a) { return {hn::Not(a.v)}; }
NORRSKEN_INLINE bool any(Mask m) { return !hn::AllFalse(FloatTag(), m.v); }
NORRSKEN_INLINE bool all(Mask m) { return hn::AllTrue(FloatTag(), m.v); }
NORRSKEN_INLINE std::uint32_t count(Mask m) { return static_cast<std::uint32_t>(hn::CountTrue(FloatTag(), m.v)); }
/// Bit i is lane i.
NORRSKEN_INLINE std::uint32_t to_bits(Mask m) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), m.v, bytes);
  return static_cast<std::uint32_t>(bytes[0] | (bytes[1] << 8));
}
/// The first n lanes (all of them if n >= kLanes).
NORRSKEN_INLINE Mask first_lanes(std::uint32_t n) { return {hn::FirstN(FloatTag(), n)}; }

NORRSKEN_INLINE Float select(Mask m, Float a, Float b) { return hn::IfThenElse(m.v, a.v, b.v); }
NORRSKEN_INLINE UInt select(Mask m, UInt a, UInt b) { return hn::IfThenElse(hn::RebindMask(UIntTag(), m.v), a.v, b.v); }

NORRSKEN_INLINE UInt lane_index() { return hn::Iota(UIntTag(), 0u); }
/// Memory is aligned to a full register, everywhere.
NORRSKEN_INLINE Float load(const float* p) { return hn::Load(FloatTag(), p); }
NORRSKEN_INLINE UInt load_uint(const float* p) { return bits(load(p)); }
NORRSKEN_INLINE void store(float* p, Float a) { hn::Store(a.v, FloatTag(), p); }
NORRSKEN_INLINE void store(float* p, UInt a) { store(p, from_bits(a)); }
/// Where the active lanes go when they are moved together: computed once for all values of a record. Highway's own
/// Compress looks its tables up anew for every value, and GCC 12 copies them to the stack each time.
struct Compaction {
#if NORRSKEN_LANES == 16
  Mask mask;
#else
  hn::Vec<UIntTag> order;  ///< 8 lanes: lane indices; 4 lanes: byte indices
#endif
  std::uint32_t count;
};

#if NORRSKEN_LANES == 16

NORRSKEN_INLINE Compaction make_compaction(Mask m) { return {m, count(m)}; }
NORRSKEN_INLINE void compress_store(float* p, Float a, const Compaction& c) {
  hn::StoreU(hn::Compress(a.v, c.mask.v), FloatTag(), p);
}

#else

/// Row m: the set bits of m in ascending order, then zeros; as lane indices (8 lanes) or as the
/// indices of the lanes' four bytes.
struct CompactionTable {
  static constexpr int kRowBytes = kLanes == 8 ? 8 : 16;
  alignas(16) std::uint8_t rows[1 << kLanes][kRowBytes] = {};
  constexpr CompactionTable() {
    for (int m = 0; m < (1 << kLanes); ++m) {
      int at = 0;
      for (int lane = 0; lane < kLanes; ++lane) {
        if (((m >> lane) & 1) == 0) continue;
        if (kLanes == 8) {
          rows[m][at++] = static_cast<std::uint8_t>(lane);
        } else {
          for (int byte = 0; byte < 4; ++byte) rows[m][at++] = static_cast<std::uint8_t>(4 * lane + byte);
        }
      }
    }
  }
};
static constexpr CompactionTable kCompactionTable;

NORRSKEN_INLINE Compaction make_compaction(Mask m) {
  const std::uint8_t* row = kCompactionTable.rows[to_bits(m)];
#if NORRSKEN_LANES == 8
  return {hn::PromoteTo(UIntTag(), hn::Load(hn::FixedTag<std::uint8_t, 8>(), row)), count(m)};
#else
  return {hn::BitCast(UIntTag(), hn::Load(hn::FixedTag<std::uint8_t, 16>(), row)), count(m)};
#endif
}
NORRSKEN_INLINE void compress_store(float* p, Float a, const Compaction& c) {
#if NORRSKEN_LANES == 8
  hn::StoreU(hn::TableLookupLanes(a.v, hn::IndicesFromVec(FloatTag(), c.order)), FloatTag(), p);
#else
  const hn::FixedTag<std::uint8_t, 16> bytes;
  const auto moved = hn::TableLookupBytes(hn::BitCast(bytes, a.v), hn::BitCast(bytes, c.order));
  hn::StoreU(hn::BitCast(FloatTag(), moved), FloatTag(), p);
#endif
}

#endif

/// base[index] in the active lanes; the others read base[0].
NORRSKEN_INLINE Float gather(const float* base, UInt index, Mask m) {
  const auto safe = hn::IfThenElseZero(hn::RebindMask(UIntTag(), m.v), index.v);
  return hn::GatherIndex(FloatTag(), base, hn::BitCast(IntTag(), safe));
}
NORRSKEN_INLINE UInt gather_uint(const float* base, UInt index, Mask m) { return bits(gather(base, index, m)); }

}  // namespace norrsken::NORRSKEN_ISA
