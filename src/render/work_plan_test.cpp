#include "render/work_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace norrsken {
namespace {

struct Case {
  std::uint32_t width, height;
  SampleRange samples;
  std::uint32_t slots;
};

const Case kCases[] = {{1, 1, {0, 1}, 1024},    {1, 1, {0, 1000}, 1024},      {17, 5, {0, 3}, 256},
                       {100, 3, {0, 33}, 1024}, {33, 70, {0, 16}, 4096},      {3, 200, {5, 155}, 1024},
                       {64, 64, {0, 5}, 512},   {40, 40, {7, 27}, kMaxLanes}, {200, 150, {0, 17}, 1024},
                       {2, 2, {3, 9}, 1024}};

/// Takes what is left of the samples, as the workers do, and counts what comes to each pixel. Stops after `most` waves.
class Film {
 public:
  Film(const TileGrid& grid, std::uint32_t first)
      : grid_(grid), next_(std::size_t{grid.width} * grid.height, first), progress_(grid.tile_count()) {}

  void take(SampleRange samples, std::uint64_t most = ~std::uint64_t{0}) {
    take_towards(TileProgress(grid_.tile_count(), samples.count()), samples, most);
  }
  void take_towards(const TileProgress& goal, SampleRange samples, std::uint64_t most) {
    for (const WorkPlan& plan : plan_passes(grid_, samples, cut_for(grid_, samples, goal, progress_))) {
      for (std::uint64_t i = 0; i < plan.wave_count(); ++i) {
        const std::uint64_t area = plan.area_of(i);
        const std::uint32_t done = plan.progress_of(area, progress_);
        if (plan.block_of(i) < plan.blocks_done(done)) continue;
        const WaveJob job = plan.remaining(plan.wave(i), done, plan.progress_of(area, goal));
        if (job.sample_count == 0) continue;
        if (most-- == 0) return;
        EXPECT_LE(job.slot_count(), std::max(grid_.slots, kMaxLanes));
        take(job);
        plan.set_progress_of(area, plan.end_of(job), progress_);
      }
    }
  }
  const std::vector<std::uint64_t>& next() const { return next_; }
  const TileProgress& progress() const { return progress_; }

 private:
  void take(const WaveJob& job) {
    for (std::uint32_t y = job.y0; y < job.y0 + job.height; ++y) {
      for (std::uint32_t x = job.x0; x < job.x0 + job.width; ++x) {
        ASSERT_LT(x, grid_.width);
        ASSERT_LT(y, grid_.height);
        std::uint64_t& n = next_[std::size_t{y} * grid_.width + x];
        EXPECT_EQ(n, job.first_sample);
        n += job.sample_count;
      }
    }
  }

