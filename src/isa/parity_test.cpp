// Every instruction set against the one-lane kernels: each stage alone on made-up queues of every tail length, and
// whole waves. Hits on an edge may fall to either side where rounding differs, so a share of records may differ; it is
// bounded, and everything else must agree closely.
#include <string>
#include <string_view>

#include "isa/kernel_testing.h"
#include "tests/temporary_folder.h"
#include "wave/plain_scene.h"

namespace norrsken {
namespace {

const KernelEntry& oracle_kernels() { return *find_kernels("scalar"); }
const KernelProbe& oracle() { return probe_of(oracle_kernels()); }

/// Lengths around every register's: empty, partly filled, full, one more, several and a bit.
std::vector<std::uint32_t> tail_lengths() {
  std::vector<std::uint32_t> lengths;
  for (std::uint32_t n = 0; n <= 2 * kMaxLanes + 1; ++n) lengths.push_back(n);
  lengths.push_back(1000);
  return lengths;
}

constexpr std::uint32_t kSlots = 1024;

/// Arenas with the same slots and the same made-up rays from inside the room.
struct Made {
  WaveArena arena{kSlots};
  WaveMemory& memory = arena.memory();

  explicit Made(std::uint32_t rays) {
    memory.slots.count = kSlots;
    std::mt19937 random(99);
    for (std::uint32_t s = 0; s < kSlots; ++s) {
      stored::Slot slot{};
      slot.key = static_cast<std::uint32_t>(random()) >> 2;
      slot.index = s % 7;
      memory.slots.set(s, slot);
    }
    const double lower[3] = {0, -5, -4.9}, upper[3] = {10, 5, 4.8};
    const RandomRays made(kSlots, 5, lower, upper);
    const RayArrays& a = made.arrays();
    std::uniform_real_distribution<float> unit(0.1f, 1.0f);
    for (std::uint32_t i = 0; i < rays; ++i) {
      stored::Ray ray{};
      ray.origin = {a.ox[i], a.oy[i], a.oz[i]};
      ray.direction = {a.dx[i], a.dy[i], a.dz[i]};
      for (float& channel : ray.throughput) channel = unit(random);
      ray.pdf_sa = i % 3 == 0 ? 0.0f : unit(random);
      ray.eta2 = 1 + unit(random);
      ray.slot = (i * 37) % kSlots;
      memory.rays.set(i, ray);
    }
    memory.rays.count = rays;
    poison_tail(memory.rays);
  }
};

bool close(float a, float b, float scale) { return std::abs(a - b) <= 2e-4f * std::max(scale, std::abs(a)) || a == b; }

std::uint32_t slot_of(const stored::Ray& ray) { return ray.slot; }
std::uint32_t slot_of(const stored::Hit& hit) { return hit.ray.slot; }
std::uint32_t slot_of(const stored::ShadowRay& ray) { return ray.slot; }

/// What must be the same bits.
std::vector<std::uint32_t> discrete(const stored::Hit& hit) { return {hit.primitive, hit.material, hit.instance}; }
std::vector<std::uint32_t> discrete(const auto&) { return {}; }

/// Records of a queue in the order of their slots (and within a slot of their place).
template <class Record>
std::vector<Record> sorted_records(const Queue<Record>& q) {
  std::vector<Record> records;
  for (std::uint32_t i = 0; i < q.count; ++i) records.push_back(q[i]);
  std::stable_sort(records.begin(), records.end(),
                   [](const Record& a, const Record& b) { return slot_of(a) < slot_of(b); });
  return records;
}

/// Words that are integers, as floats, are tiny or not a number: these compare by `discrete`.
template <class Record>
bool close_records(const Record& a, const Record& b) {
  if (discrete(a) != discrete(b)) return false;
  float wa[Queue<Record>::kFields], wb[Queue<Record>::kFields];
  std::memcpy(wa, &a, sizeof a), std::memcpy(wb, &b, sizeof b);
  for (std::size_t k = 0; k < Queue<Record>::kFields; ++k) {
    if (!close(wa[k], wb[k], 1.0f) && word_of(wa[k]) != word_of(wb[k])) return false;
  }
  return true;
}

/// Compares queues record by record. Records that only one side has, or that went another way, are counted and may be one
/// in 200.
template <class Record>
void expect_equal_queues(const Queue<Record>& got, const Queue<Record>& wanted, const std::string& what) {
  const auto a = sorted_records(got), b = sorted_records(wanted);
  std::size_t strays = 0, i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    const std::uint32_t sa = slot_of(a[i]), sb = slot_of(b[k]);
    if (sa != sb) {
      ++strays;
      sa < sb ? ++i : ++k;
      continue;
    }
    strays += close_records(a[i], b[k]) ? 0 : 1;
    ++i, ++k;
  }
  strays += (a.size() - i) + (b.size() - k);
  EXPECT_LE(strays, std::max(a.size(), b.size()) / 200)
      << what << ": " << a.size() << " and " << b.size() << " records";
}

void expect_equal_slots(const Queue<stored::Slot>& got, const Queue<stored::Slot>& wanted, const std::string& what) {
  std::size_t strays = 0;
  for (std::uint32_t s = 0; s < got.count; ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      strays += close(got[s].radiance[k], wanted[s].radiance[k], 0.1f) ? 0u : 1u;
    }
  }
  EXPECT_LE(strays, got.count / 100) << what;
}

