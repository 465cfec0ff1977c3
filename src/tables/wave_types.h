// What host and kernels hand each other while rendering: the view of the scene, a wave's job, its memory, the film.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tables/accel_tables.h"
#include "tables/film_view.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Independent scramblings of the Sobol' points per pixel; sample s belongs to replicate s % kReplicates.
inline constexpr std::uint32_t kReplicates = 4;

inline constexpr std::uint32_t kMaxLanes = 16;

/// The scene as kernels see it. Borrowed from SceneTables, AccelTables and the Embree scene.
struct SceneView {
  const float* positions = nullptr;
  const float* normals = nullptr;  ///< null if no shape is smooth
  const std::uint32_t* triangle_vertices = nullptr;
  const SurfaceRecord* surfaces = nullptr;
  const ShapeRecord* shapes = nullptr;
  const float* parameters = nullptr;
  const float* texels = nullptr;
  const float* texcoords = nullptr;  ///< null if no shape has any
  const LightRecord* lights = nullptr;
  const LightNode* light_nodes = nullptr;  ///< null where lights are chosen by power alone
  const std::uint32_t* light_leaves = nullptr;
  const AroundLight* lights_around = nullptr;
  const std::uint32_t* primitive_lights = nullptr;
  const AnalyticRecord* analytics = nullptr;
  const InstanceRecord* instances = nullptr;
  std::uint32_t triangle_count = 0, sphere_count = 0, light_count = 0, instance_count = 0;
  std::uint32_t lights_around_count = 0;  ///< with the tree
  std::uint32_t first_analytic = kNone;   ///< primitive; kNone if there is none
  std::uint32_t analytic_kinds = 0;       ///< bit k: AnalyticKind k occurs
  std::uint32_t bsdf_kinds = 0;           ///< bit k: BsdfKind k occurs
  std::uint32_t texture_kinds = 0;        ///< bit k: TextureKind k occurs
  std::uint32_t light_kinds = 0;          ///< bit k: LightKind k occurs
  std::uint32_t environment = kNone;      ///< index of the light that rays to nowhere see
  float center[3] = {};                   ///< of a sphere around all surfaces
  float radius = 0;
  bool any_smooth = false;
  bool refracts = false;      ///< BSDFs that refract occur
  bool any_resolved = false;  ///< materials that are looked through at each hit occur
  /// Codes (see bsdf/resolved.h) that lead to every model behind a material; 1 if the ways are left to chance.
  std::uint32_t material_codes = 1;
  bool needs_uv = false;  ///< something looks at texture coordinates or tangents
  bool any_area_light = false;
  CameraRecord camera;
  FilmSettings film;
  std::uint32_t features = 0;     ///< bit k: Feature k is wanted
  const float* filter = nullptr;  ///< the reconstruction filter's table, if it has one
  SamplerSettings sampler;
  IntegratorSettings integrator;
  AccelView accel;
};

/// Samples [first_sample, first_sample + sample_count) of a rectangle of pixels.
/// Slot of pixel p (row by row in the rectangle) and the rectangle's sample s: s * pixel_stride + p.
struct WaveJob {
  std::uint32_t x0 = 0, y0 = 0, width = 0, height = 0;
  std::uint32_t first_sample = 0, sample_count = 0;

  std::uint32_t pixel_count() const { return width * height; }
  /// Rows of slots begin at a full register.
  std::uint32_t pixel_stride() const { return (pixel_count() + kMaxLanes - 1) / kMaxLanes * kMaxLanes; }
  std::uint32_t slot_count() const { return pixel_stride() * sample_count; }
};

/// Records in structure-of-arrays form: field k of record i is data[k * stride + i]. Integers are stored as their bits.
/// Every field begins at a multiple of 64 bytes and has kMaxLanes values to spare at its end.
struct Queue {
  float* data = nullptr;
  std::uint32_t stride = 0;
  std::uint32_t count = 0;
  std::uint32_t capacity = 0;

  float* field(std::uint32_t k) const { return data + static_cast<std::size_t>(k) * stride; }
};

