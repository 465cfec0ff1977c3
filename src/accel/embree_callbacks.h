// What Embree's callbacks for geometry of our own have in common: only how one primitive meets one ray differs.
#pragma once

#include <embree3/rtcore.h>

#include <limits>

#include "math/vec3.h"

namespace norrsken {

constexpr float kNowhere = std::numeric_limits<float>::infinity();

/// A user primitive's answer: distance along the ray, infinite if it is not met nearer than `t_max`, and its normal,
/// of any length.
struct UserHit {
  float t = kNowhere;
  isa_host::Vec3f normal{0.0f, 0.0f, 0.0f};
};

/// A `Primitives` is what the geometry's user data point to, with
///   static void bounds_of(const void* data, unsigned primitive, RTCBounds&);
///   static UserHit intersect(const void* data, unsigned primitive, const Vec3f& origin, const Vec3f& direction, float t_max);
/// where the direction may have any length.
template <class Primitives>
UserHit intersect_ray(const void* data, unsigned primitive, RTCRayN* rays, unsigned n, unsigned i) {
  return Primitives::intersect(
      data, primitive, {RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
      {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)}, RTCRayN_tfar(rays, n, i));
}

template <class Primitives>
void bounds_callback(const RTCBoundsFunctionArguments* args) {
  Primitives::bounds_of(args->geometryUserPtr, args->primID, *args->bounds_o);
}

template <class Primitives>
void intersect_callback(const RTCIntersectFunctionNArguments* args) {
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const UserHit met = intersect_ray<Primitives>(args->geometryUserPtr, args->primID, rays, args->N, i);
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

template <class Primitives>
void occluded_callback(const RTCOccludedFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const UserHit met = intersect_ray<Primitives>(args->geometryUserPtr, args->primID, args->ray, args->N, i);
    if (met.t == kNowhere) continue;
    RTCRayN_tfar(args->ray, args->N, i) = -kNowhere;
  }
}

/// To commit and attach; borrows the data.
template <class Primitives>
RTCGeometry make_user_geometry(RTCDevice device, const void* data, std::size_t count) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
  rtcSetGeometryUserData(geometry, const_cast<void*>(data));
  rtcSetGeometryBoundsFunction(geometry, bounds_callback<Primitives>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback<Primitives>);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback<Primitives>);
  return geometry;
}

}  // namespace norrsken
