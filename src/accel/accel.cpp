#include "accel/build.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <thread>

#include "accel/embree_elements.h"
#include "base/huge_pages.h"

namespace norrsken {
namespace {

/// What tests that begin from a triangle's corners may be off along its normal is so many ulps of this: each coordinate as
/// far as its axis points along the normal. A ground plane's own height counts, its size does not.
float rounding_extent(const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 normal = glm::abs(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double length = glm::length(normal);
  double extent = 0;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 size = glm::abs(corner);
    extent = std::max(extent, length > 0 ? glm::dot(normal, size) / length : std::max({size.x, size.y, size.z}));
  }
  return static_cast<float>(extent);
}

Array<float> rounding_extents(const SceneTables& scene) {
  Array<float> extents(scene.triangle_count());
  for (std::size_t i = 0; i < extents.size(); ++i) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const float* p = scene.positions.data() + std::size_t{3} * scene.triangle_vertices[3 * i + k];
      corners[k] = {p[0], p[1], p[2]};
    }
    extents[i] = rounding_extent(corners);
  }
  return extents;
}

template <class T>
void move_to_huge_pages(const Array<T>& values) {
  norrsken::move_to_huge_pages(values.data(), values.size() * sizeof(T));
}

}  // namespace

bool bvh_knows(const SceneTables& scene) {
  return scene.group_count == 0 &&
         std::ranges::none_of(scene.analytics, [](const AnalyticRecord& a) { return has_elements(a.kind); });
}

Accel::Accel(const SceneTables& scene, AccelKind kind, Variation variation, int threads) {
  spheres_ = build_spheres(scene);
  view_.kind = kind;
  view_.sphere_count = static_cast<std::uint32_t>(spheres_.size());
  if (kind == AccelKind::embree || kind == AccelKind::moller_trumbore) {
    rounding_extents_ = rounding_extents(scene);
    view_.rounding_extents = rounding_extents_.data();
  }
  if (kind == AccelKind::planes) {
    const auto others = std::stable_partition(
        spheres_.begin(), spheres_.end(), [&](const SphereRecord& s) { return scene.light_of(s.primitive) != kNone; });
    view_.emitter_sphere_count = static_cast<std::uint32_t>(others - spheres_.begin());
    planes_ = build_planes(scene, variation);
    view_.planes = planes_.planes.data();
    view_.polygons = planes_.polygons.data();
    view_.rows = planes_.rows.data();
    view_.all = planes_.all;
    view_.occluders = planes_.occluders;
    view_.emitters = planes_.emitters;
  } else if (kind == AccelKind::bvh) {
    bvh_ = build_bvh(scene, threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()));
    view_.bvh = bvh_.view();
    // Shading looks at what was hit: each ray at another place.
    move_to_huge_pages(scene.positions);
    move_to_huge_pages(scene.normals);
    move_to_huge_pages(scene.texcoords);
    move_to_huge_pages(scene.triangle_vertices);
    move_to_huge_pages(scene.surfaces);
    view_.analytics = scene.analytics.data();
    view_.analytic_count = static_cast<std::uint32_t>(scene.analytics.size());
    view_.first_analytic = scene.first_analytic;
  } else if (kind == AccelKind::embree) {
    embree_ = std::make_unique<EmbreeScene>(scene, spheres_);
    embree_->show(view_);
  }
  view_.spheres = spheres_.data();
}

}  // namespace norrsken
