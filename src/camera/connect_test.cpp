// Connecting is sampling the other way round: every camera's rays, found again from points on them, and the film that a
// small surface covers.
#include "camera/connect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "camera/models.h"
#include "compile/compile_testing.h"
#include "math/frame.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

using norrsken::testing::Compiled;
using ::testing::IsEmpty;

CameraRecord camera(const std::string& type, const std::string& inside, const std::string& transform = "") {
  const Compiled c = norrsken::testing::compile_sensor(
      "<sensor type=\"" + type + "\">" + inside +
      R"(<float name="near_clip" value="0.5"/><float name="far_clip" value="20"/>)"
      R"(<transform name="to_world">)" +
      transform +
      R"(<lookat origin="1,2,3" target="4,3,1" up="0,0,1"/></transform>)"
      R"(<film type="hdrfilm"><integer name="width" value="200"/><integer name="height" value="100"/>)"
      R"(<rfilter type="box"/></film></sensor>)");
  EXPECT_THAT(c.messages(), IsEmpty());
  return c.tables().camera;
}

double number(Float x) { return static_cast<double>(x.v); }
Vec3f at(const CameraRay& ray, float t) { return fma(ray.direction, Float(t), ray.origin); }

template <class Model>
void expect_rays_to_be_found_again(const CameraRecord& c) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const float px = 200 * unit(random), py = 100 * unit(random), t = 0.2f + 10 * unit(random);
    const Vec2f lens{Float(unit(random)), Float(unit(random))};
    const CameraRay ray = Model::sample(c, Float(px), Float(py), lens);
    const CameraConnection found = Model::connect(c, at(ray, t), lens);
    ASSERT_TRUE(any(found.valid));
    EXPECT_NEAR(number(found.film.x), static_cast<double>(px), 2e-3);
    EXPECT_NEAR(number(found.film.y), static_cast<double>(py), 2e-3);
    const Vec3f gap = found.target - ray.origin;
    EXPECT_LT(std::sqrt(number(dot(gap, gap))), 1e-5);

    // A parallelogram across the line to the camera, whose corners' film positions span its picture. For a lens the
    // line is the one through its sampled point.
    const Vec3f toward = normalize(at(ray, t) - found.target);
    const Frame across = make_frame(toward);
    const float size = 1e-2f * t;
    const auto film = [&](const Vec3f& side, float sign) {
      return Model::connect(c, fma(side, Float(sign * size), at(ray, t)), lens).film;
    };
    const Vec2f s0 = film(across.s, -1), s1 = film(across.s, 1), t0 = film(across.t, -1), t1 = film(across.t, 1);
    const double area = std::abs((number(s1.x) - number(s0.x)) * (number(t1.y) - number(t0.y)) -
                                 (number(s1.y) - number(s0.y)) * (number(t1.x) - number(t0.x)));
    const double size2 = 4 * static_cast<double>(size) * static_cast<double>(size);
    EXPECT_NEAR(area / (size2 * number(found.density)), 1, 2e-2);
  }
}

/// Two cameras of every model of lists/camera.def; a model without any does not link.
template <class Model>
std::array<CameraRecord, 2> cameras();

template <>
std::array<CameraRecord, 2> cameras<Perspective>() {
  return {
      camera("perspective", R"(<float name="fov" value="80"/><float name="principal_point_offset_x" value="0.2"/>)"),
      camera("perspective", R"(<float name="fov" value="25"/><string name="fov_axis" value="y"/>)")};
}
template <>
std::array<CameraRecord, 2> cameras<ThinLens>() {
  return {camera("thinlens", R"(<float name="fov" value="80"/><float name="aperture_radius" value="0.3"/>)"
                             R"(<float name="focus_distance" value="3"/>)"),
          camera("thinlens", R"(<float name="fov" value="60"/><float name="aperture_radius" value="0.8"/>)"
                             R"(<float name="focus_distance" value="12"/>)")};
}
template <>
std::array<CameraRecord, 2> cameras<Orthographic>() {
  // The second is sheared: the film is not perpendicular to the rays.
  return {camera("orthographic", "", R"(<scale x="3" y="0.5" z="1"/>)"),
          camera("orthographic", "", R"(<rotate y="1" angle="30"/><scale x="2" y="1" z="1"/>)")};
}

TEST(Connect, FindsTheRaysOfEveryCamera) {
#define NORRSKEN_CAMERA(kind, Model) \
  for (const CameraRecord& c : cameras<Model>()) expect_rays_to_be_found_again<Model>(c);
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
}

