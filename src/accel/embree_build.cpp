#include <embree3/rtcore.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "accel/build.h"
#include "accel/sphere.h"

namespace norrsken {
namespace {

using isa_host::cross_sphere;
using isa_host::Vec3f;

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const SphereRecord& s = static_cast<const SphereRecord*>(args->geometryUserPtr)[args->primID];
  // A little larger, so that rounding cannot put the surface outside of its box.
  const float r = s.radius * (1 + 4 * std::numeric_limits<float>::epsilon());
  args->bounds_o->lower_x = s.center[0] - r, args->bounds_o->upper_x = s.center[0] + r;
  args->bounds_o->lower_y = s.center[1] - r, args->bounds_o->upper_y = s.center[1] + r;
  args->bounds_o->lower_z = s.center[2] - r, args->bounds_o->upper_z = s.center[2] + r;
}

/// Distance along the ray, or infinity.
float sphere_distance(const SphereRecord& s, RTCRayN* rays, unsigned n, unsigned i) {
  const Vec3f o{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)};
  const Vec3f d{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
  const isa_host::SphereCrossing c = cross_sphere(s.center, s.radius, o, d);
  const float t = c.t0.v > 0.0f ? c.t0.v : c.t1.v;
  const bool found = c.crosses.v && t > 0.0f && t < RTCRayN_tfar(rays, n, i);
  return found ? t : std::numeric_limits<float>::infinity();
}

void intersect_sphere(const RTCIntersectFunctionNArguments* args) {
  const SphereRecord& s = static_cast<const SphereRecord*>(args->geometryUserPtr)[args->primID];
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const float t = sphere_distance(s, rays, args->N, i);
    if (t == std::numeric_limits<float>::infinity()) continue;
    const float sign = s.back_flip != 0 ? -1.0f : 1.0f;
    RTCRayN_tfar(rays, args->N, i) = t;
    RTCHitN_Ng_x(hits, args->N, i) =
        sign * (RTCRayN_org_x(rays, args->N, i) + t * RTCRayN_dir_x(rays, args->N, i) - s.center[0]);
    RTCHitN_Ng_y(hits, args->N, i) =
        sign * (RTCRayN_org_y(rays, args->N, i) + t * RTCRayN_dir_y(rays, args->N, i) - s.center[1]);
    RTCHitN_Ng_z(hits, args->N, i) =
        sign * (RTCRayN_org_z(rays, args->N, i) + t * RTCRayN_dir_z(rays, args->N, i) - s.center[2]);
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
  }
}

void occlude_sphere(const RTCOccludedFunctionNArguments* args) {
  const SphereRecord& s = static_cast<const SphereRecord*>(args->geometryUserPtr)[args->primID];
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (sphere_distance(s, args->ray, args->N, i) == std::numeric_limits<float>::infinity()) continue;
    RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

void attach_triangles(RTCDevice device, RTCScene target, const SceneTables& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t vertices = scene.positions.size() / 3, triangles = scene.triangle_count();
  void* positions =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices);
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), triangles);
  if (positions == nullptr || indices == nullptr) throw std::bad_alloc();
  std::memcpy(positions, scene.positions.data(), vertices * 3 * sizeof(float));
  std::memcpy(indices, scene.triangle_vertices.data(), triangles * 3 * sizeof(std::uint32_t));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, 0);
  rtcReleaseGeometry(geometry);
}

void attach_spheres(RTCDevice device, RTCScene target, const std::vector<SphereRecord>& spheres) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres.size()));
  rtcSetGeometryUserData(geometry, const_cast<SphereRecord*>(spheres.data()));
  rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_sphere);
  rtcSetGeometryOccludedFunction(geometry, occlude_sphere);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, 1);
  rtcReleaseGeometry(geometry);
}

}  // namespace

EmbreeScene::EmbreeScene() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree cannot create a device");
  device_ = device;
  scene_ = rtcNewScene(device);
}

EmbreeScene::EmbreeScene(const SceneTables& scene, const std::vector<SphereRecord>& spheres) : EmbreeScene() {
  const auto device = static_cast<RTCDevice>(device_);
  const auto embree = static_cast<RTCScene>(scene_);
  rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_HIGH);
  if (scene.triangle_count() > 0) attach_triangles(device, embree, scene);
  if (!spheres.empty()) attach_spheres(device, embree, spheres);
  rtcCommitScene(embree);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(static_cast<RTCScene>(scene_));
  rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

}  // namespace norrsken
