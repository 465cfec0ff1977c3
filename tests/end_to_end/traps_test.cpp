// Scenes that once fooled an intersector: merged too much, hid a light behind itself, shadowed themselves. All
// accelerators must show the same picture of them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {
namespace {

double mean_of(const Image& image) {
  double sum = 0;
  for (const Channel& channel : image.channels) {
    for (const float value : channel.values) sum += static_cast<double>(value);
  }
  return sum / (static_cast<double>(image.channels.size()) * image.width * image.height);
}

class Trap : public testing::TestWithParam<std::string> {};

TEST_P(Trap, AllAcceleratorsAgree) {
  const Scene scene = load_test_scene("traps/" + GetParam() + ".xml");
  const auto mean = [&](const char* accelerator) {
    return mean_of(render_image(scene, {.threads = kThreads, .accelerator = accelerator}));
  };
  const double reference = mean("moller_trumbore");
  EXPECT_GT(reference, 0.01);
  // The same random numbers in all: only rays along an edge may differ.
  EXPECT_NEAR(mean("planes"), reference, 1e-3 * reference);
  EXPECT_NEAR(mean("bvh"), reference, 1e-3 * reference);
  EXPECT_NEAR(mean("embree"), reference, 1e-3 * reference);
}

/// The large tilted rectangle at a thousandth of its size has no rounding to speak of.
TEST(LargeTilted, LooksLikeTheSmallOne) {
  const double wanted = 0.1509;
  for (const char* accelerator : {"planes", "moller_trumbore", "bvh", "embree"}) {
    const Scene scene = load_test_scene("traps/large_tilted.xml");
    EXPECT_NEAR(mean_of(render_image(scene, {.threads = kThreads, .accelerator = accelerator})), wanted, 1e-3 * wanted)
        << accelerator;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Trap,
                         testing::Values("lamp_beside_panel", "large_tilted", "panel_above_panel", "small_trapezoid",
                                         "star"),
                         kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
