#include "accel/build.h"

namespace norrsken {

Accel::Accel(const SceneTables& scene, AccelKind kind) {
  spheres_ = build_spheres(scene, view_.emitter_sphere_count);
  view_.kind = kind;
  view_.spheres = spheres_.data();
  view_.sphere_count = static_cast<std::uint32_t>(spheres_.size());
  if (kind == AccelKind::planes) {
    planes_ = build_planes(scene);
    view_.planes = planes_.planes.data();
    view_.polygons = planes_.polygons.data();
    view_.rows = planes_.rows.data();
    view_.all = planes_.all;
    view_.occluders = planes_.occluders;
    view_.emitters = planes_.emitters;
  } else if (kind == AccelKind::embree) {
    embree_ = std::make_unique<EmbreeScene>(scene, spheres_);
    view_.embree_scene = embree_->scene();
  }
}

}  // namespace norrsken
