// That the hierarchy of triangles is well built, whatever it is made of.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "accel/bvh/mesh_testing.h"

namespace norrsken {
namespace {

/// What a walk over all of it finds.
struct Census {
  std::vector<std::uint32_t> primitives;
  std::uint32_t levels = 0;
  bool bounds_hold = true;

  explicit Census(const Bvh& bvh, const TestMesh& mesh) : bvh_(bvh), mesh_(mesh) {
    const float most = std::numeric_limits<float>::infinity();
    const float everything[3][2] = {{-most, most}, {-most, most}, {-most, most}};
    if (bvh.root != kBvhNothing) walk(bvh.root, 1, everything);
    std::ranges::sort(primitives);
  }

 private:
  void walk(std::uint32_t child, std::uint32_t level, const float bounds[3][2]) {
    const CacheLine* line = bvh_.lines.data() + (child & ~kBvhLeaf);
    if ((child & kBvhLeaf) != 0) {
      const auto& block = *reinterpret_cast<const TriangleBlock*>(line);
      for (const std::uint32_t primitive : block.primitive) {
        if (primitive == kBvhNothing) continue;
        primitives.push_back(primitive);
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec3 p = mesh_.corner(primitive, k);
          for (int a = 0; a < 3; ++a) {
            bounds_hold =
                bounds_hold && p[a] >= static_cast<double>(bounds[a][0]) && p[a] <= static_cast<double>(bounds[a][1]);
          }
        }
      }
      return;
    }
    levels = std::max(levels, level);
    const auto& node = *reinterpret_cast<const BvhNode*>(line);
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
      if (node.child[i] == kBvhNothing) continue;
      float of_child[3][2];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t side = 0; side < 2; ++side) of_child[a][side] = node.bounds[a][side][i];
      }
      walk(node.child[i], level + 1, of_child);
    }
  }

  const Bvh& bvh_;
  const TestMesh& mesh_;
};

void expect_well_built(const TestMesh& mesh, std::uint32_t triangles_that_count) {
  const Bvh bvh = build_bvh(mesh.tables, 2);
  const Census census(bvh, mesh);
  EXPECT_EQ(census.primitives.size(), triangles_that_count);
  EXPECT_EQ(std::ranges::adjacent_find(census.primitives), census.primitives.end()) << "twice";
  EXPECT_TRUE(census.bounds_hold);
  EXPECT_LE(census.levels, kBvhMostLevels);
}

TEST(BvhBuild, HoldsEveryTriangleOnce) {
  for (const std::uint32_t n : {1u, 2u, 7u, 8u, 9u, 20u, 100u, 5000u}) expect_well_built(soup(n, {}, 1, 0.1, 1), n);
}

TEST(BvhBuild, DoesNotDependOnTheNumberOfThreads) {
  const TestMesh mesh = soup(100'000, {}, 1, 0.02, 2);
  const Bvh one = build_bvh(mesh.tables, 1);
  for (const int threads : {2, 3, 7}) {
    const Bvh many = build_bvh(mesh.tables, threads);
    ASSERT_EQ(many.lines.size(), one.lines.size());
    EXPECT_EQ(std::memcmp(many.lines.data(), one.lines.data(), one.lines.size() * sizeof(CacheLine)), 0) << threads;
  }
}

TEST(BvhBuild, OfNothing) {
  TestMesh mesh;
  mesh.finish();
  expect_well_built(mesh, 0);
  const TestView bvh(mesh, AccelKind::bvh);
  const RayBlock block({{{0, 0, 0}, {0, 0, 1}}});
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    EXPECT_FALSE(block.closest(bvh.view, **k)[0].is_hit());
    EXPECT_FALSE(block.occluded(bvh.view, **k)[0]);
  }
}

/// The heuristic has nothing to go by.
TEST(BvhBuild, OfAMillionEqualTriangles) {
  TestMesh mesh;
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) mesh.add_vertex(p);
  for (std::uint32_t i = 0; i < 1'000'000; ++i) mesh.add_triangle(0, 1, 2);
  mesh.finish();
  expect_well_built(mesh, 1'000'000);
  const TestView bvh(mesh, AccelKind::bvh);
  const RayBlock block({{{0.2f, 0.2f, 1}, {0, 0, -1}}});
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    EXPECT_EQ(block.closest(bvh.view, **k)[0], (TestHit{1, 0})) << "the first of all at one distance";
  }
}

/// Each is half as large and half as far as the one before: the heuristic splits off one at a time.
TEST(BvhBuild, OfASpiral) {
  TestMesh mesh;
  for (int turn = 0; turn < 100; ++turn) {
    for (int i = 0; i < 100; ++i) {
      const double s = std::pow(0.5, i), x = s * (1 + 1e-3 * turn);
      mesh.add_triangle(glm::dvec3{x, 0, 0}, glm::dvec3{x, s, 0}, glm::dvec3{x, 0, s});
    }
  }
  mesh.finish();
  expect_well_built(mesh, 10'000);
}

TEST(BvhBuild, LeavesOutWhatNoRayCanMeet) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  TestMesh mesh = soup(100, {}, 1, 0.1, 3);
  for (const double bad : {kNan, kInf, -kInf, 1e19, 1e30, 3e38}) {
    mesh.add_triangle(glm::dvec3{0, 0, bad}, glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0});
    mesh.add_triangle(glm::dvec3{0, 0, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{0, bad, 0});
  }
  mesh.finish();
  expect_well_built(mesh, 100);
}

/// Their areas overflow.
TEST(BvhBuild, OfHugeAndOfTinyTriangles) {
  for (const double scale : {1e18, 1e-30, 1e-42}) {
    const TestMesh mesh = soup(3000, {}, scale, 0.3, 4);
    expect_well_built(mesh, 3000);
  }
}

TEST(BvhBuild, IsCounted) {
  const TestMesh mesh = soup(50'000, {}, 1, 0.02, 5);
  const auto budget = std::make_shared<MemoryBudget>();
  {
    const MemoryScope scope(budget);
    const Bvh bvh = build_bvh(mesh.tables, 2);
    EXPECT_GE(budget->used(), bvh.lines.size() * sizeof(CacheLine));
  }
  EXPECT_EQ(budget->used(), 0u);
  for (std::uint64_t limit = 1'000'000; limit < budget->peak(); limit += 500'000) {
    const auto small = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(small);
    EXPECT_THROW(build_bvh(mesh.tables, 2), MemoryExceeded);
    EXPECT_EQ(small->used(), 0u);
  }
}

}  // namespace
}  // namespace norrsken
