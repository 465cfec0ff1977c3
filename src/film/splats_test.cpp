#include "film/splats.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "base/aligned.h"
#include "film/film.h"

namespace norrsken {
namespace {

struct Splat {
  float x, y, value;
  std::uint32_t slot;
};

/// A queue of splats, G twice and B four times as bright as R.
struct SplatQueue {
  AlignedVector<float> values;
  Queue<stored::Splat> queue;

  explicit SplatQueue(const std::vector<Splat>& splats) {
    const auto n = static_cast<std::uint32_t>(splats.size());
    values.resize(std::size_t{queue.kFields} * n);
    queue = {values.data(), n, n};
    queue.count = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float value = splats[i].value;
      queue.set(
          i, {.film = {splats[i].x, splats[i].y}, .radiance = {value, 2 * value, 4 * value}, .slot = splats[i].slot});
    }
  }
};

FilmSettings film_of(int width, int height) {
  FilmSettings settings;
  settings.width = settings.full_width = width;
  settings.height = settings.full_height = height;
  return settings;
}

/// Four samples, one for each replicate, of a film of 5 x 4.
WaveJob whole_film() { return {.width = 5, .height = 4, .sample_count = 4}; }

TEST(Splats, ArePerPathOfTheWholeFilm) {
  Splats splats(film_of(5, 4), {});
  DroppedSamples dropped;
  const WaveJob job = whole_film();
  splats.add(job, SplatQueue({{2.9f, 1.0f, 3, 0}, {2.0f, 1.99f, 5, job.pixel_stride()}}).queue, dropped);
  splats.count_paths(job);
  const PixelEstimate red = splats.estimate(5 + 2, 0), blue = splats.estimate(5 + 2, 2);
  EXPECT_DOUBLE_EQ(red.mean, 8.0 / 80);
  EXPECT_DOUBLE_EQ(blue.mean, 32.0 / 80);
  EXPECT_TRUE(red.known);
  // Replicates of 20 paths with 3, 5, 0 and 0: the variance of their mean.
  const double m = 0.1, spread = (0.15 - m) * (0.15 - m) + (0.25 - m) * (0.25 - m) + 2 * m * m;
  EXPECT_NEAR(red.variance, spread / 3 / 4, 1e-15);
  EXPECT_DOUBLE_EQ(splats.estimate(0, 0).mean, 0);
  EXPECT_EQ(dropped.count, 0u);
}

TEST(Splats, OfAnInterruptedRenderStandForThePathsThatWereTraced) {
  // Replicates of 40, 20, 20 and 20 paths.
  Splats splats(film_of(5, 4), {});
  DroppedSamples dropped;
  splats.add(whole_film(), SplatQueue({{0.5f, 0.5f, 10, 0}}).queue, dropped);
  splats.count_paths(whole_film());
  splats.count_paths({.width = 5, .height = 4, .first_sample = 4, .sample_count = 1});
  EXPECT_DOUBLE_EQ(splats.estimate(0, 0).mean, 10.0 / 100);
  EXPECT_EQ(Splats(film_of(5, 4), {}).estimate(0, 0).mean, 0);
  EXPECT_FALSE(Splats(film_of(5, 4), {}).estimate(0, 0).known);
}

TEST(Splats, LeaveOutWhatIsNotFinite) {
  Splats splats(film_of(5, 4), {});
  DroppedSamples dropped;
  const WaveJob job = whole_film();
  const std::uint32_t path = 2 * 5 + 3, slot = 2 * job.pixel_stride() + path;
  splats.add(job,
             SplatQueue({{0.5f, 0.5f, std::numeric_limits<float>::infinity(), slot},
                         {0.5f, 0.5f, std::numeric_limits<float>::quiet_NaN(), 0},
                         {0.5f, 0.5f, 1, slot}})
                 .queue,
             dropped);
  splats.count_paths(job);
  EXPECT_EQ(dropped.count, 2u);
  EXPECT_EQ(dropped.pixel[0], path);
  EXPECT_EQ(dropped.sample[0], 2u);
  EXPECT_DOUBLE_EQ(splats.estimate(0, 0).mean, 1.0 / 80);
}

/// A tent of radius 1, as src/rfilter tabulates it: nodes, their values, cumulative distribution, guide of one cell, and
/// the integrals to 1/2 and to the end, twice.
FilmSettings tent_film(int width, int height, bool sample_border, std::vector<float>& table) {
  FilmSettings settings = film_of(width, height);
  settings.filter = {.kind = FilterKind::tabulated, .nodes = 2, .cells = 1, .edges = 1};
  settings.sample_border = sample_border;
  table = {0, 1, 2, 0, 0, 1, 0, 0, 0.75f, 1, 0.75f, 1};
  return settings;
}

double value_at(const Splats& splats, int pixel) { return splats.estimate(static_cast<std::uint64_t>(pixel), 0).mean; }

TEST(Splats, CountForEveryPixelWhoseFilterReachesThem) {
  std::vector<float> table;
  for (const bool border : {false, true}) {
    const FilmSettings settings = tent_film(5, 4, border, table);
    Splats splats(settings, table);
    DroppedSamples dropped;
    splats.add(whole_film(), SplatQueue({{2.75f, 1.5f, 80, 0}}).queue, dropped);
    splats.count_paths(whole_film());
    // The tent is 1 - |x| along each axis; both rows 0 and 2 are exactly a pixel away.
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 5; ++x) {
        const double expected = y != 1 ? 0 : x == 2 ? 0.75 : x == 3 ? 0.25 : 0;
        EXPECT_NEAR(value_at(splats, 5 * y + x), expected, 1e-6) << x << ", " << y;
      }
    }
  }
}

