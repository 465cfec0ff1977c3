// The part of a film that is rendered, when the film's size changes: the same part of the picture.
#pragma once

#include <algorithm>
#include <cmath>

namespace norrsken {

/// Along one axis, of a film of `from` pixels that becomes one of `to`, at least 1. A pixel at least stays.
inline void scale_window(int& offset, int& size, int from, int to) {
  const auto at = [&](int x) { return static_cast<int>(std::lround(static_cast<double>(x) * to / from)); };
  const int begin = std::min(at(offset), to - 1), end = std::max(at(offset + size), begin + 1);
  offset = begin, size = end - begin;
}

}  // namespace norrsken
