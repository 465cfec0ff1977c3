// Which samples of its pixels an image is made of, and how far it may be from the truth.
#pragma once

#include <cstdint>

namespace norrsken {

/// Samples first to end - 1 of every pixel.
struct SampleRange {
  std::uint32_t first = 0, end = 0;

  std::uint32_t count() const { return end - first; }
  friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

/// Estimated RMSE of an image over its mean. Known as soon as every pixel has two samples, if there is any light.
struct RelativeError {
  double value = -1;         ///< -1 while unknown; 0 if no noise was seen, which may be because it is rare
  double low = 0, high = 0;  ///< holds the true one with a probability of 95 % or more
};

}  // namespace norrsken
