// Bump and normal maps: the shading frame that they make of a surface's, and what becomes of light from directions that
// the surface and its maps do not agree about. Maps may stand inside each other; each works on the frame that the one
// around it has made.
//
// Source: flipping: Schuessler, Heitz, Hanika, Dachsbacher, "Microfacet-based Normal Mapping for Robust Monte Carlo Path
// Tracing", ACM TOG 36(6), 2017, section 1. Shadowing: Conty Estevez, Lecocq, Stein, "A Microfacet-Based Shadowing Function
// to Solve the Bump Terminator Problem", Ray Tracing Gems, 2019, chapter 12, equations 2 and 3.
#pragma once

#include "bsdf/bumpmap.h"
#include "bsdf/normalmap.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

/// What one map leaves of the frame around it.
struct MapLevel {
  Mask lanes;    ///< that have it
  Vec3f normal;  ///< of the frame around it
  Float turn;    ///< -1 where a `twosided` between that frame and this map has turned the normal
  Float alpha2;  ///< squared width of the slopes that would make such normals; 0: no shadowing
};

/// What is left of a surface's own frame once maps have replaced it.
struct Perturbation {
  std::uint32_t count = 0;  ///< maps inside each other, at most, in one of the lanes; 0: there is nothing else to know
  MapLevel levels[kMostMaps];
  Float turn;  ///< -1 where the model's normal is not that of the innermost map, but turned to the viewer

  /// Factor on the light from `direction`, whose cosine with the model's normal is `cos_perturbed`: none where two
  /// normals that follow each other see it from different sides.
  NORRSKEN_INLINE Float weight(const Vec3f& direction, Float cos_perturbed) const {
    Float product(1.0f), cos_inside = cos_perturbed * turn;
    for (std::uint32_t k = count; k-- > 0;) {
      const MapLevel& level = levels[k];
      const Float cos_theta = dot(direction, level.normal);
      const Float cos2 = cos_theta * cos_theta;
      const Float tan2 = max(1.0f - cos2, 0.0f) / cos2;
      const Float shadowing = 2.0f / (1.0f + sqrt(fma(level.alpha2, tan2, 1.0f)));
      const Float weight = zero_unless(cos_theta * cos_inside > 0.0f, shadowing);
      product = select(level.lanes, product * weight, product);
      cos_inside = select(level.lanes, cos_theta * level.turn, cos_inside);
    }
    return product;
  }
};

/// A frame between maps.
struct MappedFrame {
  Frame surface;  ///< around the normal as the surface and the maps so far have it, outwards
  Frame seen;     ///< the same as directions see it: mirrored by every `twosided` so far that is seen from the back

  /// Where the ray comes from the back of it.
  NORRSKEN_INLINE Mask from_back(const Vec3f& direction) const { return dot(direction, seen.n) > 0.0f; }
};

/// Around all maps. From the back the point's frame is mirrored in the surface: see make_surface_point.
NORRSKEN_INLINE MappedFrame unmapped_frame(const SurfacePoint& s) {
  const Frame outside{s.frame.s, s.frame.t, s.frame.n * s.side};
  return {outside, outside};
}

struct EnteredMap {
  MappedFrame inside;
  MapLevel level;
};

