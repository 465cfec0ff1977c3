// What must not change a picture: instances in place of copies, and the unit that lengths are told in.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {
namespace {

/// The same random numbers: only what rounding decides may differ, here and there a sample at an edge.
void expect_same_picture(const Image& image, const Image& wanted, const std::string& what) {
  ASSERT_EQ(image.channels.size(), wanted.channels.size());
  std::size_t pixels = 0, differing = 0;
  double sum = 0, wanted_sum = 0;
  for (std::size_t c = 0; c < wanted.channels.size(); ++c) {
    const auto &a = image.channels[c].values, &b = wanted.channels[c].values;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ++pixels;
      differing += std::abs(a[i] - b[i]) > 0.01f * std::abs(b[i]) ? 1 : 0;
      sum += static_cast<double>(a[i]), wanted_sum += static_cast<double>(b[i]);
    }
  }
  EXPECT_GT(wanted_sum, 0.05 * static_cast<double>(pixels)) << what;
  EXPECT_LT(differing, pixels / 500) << what;
  EXPECT_NEAR(sum, wanted_sum, 1e-3 * wanted_sum) << what;
}

TEST(Instances, LookLikeCopies) {
  const Image shared = render_image(load_test_scene("instances/shared.xml"), {.threads = kThreads});
  const Image apart = render_image(load_test_scene("instances/apart.xml"), {.threads = kThreads});
  expect_same_picture(shared, apart, "shared and apart");
}

TEST(Instances, AreForEmbreeAlone) {
  const Scene scene = load_test_scene("instances/shared.xml");
  for (const char* accelerator : {"planes", "moller_trumbore"}) {
    EXPECT_THROW(render_image(scene, {.threads = kThreads, .accelerator = accelerator}), std::runtime_error);
  }
}

TEST(Scale, ChangesNothing) {
  const auto picture = [](double scale) {
    return render_image(load_test_scene("scaled.xml", {{"scale", fmt::format("{}", scale)},
                                                       {"eye", fmt::format("{}, {}, {}", scale, -9 * scale, 4 * scale)},
                                                       {"target", fmt::format("0, 0, {}", 0.5 * scale)},
                                                       {"near", fmt::format("{}", 0.01 * scale)},
                                                       {"far", fmt::format("{}", 10000 * scale)}}),
                        {.threads = kThreads});
  };
  const Image wanted = picture(1);
  for (const double scale : {1e-3, 1e3}) expect_same_picture(picture(scale), wanted, fmt::format("scale {}", scale));
}

}  // namespace
}  // namespace norrsken::end_to_end