std::string label(const KernelEntry& kernels, std::uint32_t n) {
  return std::string(kernels.name) + ", " + std::to_string(n) + " records";
}

class Parity : public testing::TestWithParam<AccelKind> {
 protected:
  void SetUp() override {
    LoadOptions options;
    options.parameters = {{"shadow_rays", "2"}};
    viewed_ = view_scene("hexagon_room", GetParam(), options);
    ASSERT_NE(viewed_, nullptr);
    viewed_->view.refracts = true;  // or rays would not have all their fields
  }
  const SceneView& scene() const { return viewed_->view; }

  /// Hits of the made-up rays, found by the oracle, in both arenas alike.
  void find_hits(Made& made) const {
    oracle().intersect_closest(scene(), false, ~1u, made.memory.rays, made.memory.slots, made.memory.found);
    for (auto& q : made.memory.found.hits) poison_tail(q);
    poison_tail(made.memory.found.light_hits);
  }

  std::unique_ptr<ViewedScene> viewed_;
};

constexpr std::uint32_t kDiffuse = static_cast<std::uint32_t>(BsdfKind::diffuse);
constexpr std::uint32_t kConductor = static_cast<std::uint32_t>(BsdfKind::conductor);

TEST_P(Parity, IntersectClosest) {
  for (const KernelEntry* kernels : wide_kernels()) {
    for (const std::uint32_t n : tail_lengths()) {
      Made a(n), b(n);
      probe_of(*kernels).intersect_closest(scene(), false, ~1u, a.memory.rays, a.memory.slots, a.memory.found);
      oracle().intersect_closest(scene(), false, ~1u, b.memory.rays, b.memory.slots, b.memory.found);
      for (const std::uint32_t kind : {kDiffuse, kConductor}) {
        expect_equal_queues(a.memory.found.hits[kind], b.memory.found.hits[kind], label(*kernels, n));
      }
      expect_equal_queues(a.memory.found.light_hits, b.memory.found.light_hits, label(*kernels, n));
      if (n == 1000) {
        EXPECT_GT(b.memory.found.hits[kDiffuse].count, 900u);
        EXPECT_GT(b.memory.found.hits[kConductor].count, 10u);
        EXPECT_GT(b.memory.found.light_hits.count, 5u);
      }
    }
  }
}

TEST_P(Parity, IntersectEmittersFindsWhatIntersectClosestFinds) {
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    for (const std::uint32_t n : tail_lengths()) {
      Made a(n), b(n);
      probe_of(**k).intersect_emitters(scene(), a.memory.rays, a.memory.slots, a.memory.found);
      oracle().intersect_closest(scene(), false, 0u, b.memory.rays, b.memory.slots, b.memory.found);
      expect_equal_queues(a.memory.found.light_hits, b.memory.found.light_hits, label(**k, n));
    }
  }
}

