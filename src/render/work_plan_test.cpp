#include "render/work_plan.h"

#include <gtest/gtest.h>

#include <vector>

namespace norrsken {
namespace {

/// Every sample of every pixel exactly once, a pixel's samples in ascending order, and no wave too large.
TEST(WorkPlan, CoversEverySampleOnceAndInOrder) {
  struct Case {
    std::uint32_t width, height;
    std::uint64_t samples;
    std::uint32_t slots;
  };
  for (const Case c :
       {Case{1, 1, 1, 1024}, Case{1, 1, 1000, 1024}, Case{17, 5, 3, 256}, Case{100, 3, 33, 1024},
        Case{33, 70, 16, 4096}, Case{3, 200, 150, 1024}, Case{64, 64, 5, 512}, Case{40, 40, 20, kMaxLanes}}) {
    const WorkPlan plan(c.width, c.height, c.samples, c.slots);
    std::vector<std::uint64_t> next(std::size_t{c.width} * c.height);
    std::vector<std::uint64_t> next_block(plan.tile_count());
    for (std::uint64_t i = 0; i < plan.wave_count(); ++i) {
      const WaveJob job = plan.wave(i);
      EXPECT_LE(job.slot_count(), std::max(c.slots, kMaxLanes));
      EXPECT_EQ(next_block[plan.tile_of(i)]++, plan.block_of(i));
      for (std::uint32_t y = job.y0; y < job.y0 + job.height; ++y) {
        for (std::uint32_t x = job.x0; x < job.x0 + job.width; ++x) {
          ASSERT_LT(x, c.width);
          ASSERT_LT(y, c.height);
          std::uint64_t& n = next[std::size_t{y} * c.width + x];
          EXPECT_EQ(n, job.first_sample);
          n += job.sample_count;
        }
      }
    }
    for (const std::uint64_t n : next) EXPECT_EQ(n, c.samples) << c.width << " x " << c.height;
  }
}

}  // namespace
}  // namespace norrsken