  TileGrid grid_;
  std::vector<std::uint64_t> next_;  ///< by pixel
  TileProgress progress_;
};

/// The same number of samples for all tiles.
bool is_possible_to(const TileGrid& grid, SampleRange samples, const TileProgress& progress) {
  return is_possible(grid, samples, TileProgress(grid.tile_count(), samples.count()), progress);
}

/// Every sample of every pixel exactly once, a pixel's samples in ascending order, and no wave too large.
TEST(WorkPlan, CoversEverySampleOnceAndInOrder) {
  for (const Case& c : kCases) {
    const TileGrid grid(c.width, c.height, c.slots);
    Film film(grid, c.samples.first);
    film.take(c.samples);
    for (const std::uint64_t n : film.next()) EXPECT_EQ(n, c.samples.end) << c.width << " x " << c.height;
    std::uint64_t pixels = 0;
    for (std::uint64_t tile = 0; tile < grid.tile_count(); ++tile) pixels += grid.pixels_of(tile);
    EXPECT_EQ(pixels, std::uint64_t{c.width} * c.height);
  }
}

/// The same when the work is interrupted anywhere, and more samples are asked for each time.
TEST(WorkPlan, GoesOnFromAnywhere) {
  std::mt19937 random(3);
  for (const Case& c : kCases) {
    const TileGrid grid(c.width, c.height, c.slots);
    for (int run = 0; run < 20; ++run) {
      Film film(grid, c.samples.first);
      SampleRange asked = c.samples;
      for (int part = 0; part < 6; ++part) {
        film.take(asked, random() % 12);
        EXPECT_TRUE(is_possible_to(grid, asked, film.progress()));
        asked.end += static_cast<std::uint32_t>(random() % 20);
        EXPECT_TRUE(is_possible_to(grid, asked, film.progress()))
            << c.width << " x " << c.height << ", now to " << asked.end;
      }
      film.take(asked);
      for (const std::uint64_t n : film.next()) EXPECT_EQ(n, asked.end) << c.width << " x " << c.height;
    }
  }
}

/// Goals of each tile's own, reached with interruptions: no wave is too large, and no tile has more than it is to have.
TEST(WorkPlan, ReachesUnevenGoals) {
  const TileGrid grid(70, 33, 1024);
  std::mt19937 random(5);
  Film film(grid, 0);
  film.take(SampleRange{0, 16});
  TileProgress goal = film.progress();
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t& samples : goal) samples += 16 * static_cast<std::uint32_t>(random() % 9);
    const SampleRange samples{0, *std::ranges::max_element(goal)};
    for (int part = 0; part < 4; ++part) {
      film.take_towards(goal, samples, part < 3 ? random() % 60 : ~std::uint64_t{0});
      EXPECT_TRUE(is_possible(grid, samples, goal, film.progress()));
    }
    EXPECT_EQ(film.progress(), goal);
  }
  for (std::uint64_t tile = 0; tile < grid.tile_count(); ++tile) {
    const std::uint64_t pixel = tile / grid.columns * grid.width + tile % grid.columns * grid.tile_width;
    EXPECT_EQ(film.next()[pixel], goal[tile]);
  }
}

TEST(WorkPlan, FewerSamplesAreAskedForOnlyIfNoneHasMore) {
  const TileGrid grid(200, 150, 1024);
  Film film(grid, 0);
  film.take({0, 40}, 400);
  const std::uint32_t most = *std::ranges::max_element(film.progress());
  ASSERT_EQ(most, 16u);
  EXPECT_TRUE(is_possible_to(grid, {0, most}, film.progress()));
  EXPECT_FALSE(is_possible_to(grid, {0, most - 1}, film.progress()));
}

TEST(WorkPlan, KnowsWhatCannotBe) {
  const TileGrid grid(200, 150, 1024);
  EXPECT_TRUE(is_possible_to(grid, {0, 16}, TileProgress(grid.tile_count())));
  EXPECT_FALSE(is_possible_to(grid, {0, 16}, TileProgress(grid.tile_count() + 1)));
  TileProgress uneven(grid.tile_count());
  uneven[0] = 1;
  EXPECT_FALSE(is_possible_to(grid, {0, 16}, uneven)) << "a tile alone has its first sample";
}

/// An image that is interrupted early has no holes.
TEST(WorkPlan, BeginsWithOneSampleOfEveryPixel) {
  const TileGrid grid(800, 800, 1024);
  const std::vector<WorkPlan> passes = plan_passes(grid, {0, 64});
  ASSERT_EQ(passes.size(), 4u);
  EXPECT_EQ(passes[0].wave_count(), 625u);
  for (std::uint64_t i = 0; i < passes[0].wave_count(); ++i) EXPECT_EQ(passes[0].wave(i).sample_count, 1u);
  EXPECT_EQ(passes[1].wave_count(), 625u);
  EXPECT_EQ(passes[1].wave(0).first_sample, 1u);
  EXPECT_EQ(passes[1].wave(0).sample_count, 1u);
  EXPECT_EQ(passes[2].wave(0).first_sample, 2u);
  EXPECT_EQ(passes[2].wave(0).sample_count, 14u);
  EXPECT_EQ(passes[3].wave(0).sample_count, 16u);
}

}  // namespace
}  // namespace norrsken
