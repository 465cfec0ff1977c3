// Numbers for combinations of three words: vertices of a mesh for what its corners refer to.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/memory.h"

namespace norrsken {

class Combinations {
 public:
  using Key = std::array<std::uint32_t, 3>;

  /// For at most so many.
  explicit Combinations(std::size_t most) : table_(std::bit_ceil(most * 2 + 2), kFree) {}

  /// Numbers count from 0 in the order in which combinations come first.
  std::uint32_t number_of(const Key& key) {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = hash(key) & mask;
    while (table_[slot] != kFree && keys_[table_[slot]] != key) slot = (slot + 1) & mask;
    if (table_[slot] == kFree) {
      table_[slot] = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(key);
    }
    return table_[slot];
  }

  /// By their numbers.
  const Array<Key>& keys() const { return keys_; }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffu;

  // Finalizer of SplitMix64 (Steele, Lea, Flood 2014) over the three words.
  static std::size_t hash(const Key& key) {
    std::uint64_t h = key[0] * 0x9e3779b97f4a7c15u;
    h = (h ^ key[1]) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27) ^ key[2]) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }

  Array<std::uint32_t> table_;  ///< open addressing, at most half full
  Array<Key> keys_;
};

}  // namespace norrsken
