// That rays find in the hierarchy of triangles what is there.
#include <gmock/gmock.h>

#include <algorithm>

#include "accel/bvh/mesh_testing.h"

namespace norrsken {
namespace {

/// A crossing by double precision, with how far a test in single precision may be off.
struct ExactCrossing {
  double t, t_error;
  double inside;  ///< how far inside of the nearest edge, in units of the triangle's distance
  bool is_open;   ///< in the plane of the triangle, or nearly
};

ExactCrossing cross_exactly(const TestMesh& mesh, std::uint32_t triangle, const TestRay& ray) {
  const glm::dvec3 o(ray.origin), d(ray.direction);
  glm::dvec3 v[3];
  double reach = 0, inside[2] = {1e300, 1e300};
  for (std::size_t k = 0; k < 3; ++k) v[k] = mesh.corner(triangle, k) - o, reach = std::max(reach, glm::length(v[k]));
  const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 e = v[(k + 1) % 3] - v[k], across = glm::cross(d, e);
    const double length = glm::length(across), distance = length > 0 ? glm::dot(v[k], across) / length : 0;
    inside[0] = std::min(inside[0], distance / reach);
    inside[1] = std::min(inside[1], -distance / reach);
  }
  const double slope = std::abs(glm::dot(n, d)), area = glm::length(n);
  return {glm::dot(n, v[0]) / glm::dot(n, d), 2e-6 * reach * area / slope, std::max(inside[0], inside[1]),
          !(slope > 1e-3 * area) || !(area > 0)};
}

constexpr double kCertain = 3e-6;

/// What was found is there, and nothing that is certainly there is nearer.
void expect_right(const TestMesh& mesh, const TestRay& ray, const TestHit& hit, bool occluded,
                  const std::string& what) {
  double certain = std::numeric_limits<double>::infinity(), possible = certain;
  bool found = !hit.is_hit(), any_open = false;
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const ExactCrossing c = cross_exactly(mesh, i, ray);
    const bool may_be_hit = c.is_open || (c.inside > -kCertain && c.t > -c.t_error);
    if (hit.is_hit() && i == hit.primitive()) {
      found = may_be_hit && (c.is_open || std::abs(c.t - static_cast<double>(hit.t)) <= c.t_error);
    }
    any_open = any_open || (c.is_open && may_be_hit);
    if (c.is_open || !may_be_hit) continue;
    possible = std::min(possible, c.t - c.t_error);
    if (c.t > c.t_error && c.inside > kCertain) certain = std::min(certain, c.t + c.t_error);
  }
  EXPECT_TRUE(found) << what << ": it does not meet triangle " << hit.primitive() << " at " << hit.t;
  const double nearest = hit.is_hit() ? static_cast<double>(hit.t) : std::numeric_limits<double>::infinity();
  EXPECT_LE(nearest, certain) << what << ": there is something before";
  const double t_max = static_cast<double>(ray.t_max);
  if (certain < t_max) {
    EXPECT_TRUE(occluded) << what;
  } else if (!any_open && possible > t_max) {
    EXPECT_FALSE(occluded) << what;
  }
}

struct SoupCase {
  const char* name;
  glm::dvec3 center;
  double scale, size;
};

class BvhSoup : public testing::TestWithParam<SoupCase> {
 protected:
  const SoupCase& c() const { return GetParam(); }
  std::vector<TestRay> random_rays(const TestMesh& mesh, std::uint32_t count) const {
    TestRandom random(7);
    std::vector<TestRay> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec3 from = c().center + random.in_cube() * (1.5 * c().scale);
      const std::uint32_t t = random.below(mesh.triangle_count());
      // A third each at a triangle, at an edge, and along axes.
      TestRay ray = ray_between(from, (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0);
      if (i % 3 == 1) ray = ray_between(from, (mesh.corner(t, 0) + mesh.corner(t, 1)) / 2.0);
      if (i % 3 == 2) {
        ray.origin[static_cast<int>(i / 3 % 2)] = static_cast<float>(mesh.corner(t, 0)[static_cast<int>(i / 3 % 2)]);
        ray.direction = glm::vec3(0);
        ray.direction[static_cast<int>(i / 3 % 3)] = i % 2 == 0 ? 1.0f : -1.0f;
      }
      ray.t_max = static_cast<float>(c().scale * 3 * random.uniform());
      rays.push_back(ray);
    }
    return rays;
  }
};

