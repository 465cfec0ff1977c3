// One scene, many views of it: what is expensive is made once, and a view renders what the same scene loaded anew with the
// same words would.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 32;
constexpr const char* kRoom = "hexagon_room";

LoadOptions small_room() {
  LoadOptions options;
  options.parameters = {{"shadow_rays", "1"}};
  options.width = options.height = kSize;
  options.samples_per_pixel = 4;
  return options;
}

Scene viewed(const Scene& scene, const ViewOptions& options) {
  Diagnostics diagnostics;
  auto view = told(scene.with(options), diagnostics);
  if (!view || !diagnostics.all().empty()) throw std::runtime_error("the view is complained about");
  return *std::move(view);
}

Property::Transform at(double x, double y, double z) {
  Property::Transform t;
  t.rows[0][3] = x, t.rows[1][3] = y, t.rows[2][3] = z;
  return t;
}

Image rendered(const Scene& scene, RenderOptions options = {}) {
  options.threads = 2;
  return render_image(scene, options);
}

TEST(SceneViews, ASecondRenderingBuildsNothing) {
  const Scene scene = load(kRoom, small_room());
  EXPECT_EQ(scene.structures_built(), 0u);
  const Image first = rendered(scene);
  EXPECT_EQ(scene.structures_built(), 1u);
  EXPECT_TRUE(identical(first, rendered(scene)));
  const Scene other = viewed(scene, {.camera = {{"fov", 40.0}}, .width = 48, .integrator = "direct"});
  rendered(other);
  EXPECT_EQ(scene.structures_built(), 1u);
  EXPECT_EQ(other.structures_built(), 1u);
  rendered(scene, {.accelerator = "moller_trumbore"});
  rendered(other, {.accelerator = "moller_trumbore"});
  EXPECT_EQ(scene.structures_built(), 2u);
}

/// A view against the scene loaded with what says the same.
struct Twin {
  const char* name;
  ViewOptions view;
  void (*load)(LoadOptions&);
};

class ViewTwins : public ::testing::TestWithParam<Twin> {};

TEST_P(ViewTwins, RenderTheSame) {
  LoadOptions options = small_room();
  const Scene scene = load(kRoom, options);
  GetParam().load(options);
  const Scene anew = load(kRoom, options);
  const Scene view = viewed(scene, GetParam().view);
  const Image a = rendered(view), b = rendered(anew);
  EXPECT_TRUE(identical(a, b));
  const SceneInfo one = view.info(), other = anew.info();
  EXPECT_EQ(one.width, other.width);
  EXPECT_EQ(one.samples_per_pixel, other.samples_per_pixel);
  EXPECT_EQ(one.integrator, other.integrator);
  EXPECT_EQ(one.sampler, other.sampler);
  EXPECT_EQ(one.memory.film, other.memory.film);
  ASSERT_EQ(one.items.size(), other.items.size());
  for (std::size_t i = 0; i < one.items.size(); ++i) {
    EXPECT_EQ(one.items[i].plugin, other.items[i].plugin) << i;
    EXPECT_EQ(one.items[i].detail, other.items[i].detail) << i;
  }
  for (const char* key : {"norrsken.integrator", "norrsken.sampler", "norrsken.max_depth", "norrsken.scene_hash"})
    EXPECT_EQ(a.metadata.at(key), b.metadata.at(key));
}

const Twin kTwins[] = {
    {"size", {.width = 40, .height = 24}, [](LoadOptions& o) { o.width = 40, o.height = 24; }},
    {"samples", {.samples_per_pixel = 9}, [](LoadOptions& o) { o.samples_per_pixel = 9; }},
    {"integrator", {.integrator = "direct"}, [](LoadOptions& o) { o.integrator = "direct"; }},
    {"paths_from_the_lights", {.integrator = "ptracer"}, [](LoadOptions& o) { o.integrator = "ptracer"; }},
    {"sampler", {.sampler = "independent"}, [](LoadOptions& o) { o.sampler = "independent"; }},
};
INSTANTIATE_TEST_SUITE_P(, ViewTwins, ::testing::ValuesIn(kTwins), [](const auto& test) { return test.param.name; });

/// A sphere in front of a camera; `camera` are words of the sensor.
std::string sphere_seen_by(const std::string& camera) {
  return R"(<scene version="3.0.0"><sensor type="perspective">)" + camera +
         R"(<film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/>
         <rfilter type="box"/></film><sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>
         <shape type="sphere"><point name="center" x="0" y="0" z="6"/></shape><emitter type="constant"/></scene>)";
}

Scene from_text(const std::string& xml) {
  Diagnostics diagnostics;
  auto scene = told(Scene::load(SceneSource::memory("scene.xml", xml)), diagnostics);
  if (!scene) throw std::runtime_error(to_text(diagnostics.all().front()));
  return *std::move(scene);
}

