#include "render/work_plan.h"

#include <algorithm>
#include <bit>

#include "film/film.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kSamplesPerWave = 16;

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) { return a / b + (a % b != 0 ? 1 : 0); }

}  // namespace

TileGrid::TileGrid(std::uint32_t image_width, std::uint32_t image_height, std::uint32_t slots_per_wave)
    : width(image_width),
      height(image_height),
      slots(std::max(slots_per_wave, kMaxLanes)),
      longest_block(std::min(kSamplesPerWave, slots / kMaxLanes)) {
  tile_width = std::min(width, kMaxLanes);
  tile_height = std::clamp(kMaxLanes / tile_width, 1u, height);
  columns = divide_up(width, tile_width);
  rows = divide_up(height, tile_height);
}

FilmRegion TileGrid::region_of(std::uint64_t tile) const {
  const auto x = static_cast<std::uint32_t>(tile % columns) * tile_width;
  const auto y = static_cast<std::uint32_t>(tile / columns) * tile_height;
  return {x, y, std::min(tile_width, width - x), std::min(tile_height, height - y)};
}

std::uint64_t TileGrid::pixels_of(std::uint64_t tile) const {
  const FilmRegion region = region_of(tile);
  return std::uint64_t{region.width} * region.height;
}

WorkPlan::WorkPlan(const TileGrid& grid, SampleRange numbers, std::uint32_t origin, Cut cut)
    : grid_(grid), numbers_(numbers), origin_(origin) {
  const WaveJob tile{.width = grid.tile_width, .height = grid.tile_height};
  const std::uint32_t slots_of_tile = grid.slots / tile.pixel_stride();
  const bool is_single = cut == Cut::single_tiles;
  block_ = std::clamp(numbers.count(), 1u, is_single ? slots_of_tile : grid.longest_block);
  // A power of two of tiles, so that the areas of other passes lie within each other.
  const std::uint32_t tiles = is_single ? 1 : std::bit_floor(std::max(slots_of_tile / block_, 1u));
  // Waves are numbered in 64 bits, a wave's slots in few: wide areas are two registers wide.
  constexpr std::uint32_t kManyTiles = 64;
  area_columns_ = tiles >= kManyTiles && grid.columns > 1 ? 2 : 1;
  area_rows_ = tiles / area_columns_;
  areas_x_ = divide_up(grid.columns, area_columns_);
  areas_ = std::uint64_t{areas_x_} * divide_up(grid.rows, area_rows_);
  blocks_ = divide_up(numbers.count(), block_);
}

WaveJob WorkPlan::wave(std::uint64_t index) const {
  const std::uint64_t area = area_of(index);
  const std::uint32_t width = area_columns_ * grid_.tile_width, height = area_rows_ * grid_.tile_height;
  const auto first = static_cast<std::uint32_t>(block_of(index) * block_);
  WaveJob job;
  job.x0 = static_cast<std::uint32_t>(area % areas_x_) * width;
  job.y0 = static_cast<std::uint32_t>(area / areas_x_) * height;
  job.width = std::min(width, grid_.width - job.x0);
  job.height = std::min(height, grid_.height - job.y0);
  job.first_sample = origin_ + numbers_.first + first;
  job.sample_count = std::min(block_, numbers_.count() - first);
  return job;
}

template <class Visit>
void WorkPlan::for_each_tile(std::uint64_t area, const Visit& visit) const {
  const auto x0 = static_cast<std::uint32_t>(area % areas_x_) * area_columns_;
  const auto y0 = static_cast<std::uint32_t>(area / areas_x_) * area_rows_;
  for (std::uint32_t y = y0; y < std::min(y0 + area_rows_, grid_.rows); ++y) {
    for (std::uint32_t x = x0; x < std::min(x0 + area_columns_, grid_.columns); ++x) {
      visit(std::size_t{y} * grid_.columns + x);
    }
  }
}

std::uint32_t WorkPlan::progress_of(std::uint64_t area, const TileProgress& progress) const {
  std::uint32_t least = numbers_.end;
  for_each_tile(area, [&](std::size_t tile) { least = std::min(least, progress[tile]); });
  return least;
}

bool WorkPlan::is_even(std::uint64_t area, const TileProgress& progress) const {
  const std::uint32_t least = std::max(progress_of(area, progress), numbers_.first);
  bool even = true;
  for_each_tile(area, [&](std::size_t tile) {
    even = even && std::clamp(progress[tile], numbers_.first, numbers_.end) == least;
  });
  return even;
}

void WorkPlan::set_progress_of(std::uint64_t area, std::uint32_t done, TileProgress& progress) const {
  for_each_tile(area, [&](std::size_t tile) { progress[tile] = done; });
}

std::uint64_t WorkPlan::blocks_done(std::uint32_t done) const {
  if (done <= numbers_.first) return 0;
  return done >= numbers_.end ? blocks_ : (done - numbers_.first) / block_;
}

WaveJob WorkPlan::remaining(WaveJob job, std::uint32_t done, std::uint32_t goal) const {
  const std::uint32_t end = std::clamp(origin_ + goal, job.first_sample, job.first_sample + job.sample_count);
  job.first_sample = std::clamp(origin_ + done, job.first_sample, end);
  job.sample_count = end - job.first_sample;
  return job;
}

std::vector<WorkPlan> plan_passes(const TileGrid& grid, SampleRange samples, WorkPlan::Cut cut) {
  std::vector<WorkPlan> passes;
  std::uint32_t first = 0;
  const auto pass_up_to = [&](std::uint32_t end) {
    const SampleRange numbers{first, std::min(end, samples.count())};
    if (numbers.end <= numbers.first) return;
    const bool is_first_block = first < grid.longest_block;
    passes.emplace_back(grid, numbers, samples.first, is_first_block ? WorkPlan::Cut::groups_of_tiles : cut);
    first = numbers.end;
  };
  for (const std::uint32_t end : {1u, 2u, grid.longest_block, samples.count()}) pass_up_to(end);
  return passes;
}

WorkPlan::Cut cut_for(const TileGrid& grid, SampleRange samples, const TileProgress& goal,
                      const TileProgress& progress) {
  for (const WorkPlan& plan : plan_passes(grid, samples)) {
    for (std::uint64_t area = 0; area < plan.area_count(); ++area) {
      if (!plan.is_even(area, goal) || !plan.is_even(area, progress)) return WorkPlan::Cut::single_tiles;
    }
  }
  return WorkPlan::Cut::groups_of_tiles;
}

bool is_possible(const TileGrid& grid, SampleRange samples, const TileProgress& goal, const TileProgress& progress) {
  if (progress.size() != grid.tile_count() || goal.size() != progress.size()) return false;
  for (std::size_t tile = 0; tile < progress.size(); ++tile) {
    if (progress[tile] > goal[tile] || goal[tile] > samples.count()) return false;
  }
  for (const WorkPlan& pass : plan_passes(grid, samples, WorkPlan::Cut::single_tiles)) {
    for (std::uint64_t area = 0; area < pass.area_count(); ++area) {
      if (!pass.is_even(area, progress)) return false;
    }
  }
  return true;
}

}  // namespace norrsken
