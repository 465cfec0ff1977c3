#include "render/sample_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tables/wave_types.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 60, kTaken = 16;

/// Tiles of 16 x 1 pixels with 16 independent samples each, whose deviations are given by tile.
class Allocation : public ::testing::Test {
 protected:
  Allocation() : grid_(kWidth, kHeight, 1024), film_(settings(), SamplerKind::independent) {}

  static FilmSettings settings() {
    FilmSettings s;
    s.width = kWidth, s.height = kHeight;
    return s;
  }
  std::size_t tile(std::uint32_t column, std::uint32_t row) const { return std::size_t{row} * grid_.columns + column; }

  /// Of one column, with so great a deviation; it is 1 elsewhere.
  std::vector<double> spot_of_rows(std::uint32_t first, std::uint32_t end, double deviation) const {
    std::vector<double> deviations(grid_.tile_count(), 1);
    for (std::uint32_t row = first; row < end; ++row) deviations[tile(5, row)] = deviation;
    return deviations;
  }

  void take_samples(const std::vector<double>& deviations) {
    const FilmView film = film_.view();
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const double deviation = deviations[tile(x / grid_.tile_width, y / grid_.tile_height)];
        const std::size_t pixel = std::size_t{y} * kWidth + x;
        film.counts[pixel] = kTaken;
        for (std::uint32_t c = 0; c < 3; ++c) {
          film.sum_plane(c)[pixel] = kTaken;
          film.sum_plane(3 + c)[pixel] = kTaken * (1 + deviation * deviation);
        }
      }
    }
  }
  SampleGoal allocate(std::uint32_t mean) {
    const SampleGoal reached = SampleGoal::uniform(grid_, kTaken, true);
    SampleGoal goal = allocate_samples(grid_, film_, reached, mean);
    EXPECT_LE(goal.total(grid_), std::uint64_t{mean} * kWidth * kHeight);
    for (std::size_t i = 0; i < goal.of_tile.size(); ++i)
      EXPECT_GE(goal.of_tile[i], std::max(kTaken, mean / 2 - 16)) << i;
    return goal;
  }

  TileGrid grid_;
  Film film_;
};

TEST_F(Allocation, HalfOfItGoesWithTheDeviation) {
  ASSERT_EQ(grid_.tile_height, 1u);
  std::vector<double> deviations(grid_.tile_count(), 1);
  for (std::uint32_t row = 0; row < grid_.rows; ++row) {
    for (std::uint32_t column = 0; column < grid_.columns / 2; ++column) deviations[tile(column, row)] = 3;
  }
  take_samples(deviations);
  const SampleGoal goal = allocate(512);
  // Half of the tiles get three times as many of 256: 256 + 384 and 256 + 128, in blocks of 16.
  EXPECT_NEAR(goal.of_tile[tile(1, 7)], 640, 16);
  EXPECT_NEAR(goal.of_tile[tile(8, 7)], 384, 16);
  EXPECT_GT(static_cast<double>(goal.total(grid_)), 0.95 * 512 * kWidth * kHeight);
}

/// A tile's own samples must not decide how many it gets.
TEST_F(Allocation, IsDecidedByTheNeighbors) {
  std::vector<double> deviations = spot_of_rows(20, 25, 30);
  take_samples(deviations);
  const SampleGoal before = allocate(64);
  deviations[tile(5, 22)] = 90;
  take_samples(deviations);
  const SampleGoal goal = allocate(64);
  // Never more; fewer only as its neighbours leave less of the budget to all.
  EXPECT_LE(goal.of_tile[tile(5, 22)], before.of_tile[tile(5, 22)]);
  EXPECT_GT(goal.of_tile[tile(5, 21)], before.of_tile[tile(5, 21)]);
  EXPECT_GT(goal.of_tile[tile(4, 22)], before.of_tile[tile(4, 22)]);
}

/// Its own samples do not decide whether the neighbours are trusted either.
TEST_F(Allocation, TrustIsDecidedByTheOthers) {
  std::vector<double> deviations = spot_of_rows(20, 25, 30);
  deviations[tile(1, 50)] = 300;
  take_samples(deviations);
  const SampleGoal goal = allocate(64);
  // It loses by uneven samples what all others together would not gain.
  EXPECT_EQ(goal.of_tile[tile(5, 21)], goal.of_tile[tile(5, 2)]);
  EXPECT_LT(goal.of_tile[tile(1, 50)], goal.of_tile[tile(5, 2)]);
}

/// A spot of five rows of one column, as a caustic is in a small image: it is found although no other column has any of it.
TEST_F(Allocation, FindsASpotOfAFewRows) {
  take_samples(spot_of_rows(20, 25, 30));
  const SampleGoal goal = allocate(64);
  for (std::uint32_t row = 20; row < 25; ++row) EXPECT_GT(goal.of_tile[tile(5, row)], 200u) << row;
}