TEST(SceneViews, TheCameraIsWhatTheWordsOfTheSceneWouldMakeIt) {
  const Scene scene = from_text(sphere_seen_by(R"(<string name="focal_length" value="50mm"/>)"));
  const Scene moved = from_text(sphere_seen_by(
      R"(<float name="fov" value="30"/><transform name="to_world"><translate x="0.5" y="0.25" z="1"/></transform>)"));
  const Scene view = viewed(scene, {.camera = {{"fov", 30.0}, {"to_world", at(0.5, 0.25, 1)}}});
  EXPECT_TRUE(identical(rendered(view), rendered(moved)));
  // What is not said stays, and may be said later.
  const Scene in_steps =
      viewed(viewed(scene, {.camera = {{"fov", 30.0}}}), {.camera = {{"to_world", at(0.5, 0.25, 1)}}});
  EXPECT_TRUE(identical(rendered(in_steps), rendered(moved)));
  EXPECT_FALSE(identical(rendered(scene), rendered(moved)));
}

TEST(SceneViews, ASensorMayBeGivenAsAWhole) {
  const Scene scene = from_text(sphere_seen_by(""));
  Node sensor("sensor", "orthographic");
  sensor.set("to_world", at(0.2, 0, 0));
  const Scene view = viewed(scene, {.sensor_node = sensor});
  EXPECT_EQ(view.info().width, 24) << "the film is the scene's";
  std::string words = sphere_seen_by(R"(<transform name="to_world"><translate x="0.2"/></transform>)");
  words.replace(words.find("perspective"), 11, "orthographic");
  EXPECT_TRUE(identical(rendered(view), rendered(from_text(words))));
}

TEST(SceneViews, ASceneWithoutASensorMayBeLookedAtToo) {
  const Scene scene = from_text(R"(<scene version="3.0.0"><shape type="sphere"/><emitter type="constant"/></scene>)");
  const Scene view = viewed(scene, {.camera = {{"fov", 20.0}}, .width = 16, .height = 16, .samples_per_pixel = 1});
  EXPECT_EQ(view.info().width, 16);
  EXPECT_EQ(view.info().items.size(), scene.info().items.size());
  EXPECT_EQ(rendered(view).find("R")->values.size(), 256u);
}

TEST(SceneViews, ACropIsThePartOfTheWholeImage) {
  const Scene scene = load(kRoom, small_room());
  const Image whole = rendered(scene);
  const Image part = rendered(viewed(scene, {.crop = ViewOptions::Crop{5, 7, 11, 13}}));
  ASSERT_EQ(part.width, 11);
  ASSERT_EQ(part.height, 13);
  // Samples are those of the part's own pixels, so values agree as estimates do, and places exactly: see crop_offset_x.
  LoadOptions options = small_room();
  double of_whole = 0, of_part = 0;
  for (int y = 0; y < 13; ++y) {
    for (int x = 0; x < 11; ++x) {
      of_whole += double{whole.find("G")->values[static_cast<std::size_t>((y + 7) * kSize + x + 5)]};
      of_part += double{part.find("G")->values[static_cast<std::size_t>(y * 11 + x)]};
    }
  }
  EXPECT_NEAR(of_part / of_whole, 1, 0.1);
  // Another size shows the same part.
  const SceneInfo doubled =
      viewed(viewed(scene, {.crop = ViewOptions::Crop{4, 8, 12, 16}}), {.width = 64, .height = 64}).info();
  EXPECT_EQ(doubled.width, 24);
  EXPECT_EQ(doubled.height, 32);
}

std::vector<std::string> complaints(const Scene& scene, const ViewOptions& options) {
  Diagnostics diagnostics;
  const auto view = told(scene.with(options), diagnostics);
  EXPECT_EQ(view.has_value(), !diagnostics.has_errors());
  std::vector<std::string> texts;
  for (const Diagnostic& d : diagnostics.all()) texts.push_back(d.message + " [" + d.accepted + "]");
  return texts;
}

TEST(SceneViews, ComplainAsScenesDo) {
  const Scene scene = load(kRoom, small_room());
  using Texts = std::vector<std::string>;
  EXPECT_EQ(complaints(scene, {.camera = {{"fov", 200.0}}}), Texts{"'fov' is 200 [a number above 0 and below 180]"});
  EXPECT_EQ(complaints(scene, {.crop = ViewOptions::Crop{0, 0, 33, 1}}),
            Texts{"a crop of 33 x 1 at (0, 0) [a part of 32 x 32 pixels]"});
  EXPECT_EQ(complaints(scene, {.samples_per_pixel = 0}),
            Texts{"0 samples per pixel [an integer from 1 to 2147483647]"});
  const Texts unknown = complaints(scene, {.integrator = "pth"});
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_NE(unknown[0].find("did you mean 'path'"), std::string::npos);
  const Texts far = complaints(scene, {.camera = {{"far_clip", 1.5}}});
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0].find("what is farther away than 'far_clip', 1.5, is not seen"), std::string::npos);
}

