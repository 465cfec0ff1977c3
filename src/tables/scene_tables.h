// The scene as plain arrays: all that kernels may read. Filled by src/compile, never changed while rendering.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/memory.h"
#include "tables/medium_tables.h"

namespace norrsken {

/// Scattering models as kernels tell them apart. Order and names come from src/lists/bsdf.def; `absorb` (no scattering
/// at all, also the back of a one-sided surface) is always 0. Behind the models come the adapters that are looked
/// through at each hit (a mask, a blend): hits are never shaded with those.
enum class BsdfKind : std::uint8_t {
  absorb,
#define NORRSKEN_BSDF(kind, Model) kind,
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
#define NORRSKEN_BSDF_RESOLVED(kind, Adapter) kind,
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
  count
};
inline constexpr std::uint32_t kModelCount = 1
#define NORRSKEN_BSDF(kind, Model) +1
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    ;

/// The models whose samples may have an `eta` other than 1.
inline constexpr std::uint32_t kRefractingKinds = 1u << static_cast<std::uint32_t>(BsdfKind::dielectric) |
                                                  1u << static_cast<std::uint32_t>(BsdfKind::roughdielectric) |
                                                  1u << static_cast<std::uint32_t>(BsdfKind::principled) |
                                                  1u << static_cast<std::uint32_t>(BsdfKind::gltf);
/// Bump and normal maps one inside the other: as many as a hit remembers.
inline constexpr std::uint32_t kMostMaps = 4;
/// Of maps: normals that turn away from the viewer are folded back; light on bumps ends softly; this is the map as it is
/// seen from the back.
inline constexpr std::uint32_t kPerturbFlips = 1, kPerturbShadows = 2, kPerturbBack = 4;

/// A BSDF in one word: bit 31 says that the surface also emits on this side, bits 24 to 30 hold the kind, the rest the
/// offset of its first float in `parameters`.
using MaterialWord = std::uint32_t;
inline constexpr MaterialWord kEmitsBit = 0x80000000u;
inline constexpr MaterialWord kMaterialKindMask = 0x7f000000u;
inline constexpr MaterialWord kMaterialOffsetMask = 0x00ffffffu;
constexpr MaterialWord make_material(BsdfKind kind, std::uint32_t offset) {
  return (static_cast<std::uint32_t>(kind) << 24) | offset;
}
constexpr BsdfKind material_kind(MaterialWord word) { return static_cast<BsdfKind>((word & kMaterialKindMask) >> 24); }

/// Textures as kernels tell them apart; 0 says that the parameter is a plain value.
enum class TextureKind : std::uint8_t {
  none,
#define NORRSKEN_TEXTURE(kind, Model) kind,
#include "lists/texture.def"
#undef NORRSKEN_TEXTURE
  count
};

/// A texture in one word, as a material is: the kind, and the offset of its first float in `parameters`.
using TextureWord = std::uint32_t;
inline constexpr TextureWord kTextureKindMask = 0xff000000u;
inline constexpr TextureWord kTextureOffsetMask = 0x00ffffffu;
constexpr TextureWord make_texture(TextureKind kind, std::uint32_t offset) {
  return (static_cast<std::uint32_t>(kind) << 24) | offset;
}
constexpr TextureKind texture_kind(TextureWord word) { return static_cast<TextureKind>(word >> 24); }

/// Shapes that have a formula of their own and a place, as kernels tell them apart.
enum class AnalyticKind : std::uint32_t {
#define NORRSKEN_ANALYTIC(kind, Model) kind,
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
  count
};

/// One per primitive, in order: all triangles, then all spheres, then all analytic primitives. Gathered field by field. Of
/// large meshes these records are most of the memory, so what few surfaces have is told elsewhere.
struct SurfaceRecord {
  /// Triangle: unit geometric normal n and n.p; sphere: centre and radius; analytic: the bits of its index in `analytics`
  /// and of the element's number in its shape.
  float geometry[4];
  MaterialWord material_front;  ///< for rays that come from the side the normal points to; with kEmitsBit on lights
  MaterialWord material_back;
  std::uint32_t shape;  ///< index into `shapes`
  /// Triangle: sine of the largest angle between its normal and those of its vertices; above 1 if one is of more than 90
  /// degrees, below 0 if they have none. Rays whose cosine is larger see the same side by both.
  float turned_below = -1;
};
static_assert(sizeof(SurfaceRecord) == 32, "none lies across two cache lines");
static_assert(offsetof(SurfaceRecord, material_back) == offsetof(SurfaceRecord, material_front) + sizeof(MaterialWord),
              "kernels find the word of a side as the first or second of two");

/// What is evaluated on a shape, and with it whether coplanar triangles may count as one.
enum class Variation : std::uint32_t {
  none,        ///< nothing but position and normal matters
  over_uv,     ///< texture coordinates or tangents do
  by_triangle  ///< so does which triangle it is, as values per vertex or per triangle ask
};

struct ShapeRecord {
  std::uint32_t first_primitive = 0;
  std::uint32_t primitive_count = 0;
  std::uint32_t smooth = 0;                 ///< 1: the triangles' vertices have shading normals
  std::uint32_t flip_normals = 0;           ///< 1 (spheres): the normal points to the centre
  std::uint32_t has_texcoords = 0;          ///< 1: the triangles' vertices have texture coordinates
  std::uint32_t object_from_world = kNone;  ///< spheres that are rotated: 9 floats in `parameters`, row by row
  std::uint32_t group = kNone;              ///< the group it is in, or kNone for the world
  std::uint32_t lights = kNone;             ///< where its primitives begin in `primitive_lights`; kNone: no light
  Variation variation = Variation::none;    ///< for the host alone
  /// Media behind the surface and before it, where its geometric normal points to: kNone for a vacuum, kSameMedium where it
  /// bounds none.
  std::uint32_t interior = kSameMedium, exterior = kSameMedium;
};

/// Where something with a space of its own stands. Affine maps, row by row; the fourth of each row is the translation.
struct Placement {
  float world_from_local[12];
  float local_from_world[12];
};

/// An analytic shape.
struct AnalyticRecord {
  Placement place;
  AnalyticKind kind;
  std::uint32_t flip_normals;  ///< 1: the local normal, taken to the world by the inverse transpose, is turned around
  float area;                  ///< in the world
  std::uint32_t table = 0;     ///< offset of what else the kind keeps in `texels`
  std::uint32_t element_count = 1;  ///< of shapes made of elements: segments, voxels
};

/// A group of shapes in a place. What is in a group is stored once and has no place of its own in the world.
struct InstanceRecord {
  Placement place;
  std::uint32_t group;
};

/// What next-event estimation chooses among. An area light is one record per triangle, parallelogram or sphere.
enum class LightKind : std::uint32_t {
#define NORRSKEN_LIGHT(kind, Model, is_delta) kind,
#include "lists/light.def"
#undef NORRSKEN_LIGHT
  count
};

/// 21 floats: gathered when there are several lights, broadcast when there is one.
struct LightRecord {
  LightKind kind;
  float prob;        ///< probability of being chosen
  float area;        ///< of the surface; 0 for a point
  float alias_prob;  ///< alias method (Vose 1991): keep this record if u < alias_prob, else take `alias`
  std::uint32_t alias;
  float origin[3];  ///< first corner, centre or position
  float edge1[3];   ///< sphere: x = radius, y = 1 for a flipped normal
  float edge2[3];
  float normal[3];    ///< unit, on the side that emits
  float emission[3];  ///< radiance (area lights) or radiant intensity (point), linear sRGB; a mean if textured
  /// Offset of what else the kind keeps in `parameters`, or kNone if nothing: see the kind's class. For the lights of
  /// surfaces it begins with the word of the texture that is their radiance, or 0.
  std::uint32_t parameters = kNone;
};

inline constexpr std::uint32_t kLightLeafBit = 0x80000000u;

/// A node of the tree over the lights that have a place (src/light/light_tree.h): what bounds them, and what they send.
/// Gathered field by field. Node 0 is the root; siblings stand side by side, the left one first.
struct LightNode {
  float center[3];
  float intensity;        ///< where they face, in units of the whole
  std::uint32_t axis;     ///< of a cone that holds all normals: its components from -1 to 1 in ten bits each
  std::uint32_t normals;  ///< cosine (-1 to 1, the lower half) and sine (0 to 1) of the cone's angle
  /// The upper halves of two floats: the radius squared of a sphere around the lights, and in the lower half the slope:
  /// 1 - slope (1 - cos(angle)) is 1 along a normal and 0 where emission ends.
  std::uint32_t extent;
  std::uint32_t content;  ///< the left child; or with kLightLeafBit the one light
  std::uint32_t parent;
};

/// Sensors as kernels tell them apart.
enum class CameraKind : std::uint32_t {
#define NORRSKEN_CAMERA(kind, Model) kind,
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
#define NORRSKEN_METER(kind, Model) kind,
#include "lists/meter.def"
#undef NORRSKEN_METER
#define NORRSKEN_SENSOR_ADAPTER(kind) kind,
#include "lists/sensor_adapter.def"
#undef NORRSKEN_SENSOR_ADAPTER
  count
};

/// Film position (px, py), in pixels from the corner of the whole film, has the point base + px * du + py * dv: on the
/// near plane (orthographic), or, seen from `origin`, one unit ahead (perspective) or in the plane of focus (thinlens).
struct CameraRecord {
  CameraKind kind;
  float origin[3];
  float base[3];
  float du[3];
  float dv[3];
  float forward[3];  ///< unit; near and far are distances along it
  float near_clip, far_clip;
  float lens_x[3], lens_y[3];              ///< thinlens: radii of the lens
  std::uint32_t first_piece, piece_count;  ///< meters: floats in `meter` before, and number of, the surface's pieces
  std::uint32_t medium = kNone;            ///< that it stands in, or kNone
};

enum class SamplerKind : std::uint32_t { independent, sobol };
/// Reconstruction filters are sampled: in closed form (box) or from a table.
enum class FilterKind : std::uint32_t { box, tabulated };

/// A filter's table in SceneTables::filter, arrays one behind the other (src/rfilter/filter.h says what they hold).
struct FilterRecord {
  FilterKind kind = FilterKind::box;
  std::uint32_t nodes = 0;  ///< of the piecewise linear filter from 0 to its radius
  std::uint32_t cells = 0;  ///< of the guide into them
  std::uint32_t edges = 0;  ///< pixels from the film's border on, counted from 0, whose filter reaches beyond it
  bool signs = false;       ///< it has negative lobes
};

/// The colour channels that image files have, and whether they have alpha.
enum class PixelFormat : std::uint32_t { rgb, rgba, xyz, xyza, luminance, luminance_alpha };

/// What is rendered is a rectangle (the crop window) of the whole film.
struct FilmSettings {
  int width = 0, height = 0;            ///< of the rectangle
  int full_width = 0, full_height = 0;  ///< of the film that the camera sees
  int crop_x = 0, crop_y = 0;           ///< the rectangle's corner in it
  bool sample_border = false;           ///< filters of pixels at the border reach beyond it
  FilterRecord filter;
  PixelFormat pixel_format = PixelFormat::rgb;
  bool half_precision = false;  ///< image files hold 16-bit floats

