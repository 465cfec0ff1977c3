// Where the rays of every camera begin and go, against geometry done by hand.
#include "camera/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "camera/models.h"
#include "compile/compile_testing.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

using norrsken::testing::Compiled;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A 200 x 100 film.
Compiled compile(const std::string& type, const std::string& inside) {
  return norrsken::testing::compile_sensor(
      "<sensor type=\"" + type + "\">" + inside +
      R"(<film type="hdrfilm"><integer name="width" value="200"/><integer name="height" value="100"/>)"
      R"(<rfilter type="box"/></film></sensor>)");
}
std::string number(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}
/// Looks from (1, 2, 3) along +x, with z up.
const std::string kPlaced =
    R"(<transform name="to_world"><lookat origin="1,2,3" target="2,2,3" up="0,0,1"/></transform>)";

void expect_near(const Vec3f& a, double x, double y, double z) {
  EXPECT_NEAR(static_cast<double>(a.x.v), x, 2e-5);
  EXPECT_NEAR(static_cast<double>(a.y.v), y, 2e-5);
  EXPECT_NEAR(static_cast<double>(a.z.v), z, 2e-5);
}
double length(const Vec3f& a) { return std::sqrt(static_cast<double>(dot(a, a).v)); }

template <class Model>
CameraRay ray(const Compiled& c, float px, float py, float u = 0.5f, float v = 0.5f) {
  return Model::sample(c.tables().camera, Float(px), Float(py), {Float(u), Float(v)});
}

TEST(Cameras, PerspectiveRaysMeetInThePinholeAndBeginOnTheNearPlane) {
  const Compiled c = compile("perspective", number("fov", "90") + number("near_clip", "0.5") + kPlaced);
  ASSERT_THAT(c.messages(), IsEmpty());
  const CameraRay r = ray<Perspective>(c, 0, 0);
  expect_near(r.origin, 1.5, 2.5, 3.25);  // left of +x is +y
  EXPECT_NEAR(length(r.direction), 1, 1e-6);
  expect_near(r.direction * Float(1 / r.direction.x.v), 1, 1, 0.5);
}

TEST(Cameras, OrthographicRaysAreParallelAndTwoUnitsApart) {
  const Compiled c = compile("orthographic", number("near_clip", "0.5") + kPlaced);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().camera.kind, CameraKind::orthographic);
  for (const auto& [px, py, y, z] :
       {std::array{0.f, 0.f, 3.f, 3.5f}, std::array{200.f, 100.f, 1.f, 2.5f}, std::array{100.f, 50.f, 2.f, 3.f}}) {
    const CameraRay r = ray<Orthographic>(c, px, py);
    expect_near(r.origin, 1.5, static_cast<double>(y), static_cast<double>(z));
    expect_near(r.direction, 1, 0, 0);
  }
  EXPECT_NEAR(static_cast<double>(distance_to_far_plane(c.tables().camera, {Float(1), Float(0), Float(0)}).v), 9999.5,
              1e-2);
}

