#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <span>
#include <string>

#include "accel/build.h"
#include "accel/embree_elements.h"
#include "accel/embree_user.h"

namespace norrsken {
namespace {

/// What its threads cannot allocate, Embree calls an unknown error.
constexpr const char* kPerhapsStarved = ": the system may be out of memory or of threads";

/// Consecutive primitives of one class and one group; a shape made of elements has a run of its own.
struct Run {
  enum class Class { triangles, spheres, analytic, elements } of;
  std::uint32_t first, count;
};

std::uint32_t analytic_of(const SceneTables& scene, std::uint32_t primitive) {
  return std::bit_cast<std::uint32_t>(scene.surfaces[primitive].geometry[0]);
}

Run::Class class_of(const SceneTables& scene, std::uint32_t primitive) {
  if (primitive < scene.triangle_count()) return Run::Class::triangles;
  if (primitive < scene.first_analytic) return Run::Class::spheres;
  return has_elements(scene.analytics[analytic_of(scene, primitive)].kind) ? Run::Class::elements
                                                                           : Run::Class::analytic;
}

std::vector<Run> runs_of_group(const SceneTables& scene, std::uint32_t group) {
  std::vector<Run> runs;
  for (const ShapeRecord& shape : scene.shapes) {
    if (shape.group != group || shape.primitive_count == 0) continue;
    const Run run{class_of(scene, shape.first_primitive), shape.first_primitive, shape.primitive_count};
    const bool continues = run.of != Run::Class::elements && !runs.empty() && runs.back().of == run.of &&
                           runs.back().first + runs.back().count == run.first;
    if (continues) {
      runs.back().count += run.count;
    } else {
      runs.push_back(run);
    }
  }
  return runs;
}

RTCGeometry make_triangles(RTCDevice device, const SceneTables& scene, RTCBuffer positions, const Run& run) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0, 3 * sizeof(float),
                       scene.positions.size() / 3);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene.triangle_vertices.data(),
                             std::size_t{run.first} * 3 * sizeof(std::uint32_t), 3 * sizeof(std::uint32_t), run.count);
  return geometry;
}

RTCGeometry make_geometry(RTCDevice device, const SceneTables& scene, std::span<const SphereRecord> spheres,
                          const std::vector<ElementShape>& element_shapes, RTCBuffer positions, const Run& run) {
  switch (run.of) {
    case Run::Class::triangles:
      return make_triangles(device, scene, positions, run);
    case Run::Class::spheres:
      return make_embree_spheres(device, {spheres.data() + (run.first - scene.triangle_count()), run.count});
    case Run::Class::analytic:
      return make_embree_analytics(device, {&scene.analytics[analytic_of(scene, run.first)], run.count});
    case Run::Class::elements:
      return make_embree_elements(device, element_shapes[analytic_of(scene, run.first)]);
  }
  return nullptr;
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  return scene;
}

RTCBuffer copy_positions(RTCDevice device, std::span<const float> positions) {
  // Embree reads 16 bytes from every vertex.
  RTCBuffer buffer = rtcNewBuffer(device, (positions.size() + 1) * sizeof(float));
  void* data = buffer == nullptr ? nullptr : rtcGetBufferData(buffer);
  if (data == nullptr) throw std::bad_alloc();
  if (!positions.empty()) std::memcpy(data, positions.data(), positions.size() * sizeof(float));
  return buffer;
}

}  // namespace

EmbreeScene::EmbreeScene() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) {
    if (rtcGetDeviceError(nullptr) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw AccelFailed(std::string("Embree cannot create a device") + kPerhapsStarved);
  }
  device_ = device;
  rtcSetDeviceMemoryMonitorFunction(
      device,
      [](void* memory, ssize_t bytes, bool post) { return static_cast<EmbreeMemory*>(memory)->report(bytes, post); },
      &memory_);
}

EmbreeMemory::~EmbreeMemory() {
  if (budget_) budget_->give_back(static_cast<std::uint64_t>(taken_.load()));
}