TEST_P(BvhSoup, ShowsWhatIsThere) {
  const TestMesh mesh = soup(1000, c().center, c().scale, c().size, 6);
  const TestView bvh(mesh, AccelKind::bvh);
  const std::vector<TestRay> rays = random_rays(mesh, 1500);
  const RayBlock block(rays);
  std::vector<TestHit> first;
  std::vector<bool> first_occluded;
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    const std::vector<TestHit> hits = block.closest(bvh.view, **k);
    const std::vector<bool> occluded = block.occluded(bvh.view, **k);
    if (first.empty()) {
      first = hits, first_occluded = occluded;
      for (std::uint32_t i = 0; i < rays.size(); ++i) {
        expect_right(mesh, rays[i], hits[i], occluded[i], "ray " + std::to_string(i));
      }
      EXPECT_GT(std::ranges::count_if(hits, [](const TestHit& hit) { return hit.is_hit(); }), 500);
    }
    EXPECT_TRUE(hits == first && occluded == first_occluded) << (*k)->name << " has other bits";
  }
}

class BvhAndEmbree : public BvhSoup {};

/// Where Embree's robust tests and ours differ the ray runs along an edge, or meets two triangles at one distance.
TEST_P(BvhAndEmbree, Agree) {
  const TestMesh mesh = soup(20'000, c().center, c().scale, c().size / 3, 8);
  const TestView bvh(mesh, AccelKind::bvh), embree(mesh, AccelKind::embree);
  const std::vector<TestRay> rays = random_rays(mesh, 20'000);
  const RayBlock block(rays);
  const KernelEntry& kernels = *find_kernels("auto");
  const std::vector<TestHit> ours = block.closest(bvh.view, kernels), theirs = block.closest(embree.view, kernels);
  const std::vector<bool> occluded = block.occluded(bvh.view, kernels),
                          theirs_occluded = block.occluded(embree.view, kernels);
  std::uint32_t differing = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (ours[i].primitive_side == theirs[i].primitive_side && occluded[i] == theirs_occluded[i]) continue;
    const auto on_an_edge = [&](const TestHit& hit) {
      if (!hit.is_hit()) return false;
      const ExactCrossing c = cross_exactly(mesh, hit.primitive(), rays[i]);
      return c.is_open || c.inside < kCertain || std::abs(c.t - static_cast<double>(rays[i].t_max)) < c.t_error;
    };
    const auto at_one_distance = [&] {
      if (!ours[i].is_hit() || !theirs[i].is_hit()) return false;
      const ExactCrossing a = cross_exactly(mesh, ours[i].primitive(), rays[i]),
                          b = cross_exactly(mesh, theirs[i].primitive(), rays[i]);
      return std::abs(a.t - b.t) <= a.t_error + b.t_error;
    };
    EXPECT_TRUE(on_an_edge(ours[i]) || on_an_edge(theirs[i]) || at_one_distance()) << "ray " << i;
    ++differing;
  }
  EXPECT_LT(differing, rays.size() / 4);
}

constexpr SoupCase kSoups[] = {{"Plain", {}, 1, 0.1},          {"Large", {}, 1, 2},
                               {"Small", {}, 1, 0.01},         {"FarFromTheOrigin", {1000, -2000, 500}, 1, 0.1},
                               {"Micrometres", {}, 1e-6, 0.1}, {"Gigametres", {}, 1e9, 0.1}};
/// Embree's products of three coordinates end before.
constexpr SoupCase kExtremeSoups[] = {{"Tiny", {}, 1e-14, 0.1}, {"Huge", {}, 1e15, 0.1}};

constexpr auto kSoupName = [](const auto& parameter) { return parameter.param.name; };
INSTANTIATE_TEST_SUITE_P(Soups, BvhSoup, testing::ValuesIn(kSoups), kSoupName);
INSTANTIATE_TEST_SUITE_P(ExtremeSoups, BvhSoup, testing::ValuesIn(kExtremeSoups), kSoupName);
INSTANTIATE_TEST_SUITE_P(Soups, BvhAndEmbree, testing::ValuesIn(kSoups), kSoupName);

TEST(BvhRays, OfOneTriangle) {
  TestMesh mesh;
  mesh.add_triangle(glm::dvec3{0, 0, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0});
  mesh.finish();
  const TestView bvh(mesh, AccelKind::bvh);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float before = std::nextafter(2.0f, 0.0f), after = std::nextafter(2.0f, 3.0f);
  struct Case {
    TestRay ray;
    TestHit hit;
    bool occluded;
  };
  constexpr std::uint32_t kBack = 0x80000000u;
  const Case cases[] = {
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, inf}, {2, 0}, true},
      {{{0.2f, 0.2f, -2}, {0, 0, 1}, inf}, {2, kBack}, true},
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, 2}, {2, 0}, false},  // ends on it
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, before}, {2, 0}, false},
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, after}, {2, 0}, true},
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, 0}, {2, 0}, false},
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, -1}, {2, 0}, false},
      {{{0.2f, 0.2f, 2}, {0, 0, -1}, nan}, {2, 0}, false},
      {{{0.2f, 0.2f, 0}, {0, 0, -1}, inf}, {inf, kNone}, false},  // begins on it
      {{{0.2f, 0.2f, 2}, {0, 0, 1}, inf}, {inf, kNone}, false},
      {{{0.8f, 0.8f, 2}, {0, 0, -1}, inf}, {inf, kNone}, false},
      {{{0.5f, 0.5f, 2}, {0, 0, -1}, inf}, {2, 0}, true},  // an edge
      {{{0, 0, 2}, {-0.0f, 0, -1}, inf}, {2, 0}, true},    // corners
      {{{0, 0, 2}, {0, -0.0f, -1}, inf}, {2, 0}, true},
      {{{1, 0, 2}, {0, 0, -1}, inf}, {2, 0}, true},
      {{{0, 1, 2}, {-0.0f, -0.0f, -1}, inf}, {2, 0}, true},
      {{{-1, 0.2f, 0}, {1, 0, 0}, inf}, {inf, kNone}, false},  // in its plane
      {{{0.2f, 0.2f, 2}, {0, 0, 0}, inf}, {inf, kNone}, false},
      {{{nan, 0.2f, 2}, {0, 0, -1}, inf}, {inf, kNone}, false},
      {{{0.2f, 0.2f, 2}, {0, nan, -1}, inf}, {inf, kNone}, false},
      {{{0.2f, inf, 2}, {0, 0, -1}, inf}, {inf, kNone}, false},
      {{{0.2f, 1e30f, 2}, {0, 0, -1}, inf}, {inf, kNone}, false},
  };
  std::vector<TestRay> rays;
  for (const Case& c : cases) rays.push_back(c.ray);
  const RayBlock block(rays);
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    const std::vector<TestHit> hits = block.closest(bvh.view, **k);
    const std::vector<bool> occluded = block.occluded(bvh.view, **k);
    for (std::size_t i = 0; i < std::size(cases); ++i) {
      EXPECT_EQ(hits[i], cases[i].hit) << (*k)->name << ", case " << i << ": t " << hits[i].t << ", "
                                       << hits[i].primitive_side;
      EXPECT_EQ(occluded[i], cases[i].occluded) << (*k)->name << ", case " << i;
    }
  }
}

