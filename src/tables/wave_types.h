// What host and kernels hand each other while rendering: the view of the scene, a wave's job, its memory, the film.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tables/accel_tables.h"
#include "tables/film_view.h"
#include "tables/queue.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Independent scramblings of the Sobol' points per pixel; sample s belongs to replicate s % kReplicates. As few as tell an
/// error: where points are spread evenly the more of them help each other the more there are in one scrambling.
inline constexpr std::uint32_t kReplicates = 2;
/// The same of paths from the lights. All pixels share them, so no neighbours make up for what few replicates do not tell;
/// and there are so many paths in each that fewer would not be spread more evenly.
inline constexpr std::uint32_t kLightReplicates = 4;

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
  /// Paths are scattered by media, and whatever light passes straight through stands in no light's way: the integrator wants
  /// it so, and the scene has such things.
  bool volumetric = false;
  const MediumRecord* media = nullptr;
  const VolumeRecord* volumes = nullptr;
  std::uint32_t phase_kinds = 0;  ///< bit k: PhaseKind k occurs
  bool any_grid_medium = false;
  bool any_area_light = false;
  CameraRecord camera;
  const CameraRecord* batch = nullptr;  ///< the cameras that a batch joins side by side
  std::uint32_t batch_count = 0;
  const float* meter = nullptr;  ///< pieces of surface that meters look at or stand on
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

/// Where rays ended.
struct FoundQueues {
  Queue<stored::Hit> hits[kModelCount];  ///< by BSDF kind; [0], absorb, for features alone
  Queue<stored::Hit> unresolved_hits;    ///< on materials that are looked through before shading
  Queue<stored::Hit> light_hits;         ///< on surfaces that emit; they may be in `hits` too
  Queue<stored::Ray> misses;             ///< only filled if the scene has an environment
};

/// Of paths in media.
struct MediaQueues {
  Queue<stored::Scatter> scatters[kPhaseModelCount];  ///< by PhaseKind
  Queue<stored::Ray> passed;                          ///< rays behind what they went straight through
  Queue<stored::Track> tracks, next_tracks;
  Queue<stored::ShadowRay> next_shadow_rays;
  Queue<stored::ShadowTrack> shadow_tracks, next_shadow_tracks;
};

/// One worker's memory for one wave.
struct WaveMemory {
  Queue<stored::Slot> slots;  ///< one per path, in the order of WaveJob
  Queue<stored::Ray> rays, next_rays;
  FoundQueues found;
  Queue<stored::ShadowRay> shadow_rays;
  Queue<stored::Connection> connections;  ///< this and the next only for paths from the lights
  Queue<stored::Splat> splats;            ///< several bounces of a wave
  MediaQueues media;                      ///< only for scenes that are `volumetric`
  WaveObserver observer;

  void tell(WaveEvent event) const {
    if (observer.see != nullptr) observer.see(observer.self, event, *this);
  }
};

/// Counted by a wave.
struct WaveCounts {
  std::uint64_t closest_rays = 0;
  std::uint64_t shadow_rays = 0;
  /// Rays that crossed the boundary of a medium from a side that belongs to another one, and the first shape where any did.
  std::uint64_t wrong_media = 0;
  std::uint32_t wrong_medium_shape = kNone;
};

}  // namespace norrsken
