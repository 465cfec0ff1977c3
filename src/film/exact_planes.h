// Planes of sums on the host: the memory behind SumPlanes.
#pragma once

#include <cstddef>

#include "base/exact_sum.h"
#include "base/zeroed_array.h"
#include "tables/film_view.h"

namespace norrsken {

class ExactPlanes {
 public:
  explicit ExactPlanes(std::size_t count = 0) : high_(count), low_(count) {}

  std::size_t size() const { return high_.size(); }
  bool empty() const { return high_.empty(); }
  /// Null where there are none.
  SumPlanes view() { return empty() ? SumPlanes{} : SumPlanes{high_.data(), low_.data()}; }

  double operator[](std::size_t i) const { return high_[i] + low_[i]; }
  void add(std::size_t i, double value) { add_exactly(high_[i], low_[i], value); }
  /// Of one size.
  void add(const ExactPlanes& other) {
    for (std::size_t i = 0; i < high_.size(); ++i) {
      add(i, other.high_[i]);
      add(i, other.low_[i]);
    }
  }

  /// Calls visit(array) for the two arrays of doubles.
  template <class Visit>
  void visit(const Visit& visit_array) {
    visit_array(high_);
    visit_array(low_);
  }

 private:
  // Tiles are a multiple of a cache line wide: aligned, two threads on neighbouring tiles never write to one line.
  ZeroedArray<double> high_, low_;
};

}  // namespace norrsken
