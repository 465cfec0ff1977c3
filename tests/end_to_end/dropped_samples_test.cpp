// Samples whose light is no number that a float can hold: left out, counted, told of, and traced again.
#include <algorithm>
#include <cmath>

#include "norrsken/path_trace.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 24, kSamples = 16;

/// A projector close above a floor, of the brightest light that a scene file may have: 1e18 as a factor and as an
/// irradiance. What arrives grows with the angle, and goes beyond the greatest float within the picture.
std::string floor_under_projector(const std::string& scale, const std::string& sampler) {
  return "<integrator type=\"path\">" + integer("max_depth", 2) + "</integrator>" +
         camera(kSize, {.origin = "0, 0, 0.4"}, "<rfilter type=\"box\"/>", sampler) +
         R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform></shape>
         <emitter type="projector"><float name="fov" value="120"/><float name="scale" value=")" +
         scale + R"("/><rgb name="irradiance" value="1e18, 1e15, 0"/><transform name="to_world">
         <lookat origin="0, 0, 0.1" target="0, 0, 0" up="0, 1, 0"/></transform></emitter>)";
}

class DroppedSamples : public SceneFolder, public ::testing::WithParamInterface<const char*> {
 protected:
  Scene scene(const std::string& scale) const { return load_elements(floor_under_projector(scale, GetParam())); }

  struct Rendered {
    Image image;
    RenderStatistics statistics;
    const std::vector<float>& operator[](const std::string& channel) const { return image.find(channel)->values; }
  };
  static Rendered render(const Scene& scene, const std::string& isa = test_isa()) {
    Diagnostics diagnostics;
    const auto render =
        told(Render::create(scene, {.samples_per_pixel = kSamples, .seed = 4, .threads = 1, .isa = isa}), diagnostics);
    Rendered result;
    result.statistics = render->run();
    result.image = render->image(true);
    return result;
  }
};

TEST_P(DroppedSamples, AreMissingFromTheirPixelsAndFromNothingElse) {
  const Scene bright = scene("1e18");
  // A power of two darker, so that all that is finite is the same but for the exponent.
  const Rendered lost = render(bright), whole = render(scene("9.765625e14"));
  EXPECT_EQ(whole.statistics.dropped_samples, 0u);

  std::uint64_t missing = 0;
  int untouched = 0, touched = 0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    const auto left = static_cast<int>(lost["samples"][i]);
    missing += static_cast<std::uint64_t>(kSamples - left);
    for (const char* channel : {"R", "G", "B"}) ASSERT_TRUE(std::isfinite(lost[channel][i])) << channel << ", " << i;
    if (left == kSamples) {
      untouched += whole["R"][i] > 0;
      for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(lost[channel][i], 1024 * whole[channel][i]) << i;
      continue;
    }
    if (left == 0) continue;
    ++touched;
    // The samples one by one: those that are infinite are the missing ones, and the others' mean is the pixel.
    double sum = 0;
    int finite = 0;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      Diagnostics diagnostics;
      const auto path = told(trace_path(bright, {.samples_per_pixel = kSamples, .seed = 4, .isa = test_isa()},
                                        static_cast<int>(i % kSize), static_cast<int>(i / kSize), s),
                             diagnostics);
      ASSERT_TRUE(path);
      if (!std::isfinite(path->radiance[0])) continue;
      ++finite, sum += double{path->radiance[0]};
    }
    EXPECT_EQ(finite, left) << i;
    EXPECT_NEAR(double{lost["R"][i]}, sum / finite, 1e-6 * sum / finite) << i;
  }
  EXPECT_EQ(lost.statistics.dropped_samples, missing);
  EXPECT_GT(untouched, 10);
  EXPECT_GT(touched, 10);
}

TEST_P(DroppedSamples, AreToldAndTracedAgain) {
  const Scene bright = scene("1e18");
  const RenderStatistics statistics = render(bright).statistics;
  ASSERT_FALSE(statistics.dropped.empty());
  for (const DroppedSample& dropped : statistics.dropped) {
    Diagnostics diagnostics;
    const auto path = told(trace_path(bright, {.samples_per_pixel = kSamples, .seed = 4, .isa = test_isa()}, dropped.x,
                                      dropped.y, dropped.sample),
                           diagnostics);
    ASSERT_TRUE(path);
    EXPECT_TRUE(std::isinf(path->radiance[0]));
    ASSERT_EQ(path->vertices.at(0).light_samples.size(), 1u);
    EXPECT_TRUE(std::isinf(path->vertices[0].light_samples[0].contribution[0]));
    EXPECT_TRUE(std::isfinite(path->vertices[0].light_samples[0].contribution[1]));
  }
}

TEST_P(DroppedSamples, AreTheSameInEveryInstructionSet) {
  const Scene bright = scene("1e18");
  const Rendered wanted = render(bright, "scalar");
  for (const std::string& isa : usable_isas()) {
    const Rendered got = render(bright, isa);
    EXPECT_EQ(got.statistics.dropped_samples, wanted.statistics.dropped_samples) << isa;
    EXPECT_EQ(got["samples"], wanted["samples"]) << isa;
    ASSERT_EQ(got.statistics.dropped.size(), wanted.statistics.dropped.size()) << isa;
    for (std::size_t i = 0; i < wanted.statistics.dropped.size(); ++i) {
      const DroppedSample &a = got.statistics.dropped[i], &b = wanted.statistics.dropped[i];
      EXPECT_TRUE(a.x == b.x && a.y == b.y && a.sample == b.sample) << isa << ", number " << i;
    }
  }
}

/// Seen exactly along the surface that its shading normals tell of, where the cosine is 0 and nothing is scattered.
TEST_P(DroppedSamples, AreNoneWhereTheCosineOfAShadingNormalIsZero) {
  write("sideways.obj", "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
  for (const char* integrator : {"path", "ptracer"}) {
    const Scene sideways = load_elements(
        "<integrator type=\"" + std::string(integrator) + "\">" + integer("max_depth", 3) +
        R"(</integrator><sensor type="orthographic"><transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0"
        up="0, 1, 0"/></transform><sampler type=")" +
        GetParam() + R"("/><film type="hdrfilm">)" + integer("width", kSize) + integer("height", kSize) +
        R"(</film></sensor><shape type="obj"><string name="filename" value="sideways.obj"/></shape>
        <emitter type="point"><point name="position" value="3, 0.5, 2"/></emitter>)");
    for (const std::string& isa : usable_isas()) {
      EXPECT_EQ(render(sideways, isa).statistics.dropped_samples, 0u) << integrator << ", " << isa;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, DroppedSamples, ::testing::Values("independent", "sobol"), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