TEST(Cameras, OrthographicScales) {
  const Compiled c =
      compile("orthographic", number("near_clip", "1") + number("far_clip", "11") +
                                  R"(<transform name="to_world"><scale x="3" y="2" z="4"/></transform>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const CameraRay r = ray<Orthographic>(c, 0, 0);
  expect_near(r.origin, 3, 1, 4);
  expect_near(r.direction, 0, 0, 1);
  EXPECT_FLOAT_EQ(distance_to_far_plane(c.tables().camera, r.direction).v, 10);
}

TEST(Cameras, ThinLensIsSharpInThePlaneOfFocus) {
  const Compiled c = compile("thinlens", number("fov", "90") + number("aperture_radius", "0.25") +
                                             number("focus_distance", "4") + number("near_clip", "0.5") + kPlaced);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().camera.kind, CameraKind::thinlens);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  statistics::StatisticalTest test;
  statistics::Mean mean_y, mean_r2;
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    const CameraRay r = ray<ThinLens>(c, 50, 25, unit(random), unit(random));
    EXPECT_NEAR(static_cast<double>(r.origin.x.v), 1.5, 1e-5);
    EXPECT_NEAR(length(r.direction), 1, 1e-6);
    // (50, 25) is a quarter of the picture's sides left of and above the middle: 2 and 1 units, 4 units ahead.
    const Vec3f at_focus = fma(r.direction, Float((5 - r.origin.x.v) / r.direction.x.v), r.origin);
    expect_near(at_focus, 5, 4, 4);
    const Vec3f on_lens = fma(r.direction, Float((1 - r.origin.x.v) / r.direction.x.v), r.origin);
    const double y = static_cast<double>(on_lens.y.v) - 2, z = static_cast<double>(on_lens.z.v) - 3;
    EXPECT_LT(std::hypot(y, z), 0.25 + 1e-5);
    mean_y.add(y), mean_r2.add(y * y + z * z);
  }
  // Uniform over a disk.
  EXPECT_TRUE(test.agree(mean_y.estimate(), 0, "y on the lens"));
  EXPECT_TRUE(test.agree(mean_r2.estimate(), 0.25 * 0.25 / 2, "squared radius on the lens"));
}

TEST(Cameras, ThinLensWithoutAFocusIsSharpAtTheFarPlane) {
  const Compiled c = compile("thinlens", number("aperture_radius", "1") + number("far_clip", "500"));
  const CameraRay a = ray<ThinLens>(c, 100, 50, 0.1f, 0.9f);
  const Vec3f far = fma(a.direction, Float((500 - a.origin.z.v) / a.direction.z.v), a.origin);
  EXPECT_NEAR(static_cast<double>(far.x.v), 0, 1e-3);
  EXPECT_NEAR(static_cast<double>(far.y.v), 0, 1e-3);
}

TEST(Cameras, ThinLensNeedsALens) {
  EXPECT_THAT(compile("thinlens", "").messages(),
              ElementsAre("error: sensor 'thinlens' needs a parameter 'aperture_radius' "
                          "[<float name=\"aperture_radius\" value=\"...\"/>]"));
  EXPECT_THAT(compile("thinlens", number("aperture_radius", "0")).messages(),
              ElementsAre("error: 'aperture_radius' is 0 [a number above 0]"));
  EXPECT_THAT(compile("thinlens", number("aperture_radius", "30") + number("focus_distance", "0.001")).messages(),
              ElementsAre("error: 'aperture_radius' is 30000 times 'focus_distance' "
                          "[an aperture_radius of at most 10000 times focus_distance, here 10]"));
  EXPECT_THAT(compile("thinlens", number("aperture_radius", "1") + number("focus_distance", "-1")).messages(),
              ElementsAre("error: 'focus_distance' is -1 [a number above 0]"));
  EXPECT_THAT(compile("thinlens", number("aperture_radius", "1") + number("aperture", "2")).messages(),
              ElementsAre("error: unused parameter 'aperture' of sensor 'thinlens' [aperture_radius, far_clip, "
                          "focal_length, focus_distance, fov, fov_axis, near_clip, to_world]"));
}

TEST(Cameras, OrthographicTakesNoAngle) {
  EXPECT_THAT(compile("orthographic", number("fov", "40")).messages(),
              ElementsAre("error: unused parameter 'fov' of sensor 'orthographic' [far_clip, near_clip, to_world]"));
  const Compiled farthest = compile("perspective", number("far_clip", "3.4e38"));
  EXPECT_THAT(farthest.messages(),
              ElementsAre("note: 'far_clip' is 3.4e+38, which is taken for 8e+12 [a number of at most 8e+12]"));
  EXPECT_FLOAT_EQ(farthest.tables().camera.far_clip, 8e12f);
  EXPECT_THAT(compile("orthographic", number("near_clip", "3") + number("far_clip", "2")).messages(),
              ElementsAre("error: 'near_clip' is 3, but 'far_clip' is 2 [a near_clip smaller than the far_clip]"));
}

}  // namespace
}  // namespace norrsken::isa_host
