// Meshes and rays for tests of the hierarchy, without a scene around them.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "isa/kernel_testing.h"

namespace norrsken {

/// Triangles of no material.
struct TestMesh {
  SceneTables tables;

  void add_vertex(const glm::dvec3& p) {
    for (int k = 0; k < 3; ++k) tables.positions.push_back(static_cast<float>(p[k]));
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t vertex : {a, b, c}) tables.triangle_vertices.push_back(vertex);
  }
  void add_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<std::uint32_t>(tables.positions.size() / 3);
    for (const glm::dvec3& p : {a, b, c}) add_vertex(p);
    add_triangle(first, first + 1, first + 2);
  }
  glm::dvec3 corner(std::size_t triangle, std::size_t k) const {
    const float* p = tables.positions.data() + std::size_t{3} * tables.triangle_vertices[3 * triangle + k];
    return {p[0], p[1], p[2]};
  }
  std::uint32_t triangle_count() const { return tables.triangle_count(); }

  /// Makes all triangles one shape, which Embree's geometries go by.
  void finish() {
    tables.surfaces.resize(triangle_count());
    tables.shapes.resize(1);
    tables.shapes[0].primitive_count = triangle_count();
  }
};

/// One accelerator's view of it.
struct TestView {
  Accel accel;
  SceneView view;

  TestView(const TestMesh& mesh, AccelKind kind)
      : accel(mesh.tables, kind), view(make_scene_view(mesh.tables, accel.view())) {}
};

struct TestRay {
  glm::vec3 origin, direction;
  float t_max = std::numeric_limits<float>::infinity();
};

struct TestHit {
  float t;
  std::uint32_t primitive_side;

  bool is_hit() const { return primitive_side != kNone; }
  std::uint32_t primitive() const { return primitive_side & 0x7fffffffu; }
  friend bool operator==(const TestHit&, const TestHit&) = default;
};

/// The rays as kernels take them.
class RayBlock {
 public:
  explicit RayBlock(const std::vector<TestRay>& rays) : count_(static_cast<std::uint32_t>(rays.size())) {
    const std::size_t stride = (rays.size() + kMaxLanes) / kMaxLanes * kMaxLanes;
    values_.resize(7 * stride);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        values_[k * stride + i] = rays[i].origin[static_cast<int>(k)];
        values_[(3 + k) * stride + i] = rays[i].direction[static_cast<int>(k)];
      }
      values_[6 * stride + i] = rays[i].t_max;
    }
    const float* v = values_.data();
    arrays_ = {v, v + stride, v + 2 * stride, v + 3 * stride, v + 4 * stride, v + 5 * stride, count_};
    t_max_ = v + 6 * stride;
  }

  std::vector<TestHit> closest(const SceneView& view, const KernelEntry& kernels) const {
    Answers<float> t(count_);
    Answers<std::uint32_t> primitive_side(count_);
    probe_of(kernels).closest_rays(view, false, arrays_, t.data(), primitive_side.data());
    std::vector<TestHit> hits;
    for (std::uint32_t i = 0; i < count_; ++i) hits.push_back({t[i], primitive_side[i]});
    return hits;
  }
  std::vector<bool> occluded(const SceneView& view, const KernelEntry& kernels) const {
    Answers<std::uint8_t> answers(count_);
    kernels.occluded_rays(view, arrays_, t_max_, answers.data());
    std::vector<bool> occluded;
    for (std::uint32_t i = 0; i < count_; ++i) occluded.push_back(answers[i] != 0);
    return occluded;
  }

 private:
  std::uint32_t count_;
  AlignedVector<float> values_;
  RayArrays arrays_{};
  const float* t_max_ = nullptr;
};

/// Numbers for meshes and rays, the same every time.
class TestRandom {
 public:
  explicit TestRandom(unsigned seed) : generator_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(generator_() % n); }
  glm::dvec3 in_cube() { return {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 d = in_cube();
      const double length = glm::length(d);
      if (length > 1e-3 && length < 1) return d / length;
    }
  }

 private:
  std::mt19937 generator_;
};

/// From one point to another.
inline TestRay ray_between(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::vec3 o(from);
  return {o, glm::vec3(glm::normalize(to - glm::dvec3(o)))};
}

inline glm::dvec3 near(const glm::dvec3& p, double size, TestRandom& random) { return p + random.in_cube() * size; }

/// Triangles anywhere in a cube, about `size` of it large.
inline TestMesh soup(std::uint32_t triangles, const glm::dvec3& center, double scale, double size, unsigned seed) {
  TestRandom random(seed);
  TestMesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const glm::dvec3 p = center + random.in_cube() * scale;
    mesh.add_triangle(near(p, size * scale, random), near(p, size * scale, random), near(p, size * scale, random));
  }
  mesh.finish();
  return mesh;
}

/// A closed bumpy sphere around the origin whose triangles share their corners.
inline TestMesh bumpy_sphere(std::uint32_t rows, double scale) {
  TestMesh mesh;
  const std::uint32_t columns = 2 * rows;
  const auto point = [&](double row, double column) {
    const double theta = 3.14159265358979 * row / rows, phi = 6.28318530717959 * column / columns;
    const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    return n * (scale * (1 + 0.1 * std::sin(7 * n.x + 3 * n.y) * std::cos(5 * n.z)));
  };
  mesh.add_vertex(point(0, 0));
  for (std::uint32_t r = 1; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) mesh.add_vertex(point(r, c));
  }
  mesh.add_vertex(point(rows, 0));
  const std::uint32_t last = 1 + (rows - 1) * columns;
  const auto at = [&](std::uint32_t r, std::uint32_t c) {
    return r == 0 ? 0 : r == rows ? last : 1 + (r - 1) * columns + c % columns;
  };
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      if (r + 1 < rows) mesh.add_triangle(at(r, c), at(r + 1, c), at(r + 1, c + 1));
      if (r > 0) mesh.add_triangle(at(r, c), at(r + 1, c + 1), at(r, c + 1));
    }
  }
  mesh.finish();
  return mesh;
}

}  // namespace norrsken
