// Stages that make rays and intersect them, each alone on made-up queues.
#include "wave/stage_testing.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kDiffuse = static_cast<std::uint32_t>(BsdfKind::diffuse);
constexpr std::uint32_t kAllKinds = ~1u;

/// With 90 degrees across a film of 8 x 4 pixels, x / z goes from 1 (left) to -1 and y / z from 1/2 (top) to -1/2.
TEST(GenerateCameraRays, LookThroughTheirPixels) {
  const auto scene = scene_of(facing_square(1, "") + far_light(), R"(<float name="near_clip" value="0.5"/>)");
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    const WaveJob job{.x0 = 2, .y0 = 1, .width = 5, .height = 3, .first_sample = 3, .sample_count = 2};
    StageMemory m(job.slot_count());
    m.memory.slots.field(&stored::Slot::radiance, 1)[0] = 7;  // of another wave
    probe.generate_camera_rays(scene->view, job, m.memory.slots, m.memory.rays);
    ASSERT_EQ(m.memory.rays.count, 5u * 3u * 2u) << isa;
    EXPECT_EQ(m.memory.slots.count, job.slot_count()) << isa;
    EXPECT_EQ(m.radiance(), (Triple{0, 0, 0})) << isa;
    for (std::uint32_t i = 0; i < m.memory.rays.count; ++i) {
      const stored::Ray ray = m.memory.rays[i];
      const std::uint32_t pixel = i % 15;
      EXPECT_EQ(ray.slot, i / 15 * job.pixel_stride() + pixel) << isa;
      const auto [dx, dy, dz] = ray.direction;
      EXPECT_NEAR(dot(ray.direction, ray.direction), 1, 1e-6) << isa;
      const double px = 4 * (1 - double{dx} / double{dz}), py = 4 * (0.5 - double{dy} / double{dz});
      const double x = 2 + pixel % 5, y = 1 + pixel / 5;
      EXPECT_TRUE(px > x - 1e-5 && px < x + 1 + 1e-5) << isa << ": " << px << " of pixel " << x;
      EXPECT_TRUE(py > y - 1e-5 && py < y + 1 + 1e-5) << isa << ": " << py << " of pixel " << y;
      // It begins on the near plane.
      expect_near(ray.origin, {0.5 * double{dx} / double{dz}, 0.5 * double{dy} / double{dz}, 0.5}, isa);
      EXPECT_EQ(ray.throughput, (Triple{1, 1, 1})) << isa;
      EXPECT_EQ(ray.pdf_sa, 0.0f) << isa;
    }
  });
}

TEST(SkipEmitters, RaysBeginBehindWhatTheyLookThrough) {
  const auto scene = scene_of(facing_square(1, area_light("1")) + facing_square(2, area_light("1")) +
                              facing_square(3, diffuse("0.5")));
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m;
    m.push(m.memory.rays, ray_along({0.25f, 0.5f, 0}, {0, 0, 1}));
    m.push(m.memory.rays, ray_along({0.25f, 0.5f, 0}, {0, 0, -1}));  // meets nothing
    probe.skip_emitters(scene->view, m.memory.rays);
    const stored::Ray through = m.memory.rays[0];
    expect_near(through.origin, {0.25, 0.5, 2}, isa);
    EXPECT_GT(through.origin[2], 2.0f) << isa << ": behind the second light";
    EXPECT_EQ(m.memory.rays[1].origin, (Triple{0.25f, 0.5f, 0})) << isa;
  });
}

