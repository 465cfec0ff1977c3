// Finished slots into the film's sums, on made-up values that add up exactly.
#include "wave/stage_testing.h"

namespace norrsken {
namespace {

/// A film of 4 x 3 pixels; sums for either kind of sampler.
struct SmallFilm {
  static constexpr std::uint32_t kPixels = 12, kPlanes = 6;
  std::vector<double> high = std::vector<double>(kPlanes * kPixels), low = high;
  std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(kPixels);
  FilmView view;

  SmallFilm() {
    view.sums = {high.data(), low.data()};
    view.counts = counts.data();
    view.width = 4, view.height = 3;
  }
  double sum(std::uint32_t plane, std::uint32_t x, std::uint32_t y) const {
    return high[plane * kPixels + y * 4 + x] + low[plane * kPixels + y * 4 + x];
  }
};

/// The right lower 2 x 2 pixels, samples 5 and 6. Pixel p's sample s has the red value 1 + p + 10 s, and so on.
constexpr WaveJob kJob{.x0 = 2, .y0 = 1, .width = 2, .height = 2, .first_sample = 5, .sample_count = 2};
float value(std::uint32_t pixel, std::uint32_t s, std::uint32_t channel) {
  return static_cast<float>(1 + pixel + 10 * s + 100 * channel);
}
void fill(StageMemory& m) {
  m.memory.slots.count = kJob.slot_count();
  for (std::uint32_t s = 0; s < 2; ++s) {
    for (std::uint32_t p = 0; p < 4; ++p) {
      stored::Slot slot{};
      slot.weight = 0.5f;
      for (std::uint32_t c = 0; c < 3; ++c) slot.radiance[c] = value(p, s, c);
      m.memory.slots.set(s * kJob.pixel_stride() + p, slot);
    }
  }
}

void for_every_film(const auto& test) {
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    StageMemory m(kJob.slot_count());
    fill(m);
    SmallFilm film;
    test(**k, m, film);
  }
}

TEST(AccumulateFilm, AddsValuesAndSquaresOfIndependentSamples) {
  for_every_film([](const KernelEntry& kernels, StageMemory& m, SmallFilm& film) {
    DroppedSamples dropped;
    kernels.accumulate_film(kJob, SamplerKind::independent, m.memory.slots, film.view, dropped);
    EXPECT_EQ(dropped.count, 0u);
    for (std::uint32_t p = 0; p < 4; ++p) {
      const std::uint32_t x = 2 + p % 2, y = 1 + p / 2;
      EXPECT_EQ(film.counts[y * 4 + x], 2u) << kernels.name;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const double a = double{value(p, 0, c)}, b = double{value(p, 1, c)};
        EXPECT_EQ(film.sum(c, x, y), a + b) << kernels.name;
        EXPECT_EQ(film.sum(3 + c, x, y), a * a + b * b) << kernels.name;
      }
    }
    EXPECT_EQ(film.sum(0, 0, 0), 0) << kernels.name << ": beyond the job";
    EXPECT_EQ(film.counts[0], 0u) << kernels.name;
  });
}

TEST(AccumulateFilm, KeepsTheReplicatesOfSobolPointsApart) {
  for_every_film([](const KernelEntry& kernels, StageMemory& m, SmallFilm& film) {
    DroppedSamples dropped;
    kernels.accumulate_film(kJob, SamplerKind::sobol, m.memory.slots, film.view, dropped);
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      // Sample 5 belongs to replicate 1, sample 6 to replicate 0.
      const double wanted = double{value(3, 1 - r, 1)};
      EXPECT_EQ(film.sum(3 * r + 1, 3, 2), wanted) << kernels.name << ", replicate " << r;
    }
  });
}

TEST(AccumulateFilm, LeavesOutAndCountsWhatIsNotFinite) {
  for_every_film([](const KernelEntry& kernels, StageMemory& m, SmallFilm& film) {
    m.memory.slots.field(&stored::Slot::radiance, 2)[kJob.pixel_stride() + 1] = INFINITY;
    DroppedSamples dropped;
    kernels.accumulate_film(kJob, SamplerKind::independent, m.memory.slots, film.view, dropped);
    ASSERT_EQ(dropped.count, 1u) << kernels.name;
    EXPECT_EQ(dropped.pixel[0], 1u * 4 + 3) << kernels.name;
    EXPECT_EQ(dropped.sample[0], 6u) << kernels.name;
    EXPECT_EQ(film.counts[4 + 3], 1u | kSomeDropped) << kernels.name;
    EXPECT_EQ(film.sum(0, 3, 1), double{value(1, 0, 0)}) << kernels.name;
    EXPECT_EQ(film.sum(0, 2, 1), double{value(0, 0, 0)} + double{value(0, 1, 0)}) << kernels.name;
  });
}

TEST(AccumulateFilm, WeighsSamplesAsTheFilterSays) {
  for_every_film([](const KernelEntry& kernels, StageMemory& m, SmallFilm& film) {
    film.view.weighted = true;
    DroppedSamples dropped;
    kernels.accumulate_film(kJob, SamplerKind::independent, m.memory.slots, film.view, dropped);
    EXPECT_EQ(film.sum(0, 2, 1), 0.5 * (double{value(0, 0, 0)} + double{value(0, 1, 0)})) << kernels.name;
  });
}

}  // namespace
}  // namespace norrsken
