#include "accel/build.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "accel/embree_elements.h"
#include "base/huge_pages.h"

namespace norrsken {
namespace {

Array<float> triangle_extents(const SceneTables& scene) {
  Array<float> extents(scene.triangle_count());
  for (std::size_t i = 0; i < extents.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float* p = scene.positions.data() + std::size_t{3} * scene.triangle_vertices[3 * i + k];
      extents[i] = std::max({extents[i], std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    }
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
  if (kind != AccelKind::planes) {
    triangle_extent_ = triangle_extents(scene);
    view_.triangle_extent = triangle_extent_.data();
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
    move_to_huge_pages(triangle_extent_);
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