TEST(Splats, AtTheEdgeAreDividedByWhatOfTheFilterIsOnTheFilm) {
  std::vector<float> table;
  const FilmSettings inside = tent_film(5, 4, false, table), beyond = tent_film(5, 4, true, table);
  DroppedSamples dropped;
  Splats cut(inside, table), whole(beyond, table);
  for (Splats* splats : {&cut, &whole}) {
    splats->add(whole_film(), SplatQueue({{0.25f, 1.5f, 80, 0}}).queue, dropped);
    splats->count_paths(whole_film());
  }
  EXPECT_NEAR(value_at(whole, 5), 0.75, 1e-6);
  EXPECT_NEAR(value_at(cut, 5), 0.75 / 0.875, 1e-6);  // 7/8 of the tent around the first pixel's centre are on the film
  // From beyond the edge.
  Splats outside(beyond, table);
  outside.add(whole_film(), SplatQueue({{-0.25f, 1.5f, 80, 0}, {5.25f, 4.25f, 80, 0}}).queue, dropped);
  outside.count_paths(whole_film());
  EXPECT_NEAR(value_at(outside, 5), 0.25, 1e-6);
  EXPECT_NEAR(value_at(outside, 19), 0.0625, 1e-6);
}

TEST(Splats, AreAddedToTheFilmsSamples) {
  Film film(film_of(5, 4), SamplerKind::independent);
  const FilmView view = film.view();
  // Pixel 7: two samples of 1 and 3 in red.
  view.counts[7] = 2;
  view.sum_plane(0)[7] = 4;
  view.sum_plane(3)[7] = 10;
  const PixelEstimate before = film.estimate(7, 0);
  Splats splats(film_of(5, 4), {});
  DroppedSamples dropped;
  splats.add(whole_film(), SplatQueue({{2.5f, 1.5f, 80, 0}}).queue, dropped);
  splats.count_paths(whole_film());
  const PixelEstimate added = splats.estimate(7, 0);
  film.add_splats(std::move(splats));
  EXPECT_DOUBLE_EQ(film.estimate(7, 0).mean, 2 + 1);
  EXPECT_DOUBLE_EQ(film.estimate(7, 0).variance, before.variance + added.variance);
  EXPECT_TRUE(film.estimate(7, 0).known);
  EXPECT_FALSE(film.estimate(8, 0).known);  // it has no samples of its own
}

}  // namespace
}  // namespace norrsken
