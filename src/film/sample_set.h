// Which samples of a pixel are on the film: ranges of their indices, in ascending order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "norrsken/render.h"
#include "tables/wave_types.h"

namespace norrsken {

class SampleSet {
 public:
  /// All there are.
  SampleSet() : ranges_{{0, 0xffffffffu}} {}
  /// Disjoint and ascending.
  explicit SampleSet(std::vector<SampleRange> ranges) : ranges_(std::move(ranges)) {}

  /// How many of the set's first n samples belong to replicate r.
  std::uint32_t count_of_replicate(std::uint32_t n, std::uint32_t r) const {
    std::uint32_t count = 0;
    for (const SampleRange& range : ranges_) {
      const std::uint32_t taken = std::min(n, range.end - range.first);
      count += below(range.first + taken, r) - below(range.first, r);
      n -= taken;
    }
    return count;
  }

 private:
  /// How many of the samples 0 to end - 1 belong to replicate r.
  static std::uint32_t below(std::uint32_t end, std::uint32_t r) {
    return end / kReplicates + (end % kReplicates > r ? 1u : 0u);
  }

  std::vector<SampleRange> ranges_;
};

}  // namespace norrsken
