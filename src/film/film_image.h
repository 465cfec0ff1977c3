// The image that is on a film, taken off part by part: each part while nobody writes to it, so that an image can be had at any
// time of a rendering.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "film/film.h"
#include "norrsken/image.h"

namespace norrsken {

class FilmImage {
 public:
  /// Of a region of the film: R, G, B, A if the film has alpha, and the layers that it was made for, features divided by
  /// `feature_samples`, or none if that is 0; with `statistics` also samples, variance.*, error.* and interval.*. Borrows
  /// the film.
  FilmImage(const Film& film, const FilmRegion& region, bool statistics, std::uint32_t feature_samples);

  /// The parts that are taken have to cover this: the region, and around it what its intervals depend on.
  const FilmRegion& needed() const { return needed_; }
  void take(const FilmRegion& part);
  /// When all is taken.
  Image finish() &&;

 private:
  std::size_t add(const std::string& name);
  void take_pixel(std::uint64_t pixel, std::size_t to);
  void crop();

  const Film& film_;
  FilmRegion region_, needed_;
  bool statistics_;
  std::uint32_t feature_samples_;
  Image image_;
  // Of channels, their places in the image.
  std::array<std::size_t, 3> color_{}, variance_{}, error_{}, interval_{};
  std::size_t samples_ = 0, alpha_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> copies_;  ///< of layers that are the image again: from, to
  std::vector<std::size_t> moments_;                         ///< X, m2_X, Y, m2_Y, ... of each layer
  std::vector<std::size_t> features_;                        ///< of each layer
};

}  // namespace norrsken