TEST_P(Parity, ShadeSurfaceAndIntersectShadow) {
  for (const KernelEntry* kernels : wide_kernels()) {
    for (const std::uint32_t n : tail_lengths()) {
      for (const BsdfKind kind : {BsdfKind::diffuse, BsdfKind::conductor}) {
        for (const bool roulette : {false, true}) {
          Made a(n), b(n);
          find_hits(a), find_hits(b);
          Queue<stored::Hit>& hits_a = a.memory.found.hits[static_cast<std::size_t>(kind)];
          Queue<stored::Hit>& hits_b = b.memory.found.hits[static_cast<std::size_t>(kind)];
          // Two shadow rays per hit must fit.
          if (2 * hits_a.count > a.memory.shadow_rays.capacity()) hits_a.count = hits_b.count = 500;
          probe_of(*kernels).shade_surface(scene(), kind, 2, roulette, hits_a, a.memory.slots, a.memory.shadow_rays,
                                           a.memory.next_rays);
          oracle().shade_surface(scene(), kind, 2, roulette, hits_b, b.memory.slots, b.memory.shadow_rays,
                                 b.memory.next_rays);
          expect_equal_queues(a.memory.next_rays, b.memory.next_rays, label(*kernels, n));
          expect_equal_queues(a.memory.shadow_rays, b.memory.shadow_rays, label(*kernels, n));
          if (n == 1000 && kind == BsdfKind::diffuse) {
            EXPECT_GT(b.memory.shadow_rays.count, 500u);
          }
          poison_tail(a.memory.shadow_rays);
          poison_tail(b.memory.shadow_rays);
          probe_of(*kernels).intersect_shadow(scene(), a.memory.shadow_rays, a.memory.slots);
          oracle().intersect_shadow(scene(), b.memory.shadow_rays, b.memory.slots);
          expect_equal_slots(a.memory.slots, b.memory.slots, label(*kernels, n));
        }
      }
    }
  }
}

TEST_P(Parity, ShadeEmission) {
  for (const KernelEntry* kernels : wide_kernels()) {
    for (const std::uint32_t n : tail_lengths()) {
      Made a(n), b(n);
      find_hits(a), find_hits(b);
      probe_of(*kernels).shade_emission(scene(), a.memory.found.light_hits, a.memory.slots);
      oracle().shade_emission(scene(), b.memory.found.light_hits, b.memory.slots);
      expect_equal_slots(a.memory.slots, b.memory.slots, label(*kernels, n));
    }
  }
}

TEST_P(Parity, GenerateCameraRays) {
  for (const KernelEntry* kernels : wide_kernels()) {
    for (std::uint32_t width = 1; width <= 2 * kMaxLanes + 1; ++width) {
      Made a(0), b(0);
      const WaveJob job{3, 5, width, 3, 2, 5};
      probe_of(*kernels).generate_camera_rays(scene(), job, a.memory.slots, a.memory.rays);
      oracle().generate_camera_rays(scene(), job, b.memory.slots, b.memory.rays);
      EXPECT_EQ(b.memory.rays.count, width * 3 * 5);
      expect_equal_queues(a.memory.rays, b.memory.rays, label(*kernels, width));
      for (std::uint32_t i = 0; i < a.memory.rays.count; ++i) {
        const std::uint32_t slot = b.memory.rays[i].slot;
        ASSERT_EQ(a.memory.slots[slot].key, b.memory.slots[slot].key);
      }
    }
  }
}

TEST_P(Parity, WholeWaves) {
  for (const KernelEntry* kernels : wide_kernels()) {
    Made a(0), b(0);
    WaveCounts counts_a, counts_b;
    const WaveJob job{300, 500, 16, 8, 0, 8};
    kernels->trace_wave(scene(), job, a.memory, counts_a);
    oracle_kernels().trace_wave(scene(), job, b.memory, counts_b);
    double sum_a = 0, sum_b = 0, difference = 0;
    for (std::uint32_t s = 0; s < job.slot_count(); ++s) {
      const float x = a.memory.slots[s].radiance[1], y = b.memory.slots[s].radiance[1];
      sum_a += x, sum_b += y, difference += std::abs(x - y) > 1e-3f * y ? 1 : 0;
    }
    EXPECT_GT(sum_b, 0);
    EXPECT_NEAR(sum_a, sum_b, 0.02 * sum_b) << kernels->name;
    EXPECT_LE(difference, 0.01 * job.slot_count()) << kernels->name;
    EXPECT_NEAR(static_cast<double>(counts_a.shadow_rays), static_cast<double>(counts_b.shadow_rays), 20);
  }
}

