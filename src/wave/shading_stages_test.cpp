// Stages that shade, each alone on made-up queues, against formulas of a line.
#include "tests/statistics/statistical_test.h"
#include "wave/stage_testing.h"

namespace norrsken {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint32_t kDiffuse = static_cast<std::uint32_t>(BsdfKind::diffuse);

/// Veach's power heuristic of one sample each.
double power_heuristic(double pdf, double other) { return pdf * pdf / (pdf * pdf + other * other); }

std::array<double, 3> times(const std::array<double, 3>& color, double factor) {
  return {color[0] * factor, color[1] * factor, color[2] * factor};
}

/// The rays' hits, found by the stage before.
void find_hits(const KernelProbe& probe, const SceneView& scene, StageMemory& m) {
  probe.intersect_closest(scene, false, ~1u, m.memory.rays, m.memory.slots, m.memory.found);
}

TEST(ShadeMiss, AddsTheEnvironmentsRadianceTimesTheThroughput) {
  const auto scene = scene_of(facing_square(1, diffuse("0.5")) +
                              R"(<emitter type="constant"><rgb name="radiance" value="2, 3, 5"/></emitter>)");
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(2);
    stored::Ray ray = ray_along({0, 0, 0}, unit(1, 2, -1));
    ray.throughput = {0.5f, 0.25f, 2};
    m.push(m.memory.found.misses, ray);
    ray.slot = 1;
    ray.pdf_sa = 0.7f;
    m.push(m.memory.found.misses, ray);
    probe.shade_miss(scene->view, m.memory.found.misses, m.memory.slots);
    expect_near(m.radiance(0), {1, 0.75, 10}, isa);
    // The environment is sampled too, evenly over the sphere.
    expect_near(m.radiance(1), times({1, 0.75, 10}, power_heuristic(0.7, 0.25 / kPi)), isa);
  });
}

TEST(ShadeEmission, AddsTheLightsRadianceWithTheWeightOfWhatFoundIt) {
  const auto scene = scene_of(facing_square(3, area_light("2, 3, 5")));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(3);
    const Triple slanting = unit(0.5, 0.25, 2);
    stored::Ray ray = ray_along({0, 0, 1}, slanting);
    m.push(m.memory.rays, ray);
    ray.slot = 1;
    ray.throughput = {0.5f, 0.25f, 2};
    ray.pdf_sa = 0.3f;
    m.push(m.memory.rays, ray);
    ray = ray_along({0.5f, 0.25f, 5}, {0, 0, -1});  // its back, which does not emit
    ray.slot = 2;
    m.push(m.memory.rays, ray);
    find_hits(probe, scene->view, m);
    ASSERT_EQ(m.memory.found.light_hits.count, 2u) << isa;
    probe.shade_emission(scene->view, m.memory.found.light_hits, m.memory.slots);
    expect_near(m.radiance(0), {2, 3, 5}, isa);
    // Light sampling finds the point with the density distance^2 / (area cos).
    const double cosine = double{slanting[2]}, distance = 2 / cosine, light_pdf = distance * distance / (4 * cosine);
    expect_near(m.radiance(1), times({1, 0.75, 10}, power_heuristic(double{0.3f}, light_pdf)), isa);
    EXPECT_EQ(m.radiance(2), (Triple{0, 0, 0})) << isa;
  });
}

/// A hit at (0.5, 0.25, 1), under 60 degrees to the normal (0, 0, -1).
const Triple kSlanting = unit(std::sqrt(3.0), 0, 1);
stored::Ray slanting_ray(std::uint32_t slot) {
  stored::Ray ray = ray_along({0.5f - std::sqrt(3.0f), 0.25f, 0}, kSlanting);
  ray.throughput = {1, 0.5f, 0.25f};
  ray.slot = slot;
  return ray;
}