/// What is inside of the map `word`, for lanes with one. Not inlined: few scenes have one, and every BSDF would repeat it.
__attribute__((noinline)) inline EnteredMap enter_map(const SceneView& scene, UInt word, Vec3f direction,
                                                      SurfacePoint point, MappedFrame around, Mask lanes) {
  const ParameterReader parameters{scene, word & UInt(kMaterialOffsetMask), point.texture, lanes};
  const UInt flags = parameters.get(&PerturbedSlots::flags);
  // A map for the front that is seen from the back stands in a `twosided`, which mirrors directions in the surface there.
  const Mask made_for_back = (flags & kPerturbBack) != 0u;
  const Mask mirrored = lanes & (around.from_back(direction) ^ made_for_back);
  const Float turn = select(mirrored, Float(-1.0f), Float(1.0f));
  Frame& seen = around.seen;
  seen.n = seen.n * turn;

  const Unperturbed outside{around.surface, point.normal, point.dp_du, point.dp_dv};
  Vec3f n{0.0f, 0.0f, 1.0f};
#define NORRSKEN_BSDF_PERTURBING(kind, Adapter)                                                             \
  if (scene.bsdf_kinds & (1u << static_cast<std::uint32_t>(BsdfKind::kind))) {                              \
    const Mask of_kind = lanes & ((word & kMaterialKindMask) == UInt(make_material(BsdfKind::kind, 0)));    \
    if (any(of_kind))                                                                                       \
      n = select(of_kind, Adapter::normal({scene, parameters.offset, point.texture, of_kind}, outside), n); \
  }
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_PERTURBING

  const Vec3f wo = seen.to_local(-direction);
  const Mask flip = ((flags & kPerturbFlips) != 0u) & (wo.z * dot(wo, n) <= 0.0f);
  n = {select(flip, -n.x, n.x), select(flip, -n.y, n.y), n.z};
  const Float inv_length = 1.0f / sqrt(dot(n, n));
  const Mask usable = inv_length < kInfinity;  // also false for what is no number
  n = select(usable, n * inv_length, Vec3f{0.0f, 0.0f, 1.0f});
  const Float tan2 = fma(n.x, n.x, n.y * n.y) / (n.z * n.z);
  const Mask shadows = (flags & kPerturbShadows) != 0u;
  const MapLevel level{lanes, seen.n, turn, zero_unless(shadows, min(0.125f * tan2, 1.0f))};

  const Frame turned = frame_along(n, {1.0f, 0.0f, 0.0f});
  const auto within = [&](const Frame& f) {
    return Frame{select(lanes, f.to_world(turned.s), f.s), select(lanes, f.to_world(turned.t), f.t),
                 select(lanes, f.to_world(turned.n), f.n)};
  };
  return {{within(around.surface), within(seen)}, level};
}

struct PerturbedFrame {
  Frame frame;
  Perturbation map;
};

/// Behind all maps of a hit, for lanes with one.
__attribute__((noinline)) inline PerturbedFrame perturbed_frame(const SceneView& scene, Hit hit, SurfacePoint point,
                                                                Mask active) {
  PerturbedFrame p;
  MappedFrame frame = unmapped_frame(point);
  for (std::uint32_t k = 0; k < kMostMaps; ++k) {
    const Mask lanes = active & (hit.maps[k] != 0u);
    if (none(lanes)) break;
    const EnteredMap entered = enter_map(scene, hit.maps[k], hit.ray.direction, point, frame, lanes);
    frame = entered.inside;
    p.map.levels[k] = entered.level;
    p.map.count = k + 1;
  }
  p.map.turn = select(frame.from_back(hit.ray.direction), Float(-1.0f), Float(1.0f));
  p.frame = {frame.seen.s, frame.seen.t, frame.seen.n * p.map.turn};
  return p;
}

/// Gives the surface the frame of the maps that its hit has, if any.
template <class Scene>
NORRSKEN_INLINE Perturbation perturb_frame(const Scene& scene, const Hit& hit, SurfacePoint& surface, Mask active) {
  if (scene.any_resolved) {
    const Mask lanes = active & (hit.maps[0] != 0u);
    if (any(lanes)) {
      const PerturbedFrame perturbed = perturbed_frame(scene, hit, copied(surface), active);
      surface.frame = {select(lanes, perturbed.frame.s, surface.frame.s),
                       select(lanes, perturbed.frame.t, surface.frame.t),
                       select(lanes, perturbed.frame.n, surface.frame.n)};
      return perturbed.map;
    }
  }
  return {};
}

}  // namespace norrsken::NORRSKEN_ISA