/// Rays of uniform film and lens positions meet a slanting plane with the density that connections from there have, over
/// a rectangle that the whole lens sees.
template <class Model>
void expect_rays_to_have_the_density_of_connections(statistics::StatisticalTest& test, const std::string& kind) {
  constexpr double kFilm = 200 * 100;
  for (const CameraRecord& c : cameras<Model>()) {
    const Vec3f ahead = broadcast(c.forward), beside = normalize(broadcast(c.du)), up = normalize(cross(beside, ahead));
    const Vec3f middle = at(Model::sample(c, Float(100.0f), Float(50.0f), {Float(0.5f), Float(0.5f)}), 5);
    const Vec3f normal = normalize(ahead + beside * Float(0.4f) - up * Float(0.3f));
    const Frame plane = make_frame(normal);
    const auto place = [&](const statistics::Point& p) {
      return fma(plane.s, Float(float(p[0])), fma(plane.t, Float(float(p[1])), middle));
    };
    // The film's half width at the plane, roughly, of which a part is looked at.
    const Vec3f edge = at(Model::sample(c, Float(100.0f), Float(100.0f), {Float(0.5f), Float(0.5f)}), 5) - middle;
    const double reach = 0.3 * std::sqrt(number(dot(edge, edge)));
    const int lens_side = Model::kUsesLens ? 8 : 1;
    const statistics::Sampling sampling{
        {{-reach, -reach}, {reach, reach}},
        {"along the plane", "along the plane"},
        [&](statistics::Random& random) -> std::optional<statistics::Point> {
          const float px = 200 * random(), py = 100 * random(), u = random(), v = random();
          const CameraRay ray = Model::sample(c, Float(px), Float(py), {Float(u), Float(v)});
          const Float t = dot(middle - ray.origin, normal) / dot(ray.direction, normal);
          const Vec3f q = at(ray, t.v) - middle;
          const statistics::Point p{number(dot(q, plane.s)), number(dot(q, plane.t))};
          return std::max(std::abs(p[0]), std::abs(p[1])) < reach ? std::optional(p) : std::nullopt;
        },
        [&](const statistics::Point& p) {
          double sum = 0;
          for (int i = 0; i < lens_side * lens_side; ++i) {
            const auto share = [&](int k) {
              return Float((static_cast<float>(k) + 0.5f) / static_cast<float>(lens_side));
            };
            const Vec3f there = place(p);
            const CameraConnection found = Model::connect(c, there, {share(i % lens_side), share(i / lens_side)});
            EXPECT_TRUE(found.valid.v);
            EXPECT_TRUE(found.film.x.v > 0 && found.film.x.v < 200 && found.film.y.v > 0 && found.film.y.v < 100);
            sum += number(found.density) * std::abs(number(dot(normalize(found.target - there), normal)));
          }
          return sum / (lens_side * lens_side) / kFilm;
        }};
    EXPECT_TRUE(test.follows_density(sampling, kind));
  }
}

TEST(Connect, RaysHaveTheDensityOfConnections) {
  statistics::StatisticalTest test;
#define NORRSKEN_CAMERA(kind, Model) expect_rays_to_have_the_density_of_connections<Model>(test, #kind);
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
}

TEST(Connect, SeesBetweenTheClipPlanesOnly) {
  const auto valid = [](const CameraRecord& c, float depth) {
    const Vec3f p = fma(broadcast(c.forward), Float(depth), broadcast(c.origin));
    const Vec2f middle{Float(0.5f), Float(0.5f)};
    switch (c.kind) {
      case CameraKind::perspective:
        return any(Perspective::connect(c, p, middle).valid);
      case CameraKind::thinlens:
        return any(ThinLens::connect(c, p, middle).valid);
      default:
        return any(Orthographic::connect(c, p, middle).valid);
    }
  };
  for (const CameraRecord& c :
       {camera("perspective", ""), camera("orthographic", ""),
        camera("thinlens", R"(<float name="aperture_radius" value="0.3"/><float name="focus_distance" value="3"/>)")}) {
    for (const float seen : {0.51f, 1.0f, 19.9f}) EXPECT_TRUE(valid(c, seen)) << seen;
    for (const float unseen : {-1.0f, 0.0f, 0.49f, 20.1f}) EXPECT_FALSE(valid(c, unseen)) << unseen;
  }
}

}  // namespace
}  // namespace norrsken::isa_host
