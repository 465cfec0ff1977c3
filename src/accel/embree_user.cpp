#include "accel/embree_user.h"

#include <cmath>
#include <limits>

#include "accel/embree_callbacks.h"
#include "accel/sphere.h"
#include "math/affine.h"
#include "shape/models.h"

namespace norrsken {
namespace {

using isa_host::Vec3f;

/// Boxes are a little larger, so that rounding cannot put a surface outside of its box.
constexpr float kSlack = 4 * std::numeric_limits<float>::epsilon();

void bounds_of(const SphereRecord& s, RTCBounds& b) {
  const float r = s.radius * (1 + kSlack);
  b.lower_x = s.center[0] - r, b.upper_x = s.center[0] + r;
  b.lower_y = s.center[1] - r, b.upper_y = s.center[1] + r;
  b.lower_z = s.center[2] - r, b.upper_z = s.center[2] + r;
}

UserHit intersect(const SphereRecord& s, const Vec3f& o, const Vec3f& d, float t_max) {
  const float length = std::sqrt(dot(d, d).v);
  const isa_host::SphereCrossing c = isa_host::cross_sphere(s.center, s.radius, o, d * isa_host::Float(1 / length));
  const float t = (c.t0.v > 0.0f ? c.t0.v : c.t1.v) / length;
  if (!(c.crosses.v && t > 0.0f && t < t_max)) return {};
  const Vec3f outwards = fma(d, isa_host::Float(t), o) - isa_host::broadcast(s.center);
  return {t, s.back_flip != 0 ? -outwards : outwards};
}

/// Of the disk and the cylinder: the box [-1, 1] x [-1, 1] x [0, 1].
void bounds_of(const AnalyticRecord& a, RTCBounds& b) {
  float lower[3], upper[3];
  for (int k = 0; k < 3; ++k) {
    const float* row = a.place.world_from_local + 4 * k;
    const float depth = a.kind == AnalyticKind::cylinder ? row[2] : 0.0f;
    const float across = std::sqrt(row[0] * row[0] + row[1] * row[1]);
    const float slack = kSlack * (across + std::abs(depth) + std::abs(row[3]));
    lower[k] = row[3] - across + std::fmin(depth, 0.0f) - slack;
    upper[k] = row[3] + across + std::fmax(depth, 0.0f) + slack;
  }
  b.lower_x = lower[0], b.lower_y = lower[1], b.lower_z = lower[2];
  b.upper_x = upper[0], b.upper_y = upper[1], b.upper_z = upper[2];
}

template <class Model>
UserHit intersect_in_place(const AnalyticRecord& a, const Vec3f& o, const Vec3f& d, float t_max) {
  if constexpr (isa_host::kHasElements<Model>) {
    return {};  // src/accel/embree_elements.cpp has those
  } else {
    const isa_host::UInt zero(0u);
    const isa_host::Mask active{true};
    const isa_host::Affine local_from_world = isa_host::gather_affine(a.place.local_from_world, zero, active);
    const Vec3f local_o = local_from_world.point(o), local_d = local_from_world.vector(d);
    const isa_host::LocalHit hit = Model::intersect(local_o, local_d, isa_host::Float(t_max));
    if (!hit.hit.v) return {};
    const Vec3f n = local_from_world.transposed(Model::surface_at(fma(local_d, hit.t, local_o)).normal);
    return {hit.t.v, a.flip_normals != 0 ? -n : n};
  }
}

UserHit intersect(const AnalyticRecord& a, const Vec3f& o, const Vec3f& d, float t_max) {
  switch (a.kind) {
#define NORRSKEN_ANALYTIC(kind, Model) \
  case AnalyticKind::kind:             \
    return intersect_in_place<isa_host::Model>(a, o, d, t_max);
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    case AnalyticKind::count:
      break;
  }
  return {};
}

template <class Record>
struct Records {
  static void bounds_of(const void* records, unsigned i, RTCBounds& b) {
    norrsken::bounds_of(static_cast<const Record*>(records)[i], b);
  }
  static UserHit intersect(const void* records, unsigned i, const Vec3f& o, const Vec3f& d, float t_max) {
    return norrsken::intersect(static_cast<const Record*>(records)[i], o, d, t_max);
  }
};

}  // namespace

RTCGeometry make_embree_spheres(RTCDevice device, std::span<const SphereRecord> spheres) {
  return make_user_geometry<Records<SphereRecord>>(device, spheres.data(), spheres.size());
}

RTCGeometry make_embree_analytics(RTCDevice device, std::span<const AnalyticRecord> shapes) {
  return make_user_geometry<Records<AnalyticRecord>>(device, shapes.data(), shapes.size());
}

}  // namespace norrsken