TEST(ShadeSurface, ADiffuseHitSendsAShadowRayToThePoint) {
  const auto scene =
      scene_of(facing_square(1, diffuse("0.8, 0.4, 0.2")) + point_light(R"(x="0.5" y="3.25" z="-3")", "7"));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m;
    m.push(m.memory.rays, slanting_ray(0));
    find_hits(probe, scene->view, m);
    probe.shade_surface(scene->view, BsdfKind::diffuse, 1, false, m.memory.found.hits[kDiffuse], m.memory.slots,
                        m.memory.shadow_rays, m.memory.next_rays);
    ASSERT_EQ(m.memory.shadow_rays.count, 1u) << isa;
    const stored::ShadowRay ray = m.memory.shadow_rays[0];
    // The point is (0, 3, -4) away, so 5.
    expect_near(ray.origin, {0.5, 0.25, 1}, isa);
    EXPECT_LT(ray.origin[2], 1.0f) << isa << ": off the surface, on its front";
    expect_near(ray.direction, {0, 0.6, -0.8}, isa);
    EXPECT_NEAR(ray.t_max, 5, 1e-4) << isa;
    EXPECT_EQ(ray.slot, 0u) << isa;
    // Throughput times reflectance / pi times the cosine times intensity / distance^2.
    expect_near(ray.contribution, times({0.8, 0.2, 0.05}, 1 / kPi * 0.8 * 7 / 25), isa);
  });
}

TEST(ShadeSurface, AShadowRayToAnAreaHasTheWeightOfItsPoint) {
  const auto scene = scene_of(facing_square(1, diffuse("0.8, 0.4, 0.2")) +
                              R"(<shape type="rectangle"><transform name="to_world"><translate z="-1"/></transform>)" +
                              area_light("2, 3, 5") + "</shape>");
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(16);
    for (std::uint32_t s = 0; s < 16; ++s) m.push(m.memory.rays, slanting_ray(s));
    find_hits(probe, scene->view, m);
    probe.shade_surface(scene->view, BsdfKind::diffuse, 1, false, m.memory.found.hits[kDiffuse], m.memory.slots,
                        m.memory.shadow_rays, m.memory.next_rays);
    ASSERT_EQ(m.memory.shadow_rays.count, 16u) << isa;
    for (std::uint32_t i = 0; i < 16; ++i) {
      const stored::ShadowRay ray = m.memory.shadow_rays[i];
      const double cosine = -double{ray.direction[2]}, distance = double{ray.t_max};
      EXPECT_NEAR(distance * cosine, 2, 1e-4) << isa << ": the light's plane";
      // Both cosines are the same, for the surfaces are parallel; the area is 4.
      const double light_pdf = distance * distance / (4 * cosine), bsdf_pdf = cosine / kPi;
      const double weight = power_heuristic(light_pdf, bsdf_pdf) / light_pdf;
      const double scattered = cosine / kPi * weight;
      expect_near(ray.contribution, {0.8 * 2 * scattered, 0.2 * 3 * scattered, 0.05 * 5 * scattered}, isa);
    }
  });
}

TEST(ShadeSurface, ADiffuseHitsNextRayTakesItsReflectance) {
  const auto scene =
      scene_of(facing_square(1, diffuse("0.8, 0.4, 0.2")) + point_light(R"(x="0.5" y="3.25" z="-3")", "7"));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    constexpr std::uint32_t kCount = 100;
    StageMemory m(kCount);
    for (std::uint32_t s = 0; s < kCount; ++s) m.push(m.memory.rays, slanting_ray(s));
    find_hits(probe, scene->view, m);
    probe.shade_surface(scene->view, BsdfKind::diffuse, 1, false, m.memory.found.hits[kDiffuse], m.memory.slots,
                        m.memory.shadow_rays, m.memory.next_rays);
    ASSERT_EQ(m.memory.next_rays.count, kCount) << isa;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const stored::Ray ray = m.memory.next_rays[i];
      EXPECT_EQ(ray.slot, i) << isa << ": in the order of the hits";
      expect_near(ray.throughput, {0.8, 0.2, 0.05}, isa);
      EXPECT_NEAR(dot(ray.direction, ray.direction), 1, 1e-6) << isa;
      EXPECT_LT(ray.direction[2], 0.0f) << isa;
      EXPECT_NEAR(ray.pdf_sa, -double{ray.direction[2]} / kPi, 1e-6) << isa;
    }
  });
}