/// A plain scene is shaded by code that knows what it lacks. Told that something may be smooth, though nothing is, it goes
/// through the code for all scenes.
void expect_same_bits_as_any_scene(const SceneView& scene, const WaveJob& job) {
  ASSERT_TRUE(isa_host::PlainScene::is_plain(scene));
  SceneView any_scene = scene;
  any_scene.any_smooth = true;
  ASSERT_FALSE(isa_host::PlainScene::is_plain(any_scene));
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    Made a(0), b(0);
    WaveCounts counts_a, counts_b;
    (*k)->trace_wave(scene, job, a.memory, counts_a);
    (*k)->trace_wave(any_scene, job, b.memory, counts_b);
    EXPECT_GT(counts_a.shadow_rays, 0u) << (*k)->name;
    EXPECT_EQ(counts_a.shadow_rays, counts_b.shadow_rays) << (*k)->name;
    for (std::uint32_t s = 0; s < job.slot_count(); ++s) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(word_of(a.memory.slots[s].radiance[c]), word_of(b.memory.slots[s].radiance[c]))
            << (*k)->name << ", slot " << s;
      }
    }
  }
}

TEST_P(Parity, ThePlainRoomIsShadedLikeAnyScene) { expect_same_bits_as_any_scene(scene(), {300, 500, 16, 8, 0, 8}); }

TEST(PlainScenes, AreShadedLikeAnyOtherWhateverTheModel) {
  std::string xml =
      R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="6"/></integrator>)"
      R"(<sensor type="perspective"><float name="fov" value="60"/><transform name="to_world">)"
      R"(<lookat origin="0,0,8" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm">)"
      R"(<integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>)"
      R"(<emitter type="constant"/><emitter type="point"><point name="position" x="0" y="0" z="6"/></emitter>)";
  int placed = 0;
  const auto next_place = [&] {
    const int column = placed % 4, row = placed / 4;
    ++placed;
    return "x=\"" + std::to_string(1.8 * column - 2.7) + "\" y=\"" + std::to_string(1.8 * row - 2.7) + "\" z=\"0\"";
  };
  // Hair wants tangents, by which no scene is plain.
#define NORRSKEN_BSDF(kind, Model)       \
  if (std::string_view(#kind) != "hair") \
    xml += R"(<shape type="sphere"><point name="center" )" + next_place() + R"(/><bsdf type=")" #kind R"("/></shape>)";
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
  ASSERT_LE(placed, 16);
  const TemporaryFolder folder;
  const auto spheres = view_scene(folder.write("spheres.xml", xml + "</scene>"), AccelKind::planes);
  ASSERT_NE(spheres, nullptr);
  expect_same_bits_as_any_scene(spheres->view, {0, 0, 32, 32, 0, 1});
}

INSTANTIATE_TEST_SUITE_P(EveryAccelerator, Parity,
                         testing::Values(AccelKind::planes, AccelKind::moller_trumbore, AccelKind::bvh,
                                         AccelKind::embree),
                         [](const auto& parameter) { return std::string(accel_name(parameter.param)); });

TEST(SamplerParity, SameBitsInEveryWidth) {
  Answers<float> x(1000), y(1000), rx(1000), ry(1000);
  for (const KernelEntry* kernels : wide_kernels()) {
    for (const SamplerKind kind : {SamplerKind::independent, SamplerKind::sobol}) {
      for (const std::uint32_t dimension : {0u, 9u, 400u}) {
        probe_of(*kernels).sample_2d(kind, 0x123456789abcdefull, 77, dimension, 1000, x.data(), y.data());
        oracle().sample_2d(kind, 0x123456789abcdefull, 77, dimension, 1000, rx.data(), ry.data());
        for (std::uint32_t i = 0; i < 1000; ++i) {
          ASSERT_EQ(x[i], rx[i]) << kernels->name;
          ASSERT_EQ(y[i], ry[i]) << kernels->name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace norrsken
