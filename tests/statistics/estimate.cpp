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
  for (const auto& [columns, rows, resolution] : grids) {
    const bool whole = columns == 1 && rows == 1;
    const std::string sort = whole ? "whole image" : fmt::format("{} x {} blocks", columns, rows);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        regions.push_back({sort, whole ? sort : fmt::format("block ({},{}) of {} x {}", i, j, columns, rows),
                           width * i / columns, height * j / rows, width * (i + 1) / columns, height * (j + 1) / rows,
                           resolution});
      }
    }
  }
  return regions;
}

std::vector<Region> standard_regions(int width, int height) {
  return regions_of(width, height, std::array{Grid{1, 1, 0.005}, Grid{2, 2, 0.005}, Grid{4, 4, 0.01}});
}

namespace {

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

}  // namespace

RegionEstimates RegionEstimates::known(const Picture& picture, std::vector<Region> regions) {
  RegionEstimates result{std::move(regions), {}};
  for (const Region& region : result.regions) {
    const Picture::Pixel mean = region_mean(picture, region);
    result.values.push_back({Estimate::known(mean[0]), Estimate::known(mean[1]), Estimate::known(mean[2])});
  }
  return result;
}

RegionMeans::RegionMeans(std::vector<Region> regions) : regions_(std::move(regions)), replicates_(regions_.size()) {}

void RegionMeans::add(const Picture& replicate) {
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const Picture::Pixel mean = region_mean(replicate, regions_[r]);
    for (std::size_t c = 0; c < 3; ++c) replicates_[r][c].push_back(mean[c]);
  }
}

RegionEstimates RegionMeans::estimates() const {
  RegionEstimates result{regions_, {}};
  for (const auto& channels : replicates_) {
    std::array<Estimate, 3> estimates;
    for (std::size_t c = 0; c < 3; ++c) estimates[c] = Estimate::from_replicates(channels[c]);
    result.values.push_back(estimates);
  }
  return result;
}

RegionEstimates RegionMeans::differences(const RegionMeans& other) const {
  RegionMeans difference = *this;
  for (std::size_t r = 0; r < replicates_.size(); ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      auto& values = difference.replicates_[r][c];
      for (std::size_t i = 0; i < values.size(); ++i) values[i] -= other.replicates_.at(r)[c].at(i);
    }
  }
  return difference.estimates();
}

}  // namespace norrsken::statistics