TEST(IntersectClosest, PutsEachRayWhereItEnds) {
  const auto scene = scene_of(facing_square(4, diffuse("0.5") + area_light("1")) +
                              R"(<emitter type="constant"/><shape type="sphere">)"
                              R"(<point name="center" x="5" y="0" z="4"/><bsdf type="conductor"/></shape>)");
  ASSERT_TRUE(scene);
  SceneView view = scene->view;
  view.camera.far_clip = view.camera.near_clip + 2;
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    for (const bool from_camera : {false, true}) {
      StageMemory m(4);
      const Triple along{0, 0, 1};
      const Triple origins[] = {{0.5f, 0.25f, 3}, {5, 0, 2}, {0.5f, 0.25f, 1}, {20, 0, 0}};
      for (std::uint32_t s = 0; s < 4; ++s) {
        stored::Ray ray = ray_along(origins[s], along);
        ray.slot = s;
        m.push(m.memory.rays, ray);
      }
      probe.intersect_closest(view, from_camera, kAllKinds, m.memory.rays, m.memory.slots, m.memory.found);
      const FoundQueues& found = m.memory.found;
      const std::string what = isa + (from_camera ? " from the camera" : "");
      // The third ray's end is 3 away: beyond the far plane, if it is the camera's.
      ASSERT_EQ(found.hits[kDiffuse].count, from_camera ? 1u : 2u) << what;
      ASSERT_EQ(found.light_hits.count, found.hits[kDiffuse].count) << what;
      ASSERT_EQ(found.misses.count, from_camera ? 2u : 1u) << what;
      ASSERT_EQ(found.unresolved_hits.count, 0u) << what;
      const stored::Hit hit = found.hits[kDiffuse][0];
      EXPECT_EQ(hit.ray.slot, 0u) << what;
      EXPECT_NEAR(hit.t, 1, 1e-6) << what;
      EXPECT_EQ(material_kind(hit.material), BsdfKind::diffuse) << what;
      EXPECT_EQ(found.light_hits[0].primitive, hit.primitive) << what;
      EXPECT_EQ(found.misses[found.misses.count - 1].slot, 3u) << what;
      const auto& mirror = found.hits[static_cast<std::size_t>(BsdfKind::conductor)];
      ASSERT_EQ(mirror.count, 1u) << what;
      EXPECT_EQ(mirror[0].ray.slot, 1u) << what;
      EXPECT_NEAR(mirror[0].t, 1, 1e-6) << what;
    }
  });
}

TEST(IntersectClosest, KeepsTheKindsThatAreWanted) {
  const auto scene = scene_of(facing_square(4, diffuse("0.5")) + far_light());
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m;
    m.push(m.memory.rays, ray_along({0, 0.5f, 0}, {0, 0, 1}));
    probe.intersect_closest(scene->view, false, 1u << kDiffuse ^ kAllKinds, m.memory.rays, m.memory.slots,
                            m.memory.found);
    EXPECT_EQ(m.memory.found.hits[kDiffuse].count, 0u) << isa;
  });
}

stored::ShadowRay shadow_ray(std::uint32_t slot, const Triple& origin, float t_max) {
  return {.origin = origin,
          .direction = {0, 0, 1},
          .t_max = t_max,
          .contribution = {1, 2, 4},
          .slot = slot,
          .medium = kNone};
}

TEST(IntersectShadow, AddsWhatIsNotHidden) {
  const auto scene = scene_of(facing_square(1, diffuse("0.5")) + facing_square(9, diffuse("0.5")) + far_light());
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(4);
    m.memory.slots.field(&stored::Slot::radiance, 0)[0] = 8;
    m.push(m.memory.shadow_rays, shadow_ray(0, {0.5f, 0.25f, 0}, 0.875f));  // ends before the square
    m.push(m.memory.shadow_rays, shadow_ray(1, {0.5f, 0.25f, 0}, 2));       // the square is between
    m.push(m.memory.shadow_rays, shadow_ray(2, {1.5f, 0.25f, 0}, 2));       // goes past it, twice
    m.push(m.memory.shadow_rays, shadow_ray(2, {-1.5f, 0.25f, 0}, 2));
    probe.intersect_shadow(scene->view, m.memory.shadow_rays, m.memory.slots);
    EXPECT_EQ(m.radiance(0), (Triple{9, 2, 4})) << isa;
    EXPECT_EQ(m.radiance(1), (Triple{0, 0, 0})) << isa;
    EXPECT_EQ(m.radiance(2), (Triple{2, 4, 8})) << isa;
    EXPECT_EQ(m.radiance(3), (Triple{0, 0, 0})) << isa;
  });
}

TEST(IntersectShadow, MakesASampleInvalidWhoseRayIsNone) {
  const auto scene = scene_of(facing_square(9, diffuse("0.5")) + far_light());
  ASSERT_TRUE(scene);
  for_every_isa([&](const KernelProbe& probe, const std::string& isa) {
    StageMemory m(2);
    m.push(m.memory.shadow_rays, shadow_ray(0, {NAN, 0, 0}, 2));
    m.push(m.memory.shadow_rays, shadow_ray(1, {0.5f, 0.25f, 0}, 2));
    probe.intersect_shadow(scene->view, m.memory.shadow_rays, m.memory.slots);
    EXPECT_TRUE(std::isnan(m.radiance(0)[0])) << isa;
    EXPECT_EQ(m.radiance(1), (Triple{1, 2, 4})) << isa;
  });
}

}  // namespace
}  // namespace norrsken
