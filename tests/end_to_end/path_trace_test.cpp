// One sample's path, told vertex by vertex, against the renderings that it is a part of.
#include "norrsken/path_trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

#include "tests/end_to_end/rendering.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSamples = 8;

Triple sum_of_contributions(const PathTrace& path) {
  Triple sum{};
  for (const PathVertex& v : path.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += v.emission[k];
      for (const auto& light : v.light_samples) sum[k] += light.reached ? light.contribution[k] : 0.0f;
    }
  }
  return sum;
}

float distance(const Triple& a, const Triple& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

class TracedPath : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Samplers, TracedPath, ::testing::Values("independent", "sobol"));

TEST_P(TracedPath, IsThatOfTheImage) {
  const LoadOptions load_options{
      .parameters = {{"shadow_rays", "2"}}, .sampler = GetParam(), .width = 20, .height = 20};
  const Scene scene = load("hexagon_room", load_options);
  const RenderOptions options{.samples_per_pixel = kSamples, .seed = 5};
  const Image image = render_image(scene, options);
  for (int pixel = 0; pixel < 400; pixel += 7) {
    const int x = pixel % 20, y = pixel / 20;
    double mean[3] = {};
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      Diagnostics diagnostics;
      const auto path = told(trace_path(scene, options, x, y, s), diagnostics);
      ASSERT_TRUE(path);
      const Triple sum = sum_of_contributions(*path);
      for (std::size_t k = 0; k < 3; ++k) {
        mean[k] += double{path->radiance[k]} / kSamples;
        EXPECT_NEAR(sum[k], path->radiance[k], 1e-5f * (1 + path->radiance[k])) << x << ", " << y << ", sample " << s;
      }
      ASSERT_FALSE(path->vertices.empty());
      EXPECT_EQ(path->vertices[0].throughput, (Triple{1, 1, 1}));
      for (std::size_t i = 1; i < path->vertices.size(); ++i) {
        EXPECT_TRUE(path->vertices[i - 1].hit);
        EXPECT_LT(distance(path->vertices[i].origin, path->vertices[i - 1].position), 1e-4f);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const float value = image.find(std::string_view("RGB").substr(k, 1))->values[static_cast<std::size_t>(pixel)];
      EXPECT_NEAR(value, mean[k], 1e-5 * (1 + mean[k])) << x << ", " << y;
    }
  }
}

TEST(TracedPathErrors, AreTold) {
  Diagnostics diagnostics;
  const Scene scene = load("hexagon_room", {.parameters = {}, .width = 20, .height = 20});
  EXPECT_FALSE(told(trace_path(scene, {}, 20, 3, 0), diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message, "there is no pixel 20, 3");
  EXPECT_EQ(diagnostics.all()[0].accepted, "0, 0 to 19, 19");

  Diagnostics of_lights;
  const Scene particles = load("hexagon_room", {.parameters = {}, .integrator = "ptracer", .width = 20, .height = 20});
  EXPECT_FALSE(told(trace_path(particles, {}, 0, 0, 0), of_lights));
  ASSERT_EQ(of_lights.all().size(), 1u);
  EXPECT_EQ(of_lights.all()[0].message, "the paths of integrator 'ptracer' begin at the lights and belong to no pixel");
}

TEST(TracedPathBsdf, TellsWhatStandsBehindABlend) {
  const Scene scene = load_test_scene("blend_plane.xml");
  Diagnostics diagnostics;
  const auto path = told(trace_path(scene, {}, 4, 4, 0), diagnostics);
  ASSERT_TRUE(path);
  const PathVertex& v = path->vertices.at(0);
  EXPECT_TRUE(v.bsdf == "blendbsdf > diffuse" || v.bsdf == "blendbsdf > roughconductor") << v.bsdf;
  ASSERT_EQ(v.light_samples.size(), 2u);
  EXPECT_NE(v.light_samples[0].bsdf, v.light_samples[1].bsdf);
}

class TracedPathPrimitive : public SceneFolder {};

TEST_F(TracedPathPrimitive, IsTheTriangleThatALayerCounts) {
  // Two triangles in one plane, which count as one where nobody asks.
  const Scene scene = load_elements(R"(<integrator type="aov"><string name="aovs" value="i:prim_index"/>
                                         <integrator type="path"/></integrator>)" +
                                    camera(8) + R"(<shape type="rectangle"/><emitter type="constant"/>)");
  std::set<std::uint32_t> met;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      Diagnostics diagnostics;
      const auto path = told(trace_path(scene, {}, x, y, 0), diagnostics);
      ASSERT_TRUE(path);
      if (path->vertices.at(0).hit) met.insert(path->vertices.at(0).primitive);
    }
  }
  EXPECT_EQ(met.size(), 2u);
}

}  // namespace
}  // namespace norrsken::end_to_end
