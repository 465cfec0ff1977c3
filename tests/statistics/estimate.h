// Means with standard errors, from independent replicates of an image.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tests/statistics/picture.h"

namespace norrsken::statistics {

/// A mean and the variance of that mean, as told by `replicates` independent values. A known value has variance 0
/// and no replicates.
struct Estimate {
  double mean = 0;
  double variance = 0;
  int replicates = 0;

  static Estimate known(double value) { return {value, 0, 0}; }
  /// At least two values.
  static Estimate from_replicates(std::span<const double> values);
};

/// Collects independent values of one quantity.
class Mean {
 public:
  void add(double value) {
    // Welford 1962: squares of deviations from the mean so far.
    ++count_;
    const double step = value - mean_;
    mean_ += step / count_;
    squares_ += step * (value - mean_);
  }
  /// Of at least two values.
  Estimate estimate() const { return {mean_, squares_ / (count_ - 1.0) / count_, count_}; }

 private:
  int count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// A rectangle of pixels, [x0, x1) x [y0, y1), over which images are averaged before they are compared.
struct Region {
  std::string sort;  ///< "whole image", "4 x 4 blocks": summaries name the worst of each sort
  std::string name;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double resolution = 0;  ///< the smallest relative bias that a comparison here has to be able to see
};

/// An image cut into `columns` x `rows` regions.
struct Grid {
  int columns = 1, rows = 1;
  double resolution = 0;
};
std::vector<Region> regions_of(int width, int height, std::span<const Grid> grids);

/// The whole image and its quadrants, which must resolve a bias of 0.5 %, and 4 x 4 blocks, which must resolve 1 %.
std::vector<Region> standard_regions(int width, int height);

/// Means of R, G, B in every region.
struct RegionEstimates {
  std::vector<Region> regions;
  std::vector<std::array<Estimate, 3>> values;  ///< one for each region

  /// Of an image that is free of noise.
  static RegionEstimates known(const Picture& picture, std::vector<Region> regions);
};

/// Collects replicates of one image.
class RegionMeans {
 public:
  explicit RegionMeans(std::vector<Region> regions);

  void add(const Picture& replicate);

  RegionEstimates estimates() const;
  /// Of the differences to `other`, replicate by replicate: for replicates that share their random numbers, so that
  /// they differ less from each other than from replicates of their own side.
  RegionEstimates differences(const RegionMeans& other) const;

 private:
  std::vector<Region> regions_;
  std::vector<std::array<std::vector<double>, 3>> replicates_;  ///< per region and channel
};

}  // namespace norrsken::statistics
