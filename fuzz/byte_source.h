// Choices that the bytes of a fuzzer's input make. When they are used up, every choice is the first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>

#include "fuzz/fuzz.h"

namespace norrsken::fuzz {

class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool empty() const { return at_ == end_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *at_++; }
  /// 0 to count - 1.
  int below(int count) { return byte() % count; }
  bool flag() { return (byte() & 1) != 0; }
  const char* one_of(std::initializer_list<const char*> words) {
    return words.begin()[below(static_cast<int>(words.size()))];
  }

  /// From `least` to `most`: an end of the range now and then; evenly by order of magnitude where that is much.
  double number(double least, double most) {
    const std::uint8_t kind = byte();
    if (kind < 16) return least;
    if (kind < 32) return most;
    const double share = (byte() + byte() / 256.0) / 256.0;
    const bool by_magnitude = most > 1000 && kind < 128;
    if (!by_magnitude) return least + (std::min(most, least + 10) - least) * share;
    const double low = std::max(least, 1e-6);
    return low * std::pow(most / low, share);
  }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

}  // namespace norrsken::fuzz