struct WaveMemory;

/// What has just been done to a wave.
enum class WaveEvent {
  camera_rays,  ///< they are in `rays`
  intersected,  ///< `rays` ended in `hits`, `unresolved_hits`, `light_hits` and `misses`
  emission,     ///< of the light hits and misses: it is in the slots
  resolved,     ///< by chance: `unresolved_hits` became `hits`
  shadow_rays,  ///< `shadow_rays` are about to be asked
  next_rays     ///< the bounce is done; they are in `rays`
};

/// Somebody who follows a wave, to tell what became of one sample.
struct WaveObserver {
  void (*see)(void* self, WaveEvent event, const WaveMemory& memory) = nullptr;
  void* self = nullptr;
};

/// One worker's memory for one wave.
struct WaveMemory {
  Queue slots;              ///< SlotField, one record per slot
  Queue rays, next_rays;    ///< RayField
  Queue hits[kModelCount];  ///< HitField, one queue per BSDF kind; [0], absorb, for features alone
  Queue unresolved_hits;    ///< HitField: materials that are looked through before shading
  Queue light_hits;         ///< HitField
  Queue misses;             ///< RayField; only filled if the scene has an environment
  Queue shadow_rays;        ///< ShadowField
  Queue connections;        ///< ConnectionField; this and the next only for paths from the lights
  Queue splats;             ///< SplatField, several bounces of a wave
  WaveObserver observer;

  void tell(WaveEvent event) const {
    if (observer.see != nullptr) observer.see(observer.self, event, *this);
  }
};

/// Fields of the records, by number. src/wave/records.h has the lane types that go in and out.
enum SlotField : std::uint32_t {
  kSlotRed,
  kSlotGreen,
  kSlotBlue,
  kSlotKey,
  kSlotIndex,
  kSlotWeight,    ///< of the reconstruction filter; only written and read if it is not a box
  kSlotFeatures,  ///< kFeatureCount fields
  kSlotFieldCount = kSlotFeatures + kFeatureCount
};
enum RayField : std::uint32_t {
  kRayOriginX,
  kRayOriginY,
  kRayOriginZ,
  kRayDirectionX,
  kRayDirectionY,
  kRayDirectionZ,
  kRayThroughputRed,
  kRayThroughputGreen,
  kRayThroughputBlue,
  kRayPdf,
  kRayEta2,  ///< only written and read if the scene `refracts`
  kRaySlot,
  kRayFieldCount
};
/// A hit is its ray and where it ended.
/// kHitMaps are only written and read if the scene has `any_resolved`, kHitInstance if it has instances.
enum HitField : std::uint32_t {
  kHitDistance = kRayFieldCount,
  kHitPrimitive,
  kHitMaterial,
  kHitMaps,  ///< kMostMaps fields
  kHitInstance = kHitMaps + kMostMaps,
  kHitFieldCount
};
enum ShadowField : std::uint32_t {
  kShadowOriginX,
  kShadowOriginY,
  kShadowOriginZ,
  kShadowDirectionX,
  kShadowDirectionY,
  kShadowDirectionZ,
  kShadowDistance,
  kShadowRed,
  kShadowGreen,
  kShadowBlue,
  kShadowSlot,
  kShadowFieldCount
};
/// A connection is a shadow ray to the camera and where on the film it arrives.
enum ConnectionField : std::uint32_t { kConnectionFilmX = kShadowFieldCount, kConnectionFilmY, kConnectionFieldCount };
/// What a path from a light leaves on the film: position in pixels, and radiance times the film's pixels per path.
enum SplatField : std::uint32_t {
  kSplatFilmX,
  kSplatFilmY,
  kSplatRed,
  kSplatGreen,
  kSplatBlue,
  kSplatSlot,
  kSplatFieldCount
};

/// Counted by a wave.
struct WaveCounts {
  std::uint64_t closest_rays = 0;
  std::uint64_t shadow_rays = 0;
};

}  // namespace norrsken
