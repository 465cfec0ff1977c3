// No ray leaves a closed mesh: not through an edge, nor through a corner, nor along an axis.
#include "accel/bvh/mesh_testing.h"

namespace norrsken {
namespace {

class Watertight : public testing::TestWithParam<double> {
 protected:
  /// How many of the rays hit nothing, for each instruction set; that all sets find the same is checked.
  void expect_no_leak(const TestMesh& mesh, const std::vector<TestRay>& rays, const char* what) {
    const TestView bvh(mesh, AccelKind::bvh);
    const RayBlock block(rays);
    std::vector<TestHit> first;
    for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
      const std::vector<TestHit> hits = block.closest(bvh.view, **k);
      const std::vector<bool> occluded = block.occluded(bvh.view, **k);
      EXPECT_EQ(std::ranges::count_if(hits, [](const TestHit& hit) { return !hit.is_hit(); }), 0)
          << what << ", " << (*k)->name;
      EXPECT_EQ(std::ranges::count(occluded, false), 0) << what << ", " << (*k)->name;
      if (first.empty()) first = hits;
      EXPECT_TRUE(hits == first) << what << ", " << (*k)->name;
    }
  }
};

constexpr std::uint32_t kRays = NORRSKEN_LEAK_RAYS;

TEST_P(Watertight, AtEdgesAndCorners) {
  const double scale = GetParam();
  const TestMesh mesh = bumpy_sphere(100, scale);
  TestRandom random(1);
  std::vector<TestRay> edges, corners;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const std::uint32_t triangle = random.below(mesh.triangle_count()), k = random.below(3);
    const glm::dvec3 a = mesh.corner(triangle, k), b = mesh.corner(triangle, (k + 1) % 3);
    const glm::dvec3 from = random.in_cube() * (0.4 * scale);
    edges.push_back(ray_between(from, a + (b - a) * random.uniform()));
    corners.push_back(ray_between(from, a));
  }
  expect_no_leak(mesh, edges, "edges");
  expect_no_leak(mesh, corners, "corners");
}

/// Bounds, edges and corners all lie in planes that rays run within.
TEST_P(Watertight, AlongTheAxes) {
  const double scale = GetParam();
  constexpr std::uint32_t kCells = 16;
  TestMesh mesh;
  // The six faces of a cube, each a square grid. (Rays along an axis meet two of them in their corners.)
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      const auto point = [&](std::uint32_t u, std::uint32_t v) {
        glm::dvec3 p;
        p[axis] = side * scale;
        p[(axis + 1) % 3] = u * scale / kCells;
        p[(axis + 2) % 3] = v * scale / kCells;
        return p;
      };
      for (std::uint32_t u = 0; u < kCells; ++u) {
        for (std::uint32_t v = 0; v < kCells; ++v) {
          mesh.add_triangle(point(u, v), point(u + 1, v), point(u + 1, v + 1));
          mesh.add_triangle(point(u, v), point(u + 1, v + 1), point(u, v + 1));
        }
      }
    }
  }
  mesh.finish();
  std::vector<TestRay> rays;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      for (const float zero : {0.0f, -0.0f}) {
        // Edges of the cube included: there faces are seen in their borders.
        for (std::uint32_t u = 0; u <= 2 * kCells; ++u) {
          for (std::uint32_t v = 0; v <= 2 * kCells; ++v) {
            glm::dvec3 o;
            o[axis] = 0.3 * scale;
            o[(axis + 1) % 3] = u * scale / (2 * kCells);
            o[(axis + 2) % 3] = v * scale / (2 * kCells);
            TestRay ray{glm::vec3(o), glm::vec3(zero)};
            ray.direction[axis] = sign;
            rays.push_back(ray);
          }
        }
      }
    }
  }
  expect_no_leak(mesh, rays, "axes");
}

INSTANTIATE_TEST_SUITE_P(NORRSKEN_LEAK_NAME, Watertight, testing::Values(1.0, 3e-7, 5e5, 1e-14, 1e14),
                         [](const auto& parameter) {
                           return "TenTo" + std::string(parameter.param < 0.1 ? "Minus" : "") +
                                  std::to_string(static_cast<int>(std::abs(std::log10(parameter.param))));
                         });

}  // namespace
}  // namespace norrsken
