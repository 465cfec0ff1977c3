// Light along normals: where its rays begin, where they go, what they carry; and that nothing else finds it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "light/emit_lights.h"
#include "light/lit_scene_testing.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

const glm::dvec3 kUp(0, 0, 1);

/// Emits from one random point and hands over the ray, again and again.
template <class Check>
void for_emitted_rays(const LitScene& scene, const Check& check) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  const auto pair = [&] { return Vec2f{float(unit(random)), float(unit(random))}; };
  for (int i = 0; i < 1000; ++i) {
    const EmittedRay ray = emit_from_lights(scene.view, pair(), pair(), pair(), kOn);
    ASSERT_TRUE(ray.valid.v);
    check(doubles(ray.origin), doubles(ray.direction), double{ray.weight.r.v});
  }
}
LitScene along_normals(const std::string& shape, const norrsken::testing::Files& files = {}) {
  return LitScene(R"(<integrator type="ptracer"/><shape type=")" + shape +
                      R"(<emitter type="directionalarea"><float name="radiance" value="3"/></emitter></shape>)",
                  files);
}

TEST(AlongNormals, APlaneSendsParallelRays) {
  const LitScene scene =
      along_normals(R"(rectangle"><transform name="to_world"><scale x="2"/><translate z="1"/></transform>)");
  statistics::StatisticalTest test;
  statistics::Mean x2, y2;
  for_emitted_rays(scene, [&](const glm::dvec3& o, const glm::dvec3& d, double weight) {
    EXPECT_NEAR(glm::length(d - kUp), 0, 1e-6);
    EXPECT_NEAR(o.z, 1, 1e-4);
    x2.add(o.x * o.x), y2.add(o.y * o.y);
    EXPECT_NEAR(weight, 3 * 8, 1e-4);  // radiance times area
  });
  EXPECT_TRUE(test.agree(x2.estimate(), 4.0 / 3, "square of x"));
  EXPECT_TRUE(test.agree(y2.estimate(), 1.0 / 3, "square of y"));
}

TEST(AlongNormals, ASphereSendsAFan) {
  for (const bool flipped : {false, true}) {
    const LitScene scene =
        along_normals(R"(sphere"><float name="radius" value="2"/><boolean name="flip_normals" value=")" +
                      std::string(flipped ? "true" : "false") + R"("/>)");
    for_emitted_rays(scene, [&](const glm::dvec3& o, const glm::dvec3& d, double weight) {
      EXPECT_NEAR(glm::dot(o / 2.0, d), flipped ? -1 : 1, 1e-4);
      EXPECT_NEAR(weight, 3 * 16 * M_PI, 1e-2);
    });
  }
}

TEST(AlongNormals, ADiskAndACylinderHaveTheirs) {
  for_emitted_rays(along_normals(R"(disk"><boolean name="flip_normals" value="true"/>)"),
                   [&](const glm::dvec3&, const glm::dvec3& d, double weight) {
                     EXPECT_NEAR(glm::length(d + kUp), 0, 1e-6);
                     EXPECT_NEAR(weight, 3 * M_PI, 1e-3);
                   });
  for_emitted_rays(along_normals(R"(cylinder">)"), [&](const glm::dvec3& o, const glm::dvec3& d, double weight) {
    EXPECT_NEAR(glm::length(d - glm::dvec3(o.x, o.y, 0)), 0, 1e-3);
    EXPECT_NEAR(weight, 3 * 2 * M_PI, 1e-3);
  });
}

TEST(AlongNormals, ASmoothMeshHasThoseOfItsVertices) {
  // n = (x, y, 1), normalised, at each corner and hence, before it is normalised, in between.
  const LitScene scene = along_normals(R"(obj"><string name="filename" value="a.obj"/>)",
                                       {{"a.obj",
                                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 1\nvn 1 1 1\nvn 0 1 "
                                         "1\nf 1//1 2//2 3//3\nf 1//1 3//3 4//4\n"}});
  const auto corner = [](double x, double y) { return glm::normalize(glm::dvec3(x, y, 1)); };
  for_emitted_rays(scene, [&](const glm::dvec3& o, const glm::dvec3& d, double weight) {
    const double far = std::max(o.x, o.y), near = std::min(o.x, o.y);
    const glm::dvec3 side = o.x > o.y ? corner(1, 0) : corner(0, 1);
    const glm::dvec3 normal = (1 - far) * kUp + (far - near) * side + near * corner(1, 1);
    EXPECT_NEAR(glm::length(d - glm::normalize(normal)), 0, 1e-4);
    EXPECT_NEAR(weight, 3, 1e-4);
  });
}

TEST(AlongNormals, NothingElseFindsIt) {
  const LitScene scene = along_normals(R"(rectangle">)");
  EXPECT_FALSE(scene.sample({0, 0, 1}, 0.5, 0.5).valid.v);
  EXPECT_EQ(light_pdf_sa(scene.view, UInt(0u), lanes({0, 0, 1}), lanes(-kUp), 1.0f, kOn).v, 0);
}

}  // namespace
}  // namespace norrsken::isa_host