bool EmbreeMemory::report(std::int64_t bytes, bool is_done) noexcept {
  if (!budget_) return true;
  if (bytes < 0) {
    // What a failed build takes back need not have been reported before.
    std::int64_t taken = taken_.load(), back = 0;
    do back = std::min(-bytes, taken);
    while (!taken_.compare_exchange_weak(taken, taken - back));
    budget_->give_back(static_cast<std::uint64_t>(back));
    return true;
  }
  const auto wanted = static_cast<std::uint64_t>(bytes);
  if (budget_->take(wanted)) {
    taken_ += bytes;
    return true;
  }
  std::uint64_t none = 0;
  if (refused_.compare_exchange_strong(none, wanted)) used_when_refused_ = budget_->used();
  return is_done;  // too late to refuse
}

void EmbreeMemory::throw_if_exceeded() const {
  const std::uint64_t wanted = refused_.load();
  if (wanted == 0) return;
  MemoryExceeded exceeded(wanted, *budget_);
  exceeded.used = used_when_refused_.load();
  throw exceeded;
}

EmbreeScene::EmbreeScene(const SceneTables& scene, std::span<const SphereRecord> spheres) : EmbreeScene() {
  try {
    build(scene, spheres);
  } catch (const std::bad_alloc&) {
    memory_.throw_if_exceeded();  // then it is we who had no more
    throw;
  }
}

void EmbreeScene::build(const SceneTables& scene, std::span<const SphereRecord> spheres) {
  const auto device = static_cast<RTCDevice>(device_);
  positions_ = copy_positions(device, scene.positions);
  for (const AnalyticRecord& record : scene.analytics)
    element_shapes_.push_back({&record, scene.texels.data() + record.table});
  add_group(scene, spheres, kNone);
  std::vector<std::uint32_t> group_geometries;
  for (std::uint32_t g = 0; g < scene.group_count; ++g) group_geometries.push_back(add_group(scene, spheres, g));
  add_instances(scene, group_geometries);
  rtcCommitScene(static_cast<RTCScene>(scenes_.front()));
  const RTCError error = rtcGetDeviceError(device);
  memory_.throw_if_exceeded();
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw AccelFailed(std::string("Embree cannot build the scene") + kPerhapsStarved);
}

EmbreeScene::~EmbreeScene() {
  for (void* scene : scenes_) rtcReleaseScene(static_cast<RTCScene>(scene));
  if (positions_ != nullptr) rtcReleaseBuffer(static_cast<RTCBuffer>(positions_));
  rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

/// Returns the number of its first geometry. The world, group kNone, is left open for instances.
std::uint32_t EmbreeScene::add_group(const SceneTables& scene, std::span<const SphereRecord> spheres,
                                     std::uint32_t group) {
  const auto device = static_cast<RTCDevice>(device_);
  RTCScene embree = new_scene(device);
  scenes_.push_back(embree);
  const auto first = static_cast<std::uint32_t>(geometries_.size());
  for (const Run& run : runs_of_group(scene, group)) {
    RTCGeometry geometry =
        make_geometry(device, scene, spheres, element_shapes_, static_cast<RTCBuffer>(positions_), run);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree, geometry, static_cast<std::uint32_t>(geometries_.size()) - first);
    rtcReleaseGeometry(geometry);
    // The elements of a shape that is one primitive are all that primitive.
    const bool one = run.of == Run::Class::elements && run.count == 1;
    geometries_.push_back({run.first, one ? 0u : 1u});
  }
  if (group != kNone) rtcCommitScene(embree);
  return first;
}

void EmbreeScene::add_instances(const SceneTables& scene, const std::vector<std::uint32_t>& group_geometries) {
  first_instance_ =
      group_geometries.empty() ? static_cast<std::uint32_t>(geometries_.size()) : group_geometries.front();
  std::uint32_t id = first_instance_;
  for (const InstanceRecord& instance : scene.instances) {
    RTCGeometry geometry = rtcNewGeometry(static_cast<RTCDevice>(device_), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, static_cast<RTCScene>(scenes_[1 + instance.group]));
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, instance.place.world_from_local);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(static_cast<RTCScene>(scenes_.front()), geometry, id++);
    rtcReleaseGeometry(geometry);
    instance_geometries_.push_back(group_geometries[instance.group]);
  }
}

void EmbreeScene::show(AccelView& view) const {
  view.embree_scene = scenes_.front();
  view.embree_geometries = geometries_.data();
  view.instance_geometries = instance_geometries_.data();
  view.first_instance = first_instance_;
}

}  // namespace norrsken