TEST(SceneViews, RefuseAnIntegratorThatTheLightsWereNotPreparedFor) {
  const Scene scene = from_text(
      R"(<scene version="3.0.0"><integrator type="ptracer"/><sensor type="perspective"/><shape type="rectangle">
      <emitter type="directionalarea"/></shape></scene>)");
  EXPECT_EQ(
      complaints(scene, {.integrator = "path"}),
      std::vector<std::string>{"the lights of the scene were prepared for another integrator than 'path': its paths "
                               "begin at the camera [the scene loaded with that integrator]"});
}

TEST(SceneViews, LayersKeepTrianglesApartThatTheImageDoesNot) {
  const Scene scene = load(kRoom, small_room());
  rendered(scene, {.accelerator = "planes"});
  Node layers("integrator", "aov");
  layers.set("aovs", "uv:uv").add(Node("integrator", "path"));
  const Scene view = viewed(scene, {.integrator_node = layers});
  const Image image = rendered(view, {.accelerator = "planes"});
  EXPECT_EQ(scene.structures_built(), 2u) << "planes for texture coordinates are others";
  ASSERT_NE(image.find("uv.U"), nullptr);
}

TEST(SceneViews, CheckpointsOfAnotherViewAreRefused) {
  const TemporaryFolder folder;
  const Scene scene = load(kRoom, small_room());
  const std::string file = folder.file("room.ckpt");
  rendered(scene, {.checkpoint = file});
  const auto refusal = [&](const ViewOptions& options) {
    const auto render = Render::create(viewed(scene, options), {.checkpoint = file});
    return render ? std::string() : render.error();
  };
  EXPECT_NE(refusal({.camera = {{"fov", 41.0}}}).find("other camera"), std::string::npos);
  EXPECT_NE(refusal({.crop = ViewOptions::Crop{0, 0, 16, 16}}).find("size is"), std::string::npos);
  EXPECT_NE(refusal({.integrator = "direct"}).find("integrator is"), std::string::npos);
  EXPECT_EQ(refusal({}), "");
}

TEST(SceneViews, ImagesTellWhatCameraTheyAreOf) {
  const Scene scene = load(kRoom, small_room());
  EXPECT_EQ(rendered(scene).metadata.count("norrsken.camera"), 0u);
  const Image image = rendered(viewed(scene, {.camera = {{"fov", 41.5}, {"to_world", at(1, 2, 3)}}}));
  EXPECT_EQ(image.metadata.at("norrsken.camera"), "fov=41.5 to_world=1,0,0,1,0,1,0,2,0,0,1,3,0,0,0,1");
}

/// A bumpy square of 2 n^2 triangles.
Mesh bumps(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n), v = static_cast<float>(y) / static_cast<float>(n);
      for (const float c : {2 * u - 1, 2 * v - 1, 3 + 0.05f * static_cast<float>((x * 7 + y * 3) % 5)})
        mesh.positions.push_back(c);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      for (const std::uint32_t v : {a, c, b, b, c, d}) mesh.triangles.push_back(v);
    }
  }
  return mesh;
}

Scene scene_of(Mesh mesh) {
  Description description;
  auto root = std::make_shared<Node>("scene");
  Node sensor("sensor", "perspective"), film("film", "hdrfilm"), sampler("sampler", "independent");
  film.set("width", 64).set("height", 64).add(Node("rfilter", "box"));
  sampler.set("sample_count", 1);
  sensor.add(film).add(sampler);
  root->add(sensor);
  root->add(Node("shape", "mesh").set("mesh", std::move(mesh))).add(Node("emitter", "constant"));
  description.scene = root;
  Diagnostics diagnostics;
  auto scene = told(Scene::build(description), diagnostics);
  if (!scene) throw std::runtime_error(to_text(diagnostics.all().front()));
  return *std::move(scene);
}

// Nothing is built (the counter says so); the time is the least of some, as other programs may run beside.
TEST(SceneViews, AnotherCameraOfAMillionTrianglesStartsAtOnce) {
  const Scene scene = scene_of(bumps(708));
  EXPECT_GE(scene.info().triangles, 1000000u);
  rendered(scene);
  double least = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const auto view = scene.with({.camera = {{"to_world", at(0.01 * i, 0, 0)}}, .width = 1024, .height = 1024});
    ASSERT_TRUE(view);
    const auto render = Render::create(*view, {.threads = 2});
    ASSERT_TRUE(render);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    least = std::min(least, time.count());
  }
  EXPECT_EQ(scene.structures_built(), 1u);
  std::printf("another camera starts after %.3f ms\n", least);
#ifndef NORRSKEN_SANITIZED
  EXPECT_LT(least, 20);
#endif
}

}  // namespace
}  // namespace norrsken::end_to_end
