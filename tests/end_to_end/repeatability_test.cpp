// The same scene, settings and seed give the same bits, however many threads render them; other seeds do not.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/room.h"

namespace norrsken::end_to_end {
namespace {

/// Share of the samples of R, G, B in which two images differ.
double differing_share(const Image& a, const Image& b) {
  const auto x = picture_of(a), y = picture_of(b);
  double differing = 0;
  for (std::size_t i = 0; i < x.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) differing += x.pixels[i][c] != y.pixels[i][c] ? 1 : 0;
  }
  return differing / static_cast<double>(3 * x.pixels.size());
}

struct Case {
  std::string name, sampler, light, accelerator;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Repeatability : public ::testing::TestWithParam<Case> {
 protected:
  Image render(int threads, std::uint64_t seed, const std::string& isa = "auto", int samples = 19) const {
    const Case& c = GetParam();
    // An odd size, so that tiles at the border are cut.
    const Scene scene = load(
        "hexagon_room",
        {.parameters = {{"light", c.light}, {"shadow_rays", "2"}}, .sampler = c.sampler, .width = 93, .height = 71});
    return render_image(scene,
                        {.samples_per_pixel = samples,
                         .seed = seed,
                         .threads = threads,
                         .isa = isa,
                         .accelerator = c.accelerator,
                         .features = true},
                        true);
  }
};

TEST_P(Repeatability, ThreadCountDoesNotChangeABit) {
  const Image one = render(1, 42);
  EXPECT_GT(one.channels.size(), 3u);
  for (const int threads : {1, 2, 7, 64}) EXPECT_TRUE(identical(one, render(threads, 42))) << threads << " threads";
}

TEST_P(Repeatability, EveryInstructionSetRepeatsItself) {
  for (const std::string& isa : usable_isas()) EXPECT_TRUE(identical(render(1, 42, isa), render(2, 42, isa))) << isa;
}

/// They round differently, so that now and then a path takes another turn; the same random numbers keep nearly all
/// others.
TEST_P(Repeatability, InstructionSetsAgreeInTheMean) {
  const auto mean_of = [this](const std::string& isa) {
    double sum = 0;
    for (const auto& pixel : picture_of(render(2, 42, isa, 64)).pixels) sum += pixel[0] + pixel[1] + pixel[2];
    return sum;
  };
  const double expected = mean_of("scalar");
  for (const std::string& isa : usable_isas()) {
    const double apart = std::abs(mean_of(isa) / expected - 1);
    std::printf("%s: %.1e from scalar\n", isa.c_str(), apart);
    EXPECT_LT(apart, 1e-5) << isa;
  }
}

TEST_P(Repeatability, SeedsDiffer) {
  const Image a = render(2, 1);
  // Light is seen directly in few pixels; all others vary, and so does the sum of nearly every pixel's samples.
  EXPECT_GT(differing_share(a, render(2, 2)), 0.9);
  EXPECT_GT(differing_share(a, render(2, std::uint64_t{1} << 32 | 1)), 0.9) << "the seed has 64 bits";
}

INSTANTIATE_TEST_SUITE_P(, Repeatability,
                         ::testing::Values(Case{"sobol", "sobol", "area", "auto"},
                                           Case{"independent", "independent", "area", "auto"},
                                           Case{"bvh", "sobol", "point", "bvh"},
                                           Case{"embree", "sobol", "point", "embree"}),
                         kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
