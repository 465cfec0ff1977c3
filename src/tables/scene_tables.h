// The scene as plain arrays: all that kernels may read. Filled by src/compile, never changed while rendering.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace norrsken {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Scattering models as kernels tell them apart. Order and names come from src/bsdf/list.def; `absorb` (no scattering
/// at all, also the back of a one-sided surface) is always 0.
enum class BsdfKind : std::uint8_t {
  absorb,
#define NORRSKEN_BSDF(kind, Model) kind,
#include "bsdf/list.def"
#undef NORRSKEN_BSDF
  count
};

/// A BSDF in one word: bit 31 says that the surface also emits on this side, bits 24 to 30 hold the kind, the rest the
/// offset of its first float in `bsdf_parameters`.
using MaterialWord = std::uint32_t;
inline constexpr MaterialWord kEmitsBit = 0x80000000u;
inline constexpr MaterialWord kMaterialKindMask = 0x7f000000u;
inline constexpr MaterialWord kMaterialOffsetMask = 0x00ffffffu;
constexpr MaterialWord make_material(BsdfKind kind, std::uint32_t offset) {
  return (static_cast<std::uint32_t>(kind) << 24) | offset;
}
constexpr BsdfKind material_kind(MaterialWord word) { return static_cast<BsdfKind>((word & kMaterialKindMask) >> 24); }

/// One per primitive, in order: all triangles, then all spheres. 32 bytes, gathered field by field.
struct SurfaceRecord {
  float geometry[4];            ///< triangle: unit geometric normal n and n.p; sphere: centre and radius
  MaterialWord material_front;  ///< for rays that come from the side the normal points to; with kEmitsBit on lights
  MaterialWord material_back;
  std::uint32_t light;  ///< index into `lights` of the light this is part of, or kNone
  std::uint32_t shape;  ///< index into `shapes`
};

struct ShapeRecord {
  std::uint32_t first_primitive = 0;
  std::uint32_t primitive_count = 0;
  std::uint32_t smooth = 0;        ///< 1: the triangles' vertices have shading normals
  std::uint32_t flip_normals = 0;  ///< 1 (spheres): the normal points to the centre
};

/// What next-event estimation chooses among. An area light is one record per triangle, parallelogram or sphere.
enum class LightKind : std::uint32_t {
#define NORRSKEN_LIGHT(kind, Model, is_delta) kind,
#include "light/list.def"
#undef NORRSKEN_LIGHT
  count
};

/// 20 floats: gathered when there are several lights, broadcast when there is one.
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
  float emission[3];  ///< radiance (area lights) or radiant intensity (point), linear sRGB
};

/// A pinhole: film position (px, py) in pixels looks along normalize(base + px * du + py * dv), world space.
struct CameraRecord {
  float origin[3];
  float base[3];
  float du[3];
  float dv[3];
  float forward[3];  ///< unit; near and far are distances along it
  float near_clip, far_clip;
};

enum class SamplerKind : std::uint32_t { independent, sobol };
enum class FilterKind : std::uint32_t { box };

struct FilmSettings {
  int width = 0, height = 0;
  FilterKind filter = FilterKind::box;
};

struct SamplerSettings {
  SamplerKind kind = SamplerKind::sobol;
  std::int64_t samples_per_pixel = 4;
  std::uint64_t seed = 0;
};

/// All integrators are settings of one loop.
struct IntegratorSettings {
  std::string name = "path";
  int max_depth = -1;           ///< as in Mitsuba: 1 emitters only, 2 direct light, -1 unbounded
  int rr_depth = 5;             ///< depth from which Russian roulette ends paths
  int emitter_samples = 1;      ///< shadow rays per hit
  bool diffuse_bounces = true;  ///< false (whitted): only delta scattering is followed, light sampling alone
  bool hide_emitters = false;
};

/// The arrays. Triangle i has corners positions[3 * triangle_vertices[3 * i + k] ...].
struct SceneTables {
  std::vector<float> positions;                  ///< 3 per vertex, world space
  std::vector<float> normals;                    ///< 3 per vertex or empty if no shape is smooth
  std::vector<float> texcoords;                  ///< 2 per vertex or empty
  std::vector<std::uint32_t> triangle_vertices;  ///< 3 per triangle
  std::vector<SurfaceRecord> surfaces;           ///< triangles, then spheres
  std::vector<ShapeRecord> shapes;
  std::vector<float> bsdf_parameters;
  std::vector<LightRecord> lights;
  CameraRecord camera{};
  FilmSettings film;
  SamplerSettings sampler;
  IntegratorSettings integrator;

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangle_vertices.size() / 3); }
  std::uint32_t sphere_count() const { return static_cast<std::uint32_t>(surfaces.size()) - triangle_count(); }
};

}  // namespace norrsken
