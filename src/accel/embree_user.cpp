#include "accel/embree_user.h"

#include <cmath>
#include <limits>

#include "accel/sphere.h"
#include "math/affine.h"
#include "shape/cylinder.h"
#include "shape/disk.h"

namespace norrsken {
namespace {

using isa_host::Vec3f;

constexpr float kNowhere = std::numeric_limits<float>::infinity();
/// Boxes are a little larger, so that rounding cannot put a surface outside of its box.
constexpr float kSlack = 4 * std::numeric_limits<float>::epsilon();

/// A user primitive's answer: distance along the ray, infinite if it is not met nearer than `t_max`, and its normal,
/// of any length.
struct Met {
  float t = kNowhere;
  Vec3f normal{0.0f, 0.0f, 0.0f};
};

// --- what the primitives are: records with their bounds and their meeting with a ray, whose direction may have any length

void bounds_of(const SphereRecord& s, RTCBounds& b) {
  const float r = s.radius * (1 + kSlack);
  b.lower_x = s.center[0] - r, b.upper_x = s.center[0] + r;
  b.lower_y = s.center[1] - r, b.upper_y = s.center[1] + r;
  b.lower_z = s.center[2] - r, b.upper_z = s.center[2] + r;
}

Met meet(const SphereRecord& s, const Vec3f& o, const Vec3f& d, float t_max) {
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
Met meet_in_place(const AnalyticRecord& a, const Vec3f& o, const Vec3f& d, float t_max) {
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

Met meet(const AnalyticRecord& a, const Vec3f& o, const Vec3f& d, float t_max) {
  switch (a.kind) {
#define NORRSKEN_ANALYTIC(kind, Model) \
  case AnalyticKind::kind:             \
    return meet_in_place<isa_host::Model>(a, o, d, t_max);
#include "shape/list.def"
#undef NORRSKEN_ANALYTIC
    case AnalyticKind::count:
      break;
  }
  return {};
}

// --- Embree's side

template <class Record>
Met meet_ray(const Record& record, RTCRayN* rays, unsigned n, unsigned i) {
  return meet(record, {RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
              {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
              RTCRayN_tfar(rays, n, i));
}

template <class Record>
void bounds_callback(const RTCBoundsFunctionArguments* args) {
  bounds_of(static_cast<const Record*>(args->geometryUserPtr)[args->primID], *args->bounds_o);
}

template <class Record>
void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  const Record& record = static_cast<const Record*>(args->geometryUserPtr)[args->primID];
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const Met met = meet_ray(record, rays, args->N, i);
    if (met.t == kNowhere) continue;
    RTCRayN_tfar(rays, args->N, i) = met.t;
    RTCHitN_Ng_x(hits, args->N, i) = met.normal.x.v;
    RTCHitN_Ng_y(hits, args->N, i) = met.normal.y.v;
    RTCHitN_Ng_z(hits, args->N, i) = met.normal.z.v;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
  }
}

template <class Record>
void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  const Record& record = static_cast<const Record*>(args->geometryUserPtr)[args->primID];
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (meet_ray(record, args->ray, args->N, i).t == kNowhere) continue;
    RTCRayN_tfar(args->ray, args->N, i) = -kNowhere;
  }
}

template <class Record>
RTCGeometry make_user_geometry(RTCDevice device, std::span<const Record> records) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(records.size()));
  rtcSetGeometryUserData(geometry, const_cast<Record*>(records.data()));
  rtcSetGeometryBoundsFunction(geometry, bounds_callback<Record>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback<Record>);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback<Record>);
  return geometry;
}

}  // namespace

RTCGeometry make_embree_spheres(RTCDevice device, std::span<const SphereRecord> spheres) {
  return make_user_geometry(device, spheres);
}

RTCGeometry make_embree_analytics(RTCDevice device, std::span<const AnalyticRecord> shapes) {
  return make_user_geometry(device, shapes);
}

}  // namespace norrsken