/// Rare bright paths: the tiles that have seen one say nothing about those around them.
TEST_F(Allocation, StaysEvenWhereNoiseIsNotThatOfTheNeighbors) {
  for (const std::uint32_t every : {1u, 7u, 41u, 500u}) {
    std::vector<double> deviations(grid_.tile_count(), 1);
    for (std::size_t i = 0; i * every < deviations.size(); ++i) {
      deviations[(i * every * 331 + 100) % deviations.size()] = 5 + static_cast<double>(i * i * 37 % 101);
    }
    take_samples(deviations);
    const SampleGoal goal = allocate(64);
    EXPECT_EQ(goal.of_tile, SampleGoal::uniform(grid_, 64, true).of_tile) << every;
  }
}

/// A step that is not sure of a gain evens out what earlier ones have spread unevenly.
TEST_F(Allocation, EvensOutWhatItIsNotSureOf) {
  std::vector<double> deviations(grid_.tile_count(), 1);
  deviations[tile(5, 7)] = 100;
  take_samples(deviations);
  SampleGoal reached = SampleGoal::uniform(grid_, kTaken, true);
  reached.of_tile[tile(3, 3)] = 64;
  const SampleGoal goal = allocate_samples(grid_, film_, reached, 64);
  EXPECT_EQ(goal.of_tile[tile(3, 3)], 64u);
  EXPECT_EQ(goal.of_tile[tile(5, 7)], 64u);
  EXPECT_EQ(goal.of_tile[tile(5, 8)], 64u);
}

TEST_F(Allocation, WithoutNoiseItIsEven) {
  take_samples(std::vector<double>(grid_.tile_count(), 0));
  const SampleGoal goal = allocate(128);
  EXPECT_TRUE(std::ranges::all_of(goal.of_tile, [](std::uint32_t n) { return n == 128; }));
}

TEST_F(Allocation, NoTileGetsMoreThanSixteenTimesTheMean) {
  take_samples(spot_of_rows(20, 24, 1e6));
  const SampleGoal goal = allocate(64);
  EXPECT_EQ(goal.most(), 16u * 64u);
  EXPECT_EQ(goal.of_tile[tile(5, 20)], goal.of_tile[tile(5, 23)]);
}

class Schedule : public Allocation {
 protected:
  /// Samples per pixel after 10 seconds for `reached`, all taken in that time.
  std::uint32_t next(const RenderOptions& options, std::uint32_t reached, std::uint32_t most = 1u << 20) {
    const auto goal =
        SampleSchedule(options, most)
            .next(grid_, film_, SampleGoal::uniform(grid_, reached, true), 10, static_cast<double>(reached));
    return goal ? goal->mean : reached;
  }
};

TEST_F(Schedule, FillsTheTimeWithWhateverFits) {
  EXPECT_EQ(next({.seconds = 60}, 1), 4u) << "five fit";
  EXPECT_EQ(next({.seconds = 24}, 1), 2u);
  EXPECT_EQ(next({.seconds = 15}, 1), 1u) << "not even one more fits";
  EXPECT_EQ(next({.seconds = 40}, 32), 64u);
  EXPECT_EQ(next({.seconds = 16}, 32), 48u);
  EXPECT_EQ(next({.seconds = 13}, 32), 40u);
  EXPECT_EQ(next({.seconds = 40}, 32, 50), 50u);
}

/// What adaptive sampling has put somewhere stays.
TEST_F(Schedule, EvenGoalsTakeInUnevenOnes) {
  take_samples(std::vector<double>(grid_.tile_count(), 1));
  SampleGoal reached = SampleGoal::uniform(grid_, kTaken, true);
  reached.of_tile[3] = 1000;
  const auto goal = SampleSchedule({.target_error = 0.001}, 1u << 20).next(grid_, film_, reached, 1, 1);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->of_tile[3], 1000u);
  EXPECT_EQ(goal->of_tile[4], 32u);
}

TEST_F(Schedule, AdaptiveWithoutNoiseGoesOn) {
  take_samples(std::vector<double>(grid_.tile_count(), 0));
  EXPECT_EQ(next({.adaptive = true}, kTaken, 4096), 32u);
}

TEST(Outlook, IsThatOfWhatComesFirst) {
  const auto outlook = [](const RenderOptions& options) {
    // 20 samples per pixel in 10 seconds, to an error of 2 %
    return SampleSchedule(options, 100).outlook(10, {0.018, 0.016, 0.02}, 20, 20);
  };
  EXPECT_DOUBLE_EQ(outlook({}).fraction, 0.2);
  EXPECT_DOUBLE_EQ(outlook({}).seconds_left, 40);
  EXPECT_NEAR(outlook({.target_error = 0.01}).fraction, 0.25, 1e-12);
  EXPECT_NEAR(outlook({.target_error = 0.01}).seconds_left, 30, 1e-9);
  EXPECT_DOUBLE_EQ(outlook({.seconds = 15}).fraction, 10.0 / 15);
  EXPECT_DOUBLE_EQ(outlook({.seconds = 15}).seconds_left, 5);
  EXPECT_NEAR(outlook({.target_error = 0.01, .seconds = 15}).seconds_left, 5, 1e-9);
  EXPECT_EQ(SampleSchedule({}, 100).outlook(0.1, {}, 0, 0).seconds_left, -1);
}

}  // namespace
}  // namespace norrsken
