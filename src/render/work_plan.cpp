#include "render/work_plan.h"

#include <algorithm>

namespace norrsken {
namespace {

constexpr std::uint64_t kSamplesPerWave = 16;

std::uint32_t divide_up(std::uint64_t a, std::uint64_t b) { return static_cast<std::uint32_t>((a + b - 1) / b); }

}  // namespace

WorkPlan::WorkPlan(std::uint32_t width, std::uint32_t height, std::uint64_t samples, std::uint32_t slots_per_wave)
    : width_(width), height_(height), samples_(samples) {
  block_ = static_cast<std::uint32_t>(
      std::min({samples, kSamplesPerWave, std::uint64_t{std::max(slots_per_wave / kMaxLanes, 1u)}}));
  // Tiles as wide as a register or two, so that lanes are neighbours, and as high as the slots allow.
  const std::uint32_t pixels = std::max(kMaxLanes, slots_per_wave / std::max(block_, 1u) / kMaxLanes * kMaxLanes);
  tile_width_ = std::min(width, pixels >= 64 * kMaxLanes ? 2 * kMaxLanes : kMaxLanes);
  tile_height_ = std::clamp(pixels / tile_width_, 1u, height);
  tiles_x_ = divide_up(width, tile_width_);
  tiles_ = std::uint64_t{tiles_x_} * divide_up(height, tile_height_);
  blocks_ = divide_up(samples, std::max(block_, 1u));
}

WaveJob WorkPlan::wave(std::uint64_t index) const {
  const std::uint64_t tile = tile_of(index), first = block_of(index) * block_;
  WaveJob job;
  job.x0 = static_cast<std::uint32_t>(tile % tiles_x_) * tile_width_;
  job.y0 = static_cast<std::uint32_t>(tile / tiles_x_) * tile_height_;
  job.width = std::min(tile_width_, width_ - job.x0);
  job.height = std::min(tile_height_, height_ - job.y0);
  job.first_sample = static_cast<std::uint32_t>(first);
  job.sample_count = static_cast<std::uint32_t>(std::min<std::uint64_t>(block_, samples_ - first));
  return job;
}

}  // namespace norrsken
