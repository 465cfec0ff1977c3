// Sums that do not depend on the order of their addends.
//
// A sum is a pair of doubles, `high` + `low`. `high` is the sum as one double would have it; `low` collects what each
// addition rounded away, which is a double exactly (Knuth, TAOCP volume 2, 4.2.2, theorem B; summed this way by Pichat
// 1972 and Neumaier 1974). While the additions to `low` are exact, the pair is the exact sum, and `high` + `low`,
// rounded once, is the same for every order and every way to add in parts.
//
// They are exact for n addends of 24 bits, as floats have, whose magnitudes and sum lie within a factor of 2^83 / n of
// each other: 10^19 for a million. Addends that are smaller still lose bits below 2^-106 of the sum, so that two orders
// may differ in a rounding of the result with a probability of about n 2^-53 to a double, n 2^-82 to a float.
#pragma once

namespace norrsken {

[[gnu::always_inline]] inline void add_exactly(double& high, double& low, double value) {
  const double sum = high + value;
  const double added = sum - high;
  low += (high - (sum - added)) + (value - added);
  high = sum;
}

/// The nearest number of 24 bits (Dekker 1971, 5.6), with a double's range of exponents; infinite beyond 2^994.
[[gnu::always_inline]] inline double rounded_to_24_bits(double value) {
  const double scaled = value * 536870913.0;  // 2^29 + 1
  return scaled - (scaled - value);
}

}  // namespace norrsken
