#include "tests/statistics/estimate.h"

#include <fmt/core.h>

#include <utility>

namespace norrsken::statistics {

Estimate Estimate::from_replicates(std::span<const double> values) {
  const double count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, squares / (count - 1) / count, static_cast<int>(values.size())};
}

std::vector<Region> regions_of(int width, int height, std::span<const Grid> grids) {
  std::vector<Region> regions;
  for (const auto& [n, resolution] : grids) {
    const std::string sort = n == 1 ? "whole image" : fmt::format("{0} x {0} blocks", n);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        regions.push_back({sort, n == 1 ? sort : fmt::format("block ({},{}) of {} x {}", i, j, n, n), width * i / n,
                           height * j / n, width * (i + 1) / n, height * (j + 1) / n, resolution});
      }
    }
  }
  return regions;
}

std::vector<Region> standard_regions(int width, int height) {
  return regions_of(width, height, std::array{Grid{1, 0.005}, Grid{2, 0.005}, Grid{4, 0.01}});
}

Picture::Pixel region_mean(const Picture& picture, const Region& region) {
  Picture::Pixel mean{};
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      for (std::size_t c = 0; c < 3; ++c) mean[c] += picture.at(x, y)[c];
    }
  }
  const double count = static_cast<double>(region.x1 - region.x0) * static_cast<double>(region.y1 - region.y0);
  for (double& channel : mean) channel /= count;
  return mean;
}

RegionMeans::RegionMeans(std::vector<Region> regions) : regions_(std::move(regions)), replicates_(regions_.size()) {}

void RegionMeans::add(const Picture& replicate) {
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const Picture::Pixel mean = region_mean(replicate, regions_[r]);
    for (std::size_t c = 0; c < 3; ++c) replicates_[r][c].push_back(mean[c]);
  }
}

Estimate RegionMeans::estimate(std::size_t region, std::size_t channel) const {
  return Estimate::from_replicates(replicates_[region][channel]);
}

}  // namespace norrsken::statistics
