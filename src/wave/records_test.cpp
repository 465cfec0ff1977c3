// That queues take the records that they are for, by name, and that what is mixed up does not compile.
#include "wave/records.h"

#include "wave/intersect_closest.h"
#include "wave/intersect_shadow.h"
#include "wave/shade_emission.h"
#include "wave/shade_miss.h"
#include "wave/stage_testing.h"

namespace norrsken {
namespace {

using isa_host::Color;
using isa_host::Float;
using isa_host::Hit;
using isa_host::Mask;
using isa_host::Ray;
using isa_host::ShadowRay;
using isa_host::UInt;
using isa_host::Vec3f;

using Rays = Queue<stored::Ray>;
using Hits = Queue<stored::Hit>;
using Slots = Queue<stored::Slot>;
using ShadowRays = Queue<stored::ShadowRay>;

template <class Records, class Record>
concept CanPush = requires(const SceneView& scene, Records& queue, const Record& record, Mask active) {
  push(scene, queue, record, active);
};
static_assert(CanPush<Rays, Ray> && CanPush<Hits, Hit> && CanPush<ShadowRays, ShadowRay>);
static_assert(!CanPush<Hits, Ray> && !CanPush<Rays, Hit> && !CanPush<Rays, ShadowRay>);
static_assert(!CanPush<const Rays, Ray>, "a stage cannot push to its input");

template <class Record, class Records>
concept CanLoad = requires(const SceneView& scene, const Records& queue) {
  isa_host::load<Record>(scene, queue, 0u);
};
static_assert(CanLoad<Ray, Rays> && CanLoad<Hit, Hits>);
static_assert(!CanLoad<Ray, Hits> && !CanLoad<Ray, ShadowRays> && !CanLoad<ShadowRay, Rays>);

template <class Records>
using FieldOf = decltype(std::declval<Records&>().field(0u));
static_assert(std::is_same_v<FieldOf<Rays>, float*> && std::is_same_v<FieldOf<const Rays>, const float*>,
              "nor write to its fields");
static_assert(!std::is_copy_constructible_v<Rays> && !std::is_copy_assignable_v<Rays>);

// Stages: the right queues, those of another stage, and ones that may not be written.
template <auto stage, class... Queues>
constexpr bool kTakes = std::is_invocable_v<decltype(stage), const SceneView&, Queues...>;
static_assert(kTakes<isa_host::intersect_shadow, const ShadowRays&, Slots&>);
static_assert(!kTakes<isa_host::intersect_shadow, const Rays&, Slots&>);
static_assert(!kTakes<isa_host::intersect_shadow, const ShadowRays&, const Slots&>);
static_assert(kTakes<isa_host::shade_miss, const Rays&, Slots&> && !kTakes<isa_host::shade_miss, const Hits&, Slots&>);
static_assert(kTakes<isa_host::shade_emission, const Hits&, Slots&>);
static_assert(!kTakes<isa_host::shade_emission, const Rays&, Slots&> &&
              !kTakes<isa_host::shade_emission, Slots&, const Hits&>);
static_assert(kTakes<isa_host::intersect_emitters, const Rays&, Slots&, FoundQueues&>);
static_assert(!kTakes<isa_host::intersect_emitters, const Rays&, Slots&, const FoundQueues&>);

// A direction is no colour.
static_assert(!std::is_convertible_v<Vec3f, Color> && !std::is_convertible_v<Color, Vec3f>);
static_assert(std::is_invocable_v<decltype(isa_host::add_radiance), Slots&, UInt, Color, Mask>);
static_assert(!std::is_invocable_v<decltype(isa_host::add_radiance), Slots&, UInt, Vec3f, Mask>);

constexpr Mask kActive{true}, kInactive{false};

Hit some_hit() {
  return {.ray = {.origin = {1.0f, 2.0f, 3.0f},
                  .direction = {4.0f, 5.0f, 6.0f},
                  .throughput = {7.0f, 8.0f, 9.0f},
                  .pdf_sa = 10.0f,
                  .slot = 11u,
                  .eta2 = 12.0f},
          .t = 13.0f,
          .primitive = 14u,
          .material = 15u,
          .instance = 16u,
          .maps = {17u, 18u, 19u, 20u}};
}

/// A scene in whose queues every field is held.
SceneView with_all_fields() {
  SceneView scene;
  scene.refracts = scene.any_resolved = true;
  scene.instance_count = 1;
  return scene;
}

TEST(Records, HoldEachFieldUnderItsName) {
  WaveArena arena(kMaxLanes);
  Hits& hits = arena.memory().found.hits[1];
  const SceneView scene = with_all_fields();
  push(scene, hits, Hit{}, kInactive);
  ASSERT_EQ(hits.count, 0u);
  push(scene, hits, some_hit(), kActive);
  ASSERT_EQ(hits.count, 1u);
  const stored::Hit hit = hits[0];
  EXPECT_EQ(hit.ray.origin, (Triple{1, 2, 3}));
  EXPECT_EQ(hit.ray.direction, (Triple{4, 5, 6}));
  EXPECT_EQ(hit.ray.throughput, (Triple{7, 8, 9}));
  EXPECT_EQ(hit.ray.pdf_sa, 10.0f);
  EXPECT_EQ(hit.ray.slot, 11u);
  EXPECT_EQ(hit.ray.eta2, 12.0f);
  EXPECT_EQ(hit.t, 13.0f);
  EXPECT_EQ(hit.primitive, 14u);
  EXPECT_EQ(hit.material, 15u);
  EXPECT_EQ(hit.instance, 16u);
  EXPECT_EQ(hit.maps, (std::array<std::uint32_t, 4>{17, 18, 19, 20}));
  EXPECT_EQ(*hits.field(&stored::Hit::material), float_of(15u));
  EXPECT_EQ(*hits.field(&stored::Hit::maps, 2), float_of(19u));
  EXPECT_EQ(*hits.field(&stored::Hit::ray, &stored::Ray::throughput, 1), 8.0f);

  const Hit loaded = isa_host::load<Hit>(scene, hits, 0);
  EXPECT_EQ(loaded.ray.throughput.g.v, 8.0f);
  EXPECT_EQ(loaded.ray.eta2.v, 12.0f);
  EXPECT_EQ(loaded.instance.v, 16u);
  EXPECT_EQ(loaded.maps[3].v, 20u);
}

TEST(Records, LeaveOutWhatTheSceneHasNot) {
  WaveArena arena(kMaxLanes);
  Hits& hits = arena.memory().found.hits[1];
  poison_tail(hits);
  const SceneView scene{};
  push(scene, hits, some_hit(), kActive);
  EXPECT_EQ(word_of(hits[0].ray.eta2), 0x7fabcdefu) << "not written";
  EXPECT_EQ(hits[0].instance, 0x7fabcdefu);
  EXPECT_EQ(hits[0].maps[0], 0x7fabcdefu);
  const Hit loaded = isa_host::load<Hit>(scene, hits, 0);
  EXPECT_EQ(loaded.ray.eta2.v, 1.0f);
  EXPECT_EQ(loaded.instance.v, kNone);
  EXPECT_EQ(loaded.maps[0].v, 0u);
  EXPECT_EQ(loaded.material.v, 15u);
}

TEST(Records, QueuesOfAnArenaLieApart) {
  const WaveNeeds needs{.connections = true};
  WaveArena arena(100, needs);
  WaveMemory& m = arena.memory();
  EXPECT_EQ(m.rays.capacity(), 112u) << "whole registers";
  std::vector<std::pair<const float*, const float*>> ranges;
  const auto add = [&](const auto& queue) {
    EXPECT_GE(queue.stride(), queue.capacity() + kMaxLanes);
    ranges.emplace_back(queue.field(0u), queue.field(queue.kFields));
  };
  add(m.slots), add(m.rays), add(m.next_rays), add(m.shadow_rays), add(m.connections), add(m.splats);
  for (const auto& hits : m.found.hits) add(hits);
  add(m.found.unresolved_hits), add(m.found.light_hits), add(m.found.misses);
  std::sort(ranges.begin(), ranges.end());
  for (std::size_t i = 1; i < ranges.size(); ++i) EXPECT_EQ(ranges[i - 1].second, ranges[i].first);
  EXPECT_EQ(std::uint64_t(ranges.back().second - ranges.front().first) * sizeof(float), WaveArena::bytes(100, needs));
  EXPECT_GT(WaveArena::bytes(100, {.connections = true, .media = true}), WaveArena::bytes(100, needs));
}

#ifndef NDEBUG
TEST(RecordsDeathTest, PushesBeyondTheCapacityAreFound) {
  WaveArena arena(kMaxLanes);
  Rays& rays = arena.memory().rays;
  rays.count = rays.capacity();
  EXPECT_DEATH(push(SceneView(), rays, Ray{some_hit().ray}, kActive), "capacity");
}
#endif

}  // namespace
}  // namespace norrsken
