// Model       Owen-scrambled Sobol' points, padded: every set of one or two dimensions gets the first dimensions of the
//             Sobol' sequence under a scrambling and a shuffling of its own.
// Parameters  none
// Source      Sobol' 1967; Owen, "Randomly Permuted (t,m,s)-Nets", 1995; Burley, "Practical Hash-based Owen
//             Scrambling", JCGT 9(4), 2020; the hash after Laine and Karras 2011 with Vegdahl's constants
//             ("Building a Better LK Hash", 2021).
// Departures  the second dimension's generator matrix (Pascal's triangle modulo 2) is applied in five masked shifts,
//             as a superset sum over the bits of bit positions, instead of row by row.
#pragma once

#include "math/warp.h"
#include "sampler/hash.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE UInt reverse_bits(UInt x) {
  x = (shift_right<1>(x) & UInt(0x55555555u)) | shift_left<1>(x & UInt(0x55555555u));
  x = (shift_right<2>(x) & UInt(0x33333333u)) | shift_left<2>(x & UInt(0x33333333u));
  x = (shift_right<4>(x) & UInt(0x0f0f0f0fu)) | shift_left<4>(x & UInt(0x0f0f0f0fu));
  x = (shift_right<8>(x) & UInt(0x00ff00ffu)) | shift_left<8>(x & UInt(0x00ff00ffu));
  return shift_right<16>(x) | shift_left<16>(x);
}

struct SobolSampler {
  /// A permutation in which a bit is flipped depending on the bits below it alone: Owen's scrambling of the
  /// bit-reversed word.
  static NORRSKEN_INLINE UInt scramble_reversed(UInt x, UInt seed) {
    x ^= x * UInt(0x3d20adeau);
    x += seed;
    x *= shift_right<16>(seed) | 1u;
    x ^= x * UInt(0x05526c56u);
    x ^= x * UInt(0x53a22864u);
    return x;
  }

  /// First Sobol' dimension (van der Corput) of an index, bit-reversed, that is the index itself.
  /// Second dimension, bit-reversed: bit j is the sum over all index bits k whose position contains j's bits.
  static NORRSKEN_INLINE UInt second_dimension_reversed(UInt index) {
    index ^= shift_right<1>(index) & UInt(0x55555555u);
    index ^= shift_right<2>(index) & UInt(0x33333333u);
    index ^= shift_right<4>(index) & UInt(0x0f0f0f0fu);
    index ^= shift_right<8>(index) & UInt(0x00ff00ffu);
    index ^= shift_right<16>(index);
    return index;
  }

  /// `key` is one per pixel and replicate, `index` counts the replicate's points.
  static NORRSKEN_INLINE Vec2f sample_2d(UInt key, UInt index, std::uint32_t dimension) {
    const UInt seed = hash(key + UInt(dimension * 0x9e3779b9u));
    const UInt shuffled = reverse_bits(scramble_reversed(reverse_bits(index), seed));
    const UInt x = scramble_reversed(shuffled, hash(seed + 1u));
    const UInt y = scramble_reversed(second_dimension_reversed(shuffled), hash(seed + 2u));
    return {to_unit(reverse_bits(x)), to_unit(reverse_bits(y))};
  }
  static NORRSKEN_INLINE Float sample_1d(UInt key, UInt index, std::uint32_t dimension) {
    const UInt seed = hash(key + UInt(dimension * 0x9e3779b9u));
    const UInt shuffled = reverse_bits(scramble_reversed(reverse_bits(index), seed));
    return to_unit(reverse_bits(scramble_reversed(shuffled, hash(seed + 1u))));
  }
};

}  // namespace norrsken::NORRSKEN_ISA