/// A floor that is large against its distance is where it is, however large.
TEST(BvhRays, OfAGroundPlane) {
  TestRandom random(13);
  for (const double half : {1e3, 1e4, 1e6, 1e8, 1e10, 1e13}) {
    TestMesh mesh;
    const glm::dvec3 corners[] = {{-half, -1, -half}, {half, -1, -half}, {half, -1, half}, {-half, -1, half}};
    mesh.add_triangle(corners[0], corners[1], corners[2]);
    mesh.add_triangle(corners[0], corners[2], corners[3]);
    mesh.finish();
    const TestView bvh(mesh, AccelKind::bvh);
    std::vector<TestRay> rays;
    for (int i = 0; i < 2000; ++i) {
      glm::dvec3 to = random.in_cube() * 5.0;
      to.y = -0.01 - random.uniform();
      rays.push_back({glm::vec3(0), glm::vec3(glm::normalize(to))});
    }
    const RayBlock block(rays);
    for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
      const std::vector<TestHit> hits = block.closest(bvh.view, **k);
      double most = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        most = std::max(most, std::abs(double{hits[i].t} * -double{rays[i].direction.y} - 1));
      }
      EXPECT_LT(most, 1e-5) << (*k)->name << ", " << half;
    }
  }
}

/// Points, lines and slivers hide nothing, and what is behind them is found.
TEST(BvhRays, OfDegenerateTriangles) {
  TestRandom random(9);
  TestMesh mesh;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p = random.in_cube(), q = random.in_cube();
    mesh.add_triangle(p, p, p);
    mesh.add_triangle(p, q, p);
    mesh.add_triangle(p, q, q);
  }
  const std::uint32_t wall = mesh.triangle_count();
  mesh.add_triangle(glm::dvec3{-9, -9, -2}, glm::dvec3{9, -9, -2}, glm::dvec3{0, 9, -2});
  mesh.finish();
  const TestView bvh(mesh, AccelKind::bvh);
  std::vector<TestRay> rays;
  for (int i = 0; i < 1000; ++i) {
    // Half of them aimed at a point of a line.
    const std::uint32_t t = random.below(wall);
    const glm::dvec3 at = (mesh.corner(t, 0) + mesh.corner(t, 1)) / 2.0;
    const glm::dvec3 from =
        i % 2 == 0 ? glm::dvec3(random.in_cube().x, random.in_cube().y, 3) : glm::dvec3(at.x, at.y, 3);
    TestRay ray{glm::vec3(from), glm::vec3(0, 0, -1)};
    rays.push_back(ray);
  }
  const RayBlock block(rays);
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    for (const TestHit& hit : block.closest(bvh.view, **k)) EXPECT_EQ(hit.primitive_side, wall) << (*k)->name;
  }
}

/// More rays than are asked for at a time, and any number of them at the end.
TEST(BvhRays, OfAnyNumber) {
  const TestMesh mesh = bumpy_sphere(20, 1);
  const TestView bvh(mesh, AccelKind::bvh);
  TestRandom random(10);
  std::vector<TestRay> rays;
  for (int i = 0; i < 2100; ++i) rays.push_back(ray_between(random.in_cube() * 0.3, random.direction()));
  const KernelEntry& kernels = *find_kernels("auto");
  const std::vector<TestHit> all = RayBlock(rays).closest(bvh.view, kernels);
  for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 1000u, 1023u, 1024u, 1025u, 1040u, 2048u, 2099u}) {
    const RayBlock block({rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(n)});
    const std::vector<TestHit> hits = block.closest(bvh.view, kernels);
    EXPECT_TRUE(std::equal(hits.begin(), hits.end(), all.begin())) << n;
    EXPECT_EQ(std::ranges::count(block.occluded(bvh.view, kernels), false), 0) << n;
  }
}

}  // namespace
}  // namespace norrsken
