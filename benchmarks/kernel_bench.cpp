#include "kernel_bench.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>

namespace norrsken {
namespace {

const Scene& room_scene() {
  static const Scene scene = [] {
    LoadOptions options;
    options.parameters = {{"shadow_rays", "1"}};
    options.sampler = "independent";
    const Result<Scene> loaded = Scene::load("hexagon_room", options);
    if (!loaded) throw std::runtime_error("the built-in room does not load");
    return *loaded;
  }();
  return scene;
}

/// A sphere of rows x 2 rows quads, cut in two, its radius disturbed so that nothing is coplanar.
SceneTables sphere_mesh(int triangles) {
  SceneTables tables;
  const int rows = std::max(2, static_cast<int>(std::lround(std::sqrt(triangles / 4.0))));
  const int columns = std::max(3, triangles / (2 * rows));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> bump(0.9, 1.1);
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const double theta = M_PI * (i + 0.01) / (rows + 0.02), phi = 2 * M_PI * k / columns, r = 3 * bump(random);
      for (const double x :
           {5 + r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)}) {
        tables.positions.push_back(static_cast<float>(x));
      }
    }
  }
  const auto vertex = [&](int i, int k) { return static_cast<std::uint32_t>(i * columns + k % columns); };
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      for (const std::uint32_t v : {vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k),
                                    vertex(i + 1, k + 1), vertex(i, k + 1)}) {
        tables.triangle_vertices.push_back(v);
      }
    }
  }
  for (std::uint32_t t = 0; t < tables.triangle_count(); ++t) {
    glm::dvec3 p[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const float* q = tables.positions.data() + 3 * tables.triangle_vertices[3 * t + c];
      p[c] = {q[0], q[1], q[2]};
    }
    const glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    const auto f = [](double x) { return static_cast<float>(x); };
    tables.surfaces.push_back({{f(n.x), f(n.y), f(n.z), f(glm::dot(n, p[0]))},
                               make_material(BsdfKind::diffuse, 0),
                               make_material(BsdfKind::diffuse, 0),
                               0});
  }
  ShapeRecord shape;
  shape.primitive_count = tables.triangle_count();
  tables.shapes = {shape};
  tables.parameters = {0.5f, 0.5f, 0.5f, 0.0f};
  tables.camera = room_scene().tables().tables.camera;
  tables.film = room_scene().tables().tables.film;
  return tables;
}

}  // namespace

BenchScene::BenchScene(std::shared_ptr<const SceneTables> tables, AccelKind kind)
    : tables_(std::move(tables)), accel_(*tables_, kind), view_(make_scene_view(*tables_, accel_.view())) {}

const BenchScene& bench_room(AccelKind kind) {
  static std::map<AccelKind, std::unique_ptr<BenchScene>> scenes;
  auto& scene = scenes[kind];
  if (!scene) {
    scene = std::make_unique<BenchScene>(
        std::shared_ptr<const SceneTables>(&room_scene().tables().tables, [](auto*) {}), kind);
  }
  return *scene;
}

const BenchScene& bench_sphere_mesh(int triangles, AccelKind kind) {
  static std::map<std::pair<int, AccelKind>, std::unique_ptr<BenchScene>> scenes;
  auto& scene = scenes[{triangles, kind}];
  if (!scene) scene = std::make_unique<BenchScene>(std::make_shared<const SceneTables>(sphere_mesh(triangles)), kind);
  return *scene;
}

BenchRays::BenchRays(const BenchScene& scene, bool coherent) {
  constexpr std::uint32_t kSide = 128, kCount = kSide * kSide;
  block_.resize(8 * kCount);
  float* fields[8];
  for (std::size_t k = 0; k < 8; ++k) fields[k] = block_.data() + k * kCount;
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const CameraRecord& camera = scene.tables().camera;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const std::uint32_t column = i % kSide, row = i / kSide;
    const float px = 400.0f + static_cast<float>(column), py = 300.0f + static_cast<float>(row);
    float d[3], length = 0;
    for (int k = 0; k < 3; ++k) {
      d[k] = coherent ? camera.base[k] + px * camera.du[k] + py * camera.dv[k] : normal(random);
      length += d[k] * d[k];
    }
    const float inside[3] = {5 + 4 * unit(random), 4 * unit(random), 4.5f * unit(random)};
    for (int k = 0; k < 3; ++k) {
      fields[k][i] = coherent ? camera.origin[k] : inside[k];
      fields[3 + k][i] = d[k] / std::sqrt(length);
    }
  }
  arrays_ = {fields[0], fields[1], fields[2], fields[3], fields[4], fields[5], kCount};
  t_ = fields[6];
  primitives_ = fields[7];
}

}  // namespace norrsken