/// What survives is divided by the probability of it: the largest component of the throughput.
TEST(ShadeSurface, RouletteKeepsTheMeanThroughput) {
  const auto scene = scene_of(facing_square(1, diffuse("0.8, 0.4, 0.2")) + far_light());
  ASSERT_TRUE(scene);
  constexpr std::uint32_t kCount = 4096;
  statistics::Mean green;
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(kCount);
    for (std::uint32_t s = 0; s < kCount; ++s) m.push(m.memory.rays, slanting_ray(s));
    find_hits(probe, scene->view, m);
    probe.shade_surface(scene->view, BsdfKind::diffuse, 1, true, m.memory.found.hits[kDiffuse], m.memory.slots,
                        m.memory.shadow_rays, m.memory.next_rays);
    ASSERT_LT(m.memory.next_rays.count, kCount) << isa;
    green = {};
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const bool survives = i < m.memory.next_rays.count;
      if (survives) expect_near(m.memory.next_rays[i].throughput, {1, 0.25, 0.0625}, isa);
      green.add(survives ? double{m.memory.next_rays[i].throughput[1]} : 0.0);
    }
  });
  // The same numbers in every instruction set: one of them is judged.
  statistics::StatisticalTest test;
  EXPECT_TRUE(test.agree(green.estimate(), 0.2, "mean throughput", 1e-5));
}

TEST(ShadeSurface, OneOfTwoLightsStandsForBoth) {
  const auto scene =
      scene_of(facing_square(1, diffuse("0.8, 0.4, 0.2")) + point_light(R"(x="0.5" y="3.25" z="-3")", "7") +
               point_light(R"(x="0.5" y="-2.75" z="-3")", "7"));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(64);
    for (std::uint32_t s = 0; s < 64; ++s) m.push(m.memory.rays, slanting_ray(s));
    find_hits(probe, scene->view, m);
    probe.shade_surface(scene->view, BsdfKind::diffuse, 1, false, m.memory.found.hits[kDiffuse], m.memory.slots,
                        m.memory.shadow_rays, m.memory.next_rays);
    ASSERT_EQ(m.memory.shadow_rays.count, 64u) << isa;
    std::uint32_t above = 0;
    for (std::uint32_t i = 0; i < 64; ++i) {
      const stored::ShadowRay ray = m.memory.shadow_rays[i];
      above += ray.direction[1] > 0 ? 1 : 0;
      // Each is 5 away, under the same angle, and chosen every other time.
      expect_near(ray.contribution, times({0.8, 0.2, 0.05}, 2 / kPi * 0.8 * 7 / 25), isa);
    }
    EXPECT_TRUE(above > 0 && above < 64) << isa << ": both are chosen";
  });
}

TEST(ShadeSurface, AMirrorSendsOneRayAndAsksNoLight) {
  const auto scene = scene_of(facing_square(1, R"(<bsdf type="conductor"><string name="material" value="none"/>)"
                                               R"(<rgb name="specular_reflectance" value="0.8, 0.4, 0.2"/></bsdf>)") +
                              point_light(R"(x="0.5" y="3.25" z="-3")", "7"));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m;
    m.push(m.memory.rays, slanting_ray(0));
    find_hits(probe, scene->view, m);
    const auto& hits = m.memory.found.hits[static_cast<std::size_t>(BsdfKind::conductor)];
    ASSERT_EQ(hits.count, 1u) << isa;
    probe.shade_surface(scene->view, BsdfKind::conductor, 1, false, hits, m.memory.slots, m.memory.shadow_rays,
                        m.memory.next_rays);
    EXPECT_EQ(m.memory.shadow_rays.count, 0u) << isa;
    ASSERT_EQ(m.memory.next_rays.count, 1u) << isa;
    const stored::Ray ray = m.memory.next_rays[0];
    expect_near(ray.direction, {double{kSlanting[0]}, 0, -double{kSlanting[2]}}, isa);
    expect_near(ray.throughput, {0.8, 0.2, 0.05}, isa);
    EXPECT_EQ(ray.pdf_sa, 0.0f) << isa << ": no light sampling competes";
  });
}

}  // namespace
}  // namespace norrsken
