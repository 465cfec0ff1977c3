// How a render is cut into waves. The cut never shows in the image: random numbers are addressed by pixel and sample,
// and every pixel's samples are added in order.
#pragma once

#include <cstdint>
#include <vector>

#include "norrsken/render.h"
#include "tables/wave_types.h"

namespace norrsken {

struct FilmRegion;

/// The image in tiles of a fixed size, by which it is known how far it has come. A tile is a register of pixels, so that
/// lanes are neighbours and samples can be many in one row and few in the next.
struct TileGrid {
  TileGrid(std::uint32_t image_width, std::uint32_t image_height, std::uint32_t slots_per_wave);

  std::uint64_t tile_count() const { return std::uint64_t{columns} * rows; }
  FilmRegion region_of(std::uint64_t tile) const;
  std::uint64_t pixels_of(std::uint64_t tile) const;
  /// Calls visit(tile) for the tiles that have pixels in a region.
  template <class Region, class Visit>
  void for_each_tile(const Region& region, const Visit& visit) const {
    for (std::uint64_t y = region.y0 / tile_height; y * tile_height < region.y0 + region.height; ++y) {
      for (std::uint64_t x = region.x0 / tile_width; x * tile_width < region.x0 + region.width; ++x)
        visit(y * columns + x);
    }
  }

  std::uint32_t width, height;  ///< of the image
  std::uint32_t slots;          ///< at most, of a wave
  std::uint32_t longest_block;  ///< samples of each pixel in one wave, at most
  std::uint32_t tile_width, tile_height;
  std::uint32_t columns, rows;
};

/// Of each tile of a grid, how many of the samples are on the film, in the order of their indices.
using TileProgress = std::vector<std::uint32_t>;

/// Consecutive samples of all pixels, cut into waves: blocks of samples times rectangles of tiles.
class WorkPlan {
 public:
  /// A wave takes tiles that have come equally far together, or several blocks of one tile.
  enum class Cut { groups_of_tiles, single_tiles };

  /// Of the samples that are rendered those that are number `first` to `end` - 1, counted from the sample `origin`.
  WorkPlan(const TileGrid& grid, SampleRange numbers, std::uint32_t origin, Cut cut = Cut::groups_of_tiles);

  std::uint64_t wave_count() const { return blocks_ * areas_; }
  std::uint64_t area_count() const { return areas_; }
  std::uint64_t area_of(std::uint64_t wave) const { return wave % areas_; }
  std::uint64_t block_of(std::uint64_t wave) const { return wave / areas_; }
  /// All areas take their first block of samples, then all their second, ...
  WaveJob wave(std::uint64_t index) const;

  /// The number after a wave's last sample's: the progress of its tiles when it is on the film.
  std::uint32_t end_of(const WaveJob& job) const { return job.first_sample + job.sample_count - origin_; }
  /// How far the tiles of an area have come, as far as this plan goes.
  std::uint32_t progress_of(std::uint64_t area, const TileProgress& progress) const;
  /// Whether that is equally far.
  bool is_even(std::uint64_t area, const TileProgress& progress) const;
  void set_progress_of(std::uint64_t area, std::uint32_t done, TileProgress& progress) const;
  /// How many blocks are on the film of an area that has come so far.
  std::uint64_t blocks_done(std::uint32_t done) const;
  /// What is left of a wave's job in an area that has come so far and is to come to `goal`; it may have no samples.
  WaveJob remaining(WaveJob job, std::uint32_t done, std::uint32_t goal) const;

 private:
  /// Calls visit(tile) for the tiles of an area.
  template <class Visit>
  void for_each_tile(std::uint64_t area, const Visit& visit) const;

  TileGrid grid_;
  SampleRange numbers_;
  std::uint32_t origin_, block_, area_columns_, area_rows_;  ///< an area's size in tiles
  std::uint32_t areas_x_;
  std::uint64_t areas_, blocks_;
};

/// The passes in which samples are rendered. The first takes one sample of every pixel, so that an image that is interrupted
/// soon has no holes; the second another one, from when on the error of all is known; the third completes the first block.
/// `cut` is that of what comes after the first block.
std::vector<WorkPlan> plan_passes(const TileGrid& grid, SampleRange samples,
                                  WorkPlan::Cut cut = WorkPlan::Cut::groups_of_tiles);

/// How to cut what is left: in groups where those have come, and are to come, equally far.
WorkPlan::Cut cut_for(const TileGrid& grid, SampleRange samples, const TileProgress& goal,
                      const TileProgress& progress);

/// Whether an image may have come so far on the way to `goal`: no tile has more, and those that come in one wave of the first
/// block have come equally far.
bool is_possible(const TileGrid& grid, SampleRange samples, const TileProgress& goal, const TileProgress& progress);

}  // namespace norrsken
