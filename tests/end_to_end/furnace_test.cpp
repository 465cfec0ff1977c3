// In light that comes alike from everywhere, what scatters all that it gets cannot be seen, and what scatters a part of it
// shows that part.
#include <cmath>

#include "norrsken/image.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;

struct FurnaceCase {
  std::string name, bsdf;
  double shown;  ///< of the surroundings' radiance
  int max_depth;
};
std::ostream& operator<<(std::ostream& out, const FurnaceCase& c) { return out << c.name; }

class Furnace : public SceneFolder, public ::testing::WithParamInterface<FurnaceCase> {};

/// A ball that fills the picture, around which the sky is `sky`.
TEST_P(Furnace, ShowsItsShare) {
  const FurnaceCase& c = GetParam();
  Image even;
  even.width = 16, even.height = 8;
  for (const char* name : {"R", "G", "B"}) even.channel(name).values.assign(128, 2.0f);
  ASSERT_TRUE(write_image(path("even.exr"), even));
  for (const std::string sky : {R"(<emitter type="constant"><float name="radiance" value="2"/></emitter>)",
                                R"(<emitter type="envmap"><string name="filename" value="even.exr"/></emitter>)"}) {
    const Scene scene =
        load_elements("<integrator type=\"path\">" + integer("max_depth", c.max_depth) + "</integrator>" +
                      camera(kSize, {.origin = "0, 0, 1.6"}) + "<shape type=\"sphere\">" + c.bsdf + "</shape>" + sky);
    const auto picture = picture_of(render_image(scene, {.samples_per_pixel = 1024, .threads = kThreads}));
    double mean = 0;
    for (const auto& pixel : picture.pixels) mean += pixel[1] / (kSize * kSize);
    EXPECT_NEAR(mean, 2 * c.shown, 3e-3 * 2 * c.shown) << sky;
  }
}

using EnvironmentAlone = SceneFolder;

/// Nothing in it: every ray sees the sky, with whatever the paths begin.
TEST_F(EnvironmentAlone, ShowsItself) {
  for (const char* integrator : {"path", "direct", "volpath", "ptracer"}) {
    write("sky.xml", std::string("<scene version=\"3.0.0\"><integrator type=\"") + integrator + "\"/>" + camera(kSize) +
                         R"(<emitter type="constant"><float name="radiance" value="2"/></emitter></scene>)");
    Diagnostics warnings;
    const auto scene = told(Scene::load(path("sky.xml"), {}), warnings);
    ASSERT_TRUE(scene);
    for (const char* accel : {"auto", "planes", "bvh", "embree", "moller_trumbore"}) {
      const auto picture =
          picture_of(render_image(*scene, {.samples_per_pixel = 4, .threads = kThreads, .accelerator = accel}));
      for (const auto& pixel : picture.pixels) EXPECT_EQ(pixel[1], 2) << integrator << " " << accel;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Furnace,
    ::testing::Values(FurnaceCase{"diffuse", diffuse("0.7"), 0.7, 2},
                      FurnaceCase{"mirror", R"(<bsdf type="conductor"/>)", 1, 2},
                      FurnaceCase{"glass", R"(<bsdf type="dielectric"/>)", 1, 100},
                      FurnaceCase{"plastic", R"(<bsdf type="plastic"><float name="diffuse_reflectance" value="1"/>
                                  <boolean name="nonlinear" value="true"/></bsdf>)",
                                  1, 2}),
    kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