  bool opaque = false;  ///< alpha is 1 everywhere: there is light from everywhere

  bool is_xyz() const { return pixel_format == PixelFormat::xyz || pixel_format == PixelFormat::xyza; }
  bool is_luminance() const {
    return pixel_format == PixelFormat::luminance || pixel_format == PixelFormat::luminance_alpha;
  }
  bool has_alpha() const {
    return pixel_format == PixelFormat::rgba || pixel_format == PixelFormat::xyza ||
           pixel_format == PixelFormat::luminance_alpha;
  }
};

/// Samples per pixel fit an int.
inline constexpr std::int64_t kMaxSampleCount = 0x7fffffff;

struct SamplerSettings {
  SamplerKind kind = SamplerKind::sobol;
  std::int64_t samples_per_pixel = 4;
  std::uint64_t seed = 0;
};

/// All integrators are settings of one loop.
struct IntegratorSettings {
  int max_depth = -1;           ///< as in Mitsuba: 1 emitters only, 2 direct light, -1 unbounded
  int rr_depth = 5;             ///< depth from which Russian roulette ends paths
  int emitter_samples = 1;      ///< shadow rays per hit; 0: none
  bool diffuse_bounces = true;  ///< false (whitted): only delta scattering is followed, light sampling alone
  int bsdf_samples = 1;         ///< directions sampled at the first hit; 0: none, light sampling alone
  bool distance = false;        ///< the image is the distance from the camera
  bool hide_emitters = false;   ///< the camera looks through surfaces that emit, and sees no environment
  bool media = false;           ///< paths are scattered by media (volpath)
  bool from_lights = false;  ///< ptracer: paths start at the lights, and every surface they hit is shown to the camera
  /// Whether surfaces sample directions wherever they sample lights, so that paths find lights by themselves too.
  bool finds_lights() const { return !from_lights && diffuse_bounces && bsdf_samples > 0; }
};

/// A cell of the alias table by which a light around the scene, or the tree, is chosen where lights are chosen by place.
struct AroundLight {
  std::uint32_t light;  ///< kNone: the tree
  std::uint32_t alias;  ///< in its place, with the probability 1 - keep
  float keep;
  float prob;  ///< of `light` in all
};

/// The arrays. Triangle i has corners positions[3 * triangle_vertices[3 * i + k] ...].
struct SceneTables {
  Array<float> positions;                  ///< 3 per vertex, world space
  Array<float> normals;                    ///< 3 per vertex or empty if no shape is smooth
  Array<float> texcoords;                  ///< 2 per vertex or empty
  Array<std::uint32_t> triangle_vertices;  ///< 3 per triangle
  Array<SurfaceRecord> surfaces;           ///< triangles, then spheres, then analytic primitives
  Array<ShapeRecord> shapes;
  Array<AnalyticRecord> analytics;
  Array<InstanceRecord> instances;
  std::uint32_t group_count = 0;
  std::uint32_t first_analytic = kNone;  ///< primitive; kNone if there is none
  Array<float> parameters;               ///< of BSDFs, textures and lights, each at its own offset
  Array<float> texels;                   ///< of bitmaps, grids and tables, each at its own offset
  Array<MediumRecord> media;
  Array<VolumeRecord> volumes;
  std::uint32_t phase_kinds = 0;  ///< bit k: PhaseKind k occurs
  /// By primitive of the shapes that are lights, an index into `lights`.
  Array<std::uint32_t> primitive_lights;
  Array<LightRecord> lights;
  Array<LightNode> light_nodes;        ///< empty where lights are chosen by power alone
  Array<std::uint32_t> light_leaves;   ///< by light, its leaf among the nodes, or kNone
  Array<AroundLight> lights_around;    ///< chosen beside the tree, which is the last
  std::uint32_t bsdf_kinds = 0;        ///< bit k: a material of BsdfKind k was made; it may be behind another one
  std::uint32_t material_choices = 0;  ///< the most that stand one behind the other before a model
  std::uint32_t texture_kinds = 0;     ///< bit k: TextureKind k occurs
  bool needs_uv = false;               ///< some model looks at texture coordinates or tangents
  std::uint32_t environment = kNone;   ///< index of the light that rays to nowhere see
  float center[3] = {};                ///< of a sphere around all surfaces
  float radius = 0;
  CameraRecord camera{};
  Array<CameraRecord> batch;  ///< the cameras that a batch joins side by side
  Array<float> meter;         ///< pieces of surface that meters look at or stand on: meter_tables.h
  FilmSettings film;
  Array<float> filter;
  SamplerSettings sampler;
  IntegratorSettings integrator;

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangle_vertices.size() / 3); }
  /// The light that a primitive is part of, or kNone.
  std::uint32_t light_of(std::uint32_t primitive) const {
    const ShapeRecord& shape = shapes[surfaces[primitive].shape];
    return shape.lights == kNone ? kNone : primitive_lights[shape.lights + (primitive - shape.first_primitive)];
  }
  std::uint32_t sphere_count() const {
    return std::min(first_analytic, static_cast<std::uint32_t>(surfaces.size())) - triangle_count();
  }
  std::uint32_t analytic_count() const {
    return static_cast<std::uint32_t>(surfaces.size()) - sphere_count() - triangle_count();
  }
};

}  // namespace norrsken
