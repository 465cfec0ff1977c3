// Bump and normal maps: the shading frame that they make of a surface's, and what becomes of light from directions that
// the surface and its map do not agree about.
//
// Source: flipping: Schuessler, Heitz, Hanika, Dachsbacher, "Microfacet-based Normal Mapping for Robust Monte Carlo Path
// Tracing", ACM TOG 36(6), 2017, section 1. Shadowing: Conty Estevez, Lecocq, Stein, "A Microfacet-Based Shadowing Function
// to Solve the Bump Terminator Problem", Ray Tracing Gems, 2019, chapter 12, equations 2 and 3.
#pragma once

#include "bsdf/bumpmap.h"
#include "bsdf/normalmap.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

/// What is left of a surface's own frame once a map has replaced it.
struct Perturbation {
  bool any = false;  ///< in one of the lanes; otherwise there is nothing else to know
  Mask lanes;
  Vec3f normal;  ///< the shading normal without the map, on the side that the ray came from
  Float alpha2;  ///< squared width of the slopes that would make such normals; 0: no shadowing

  /// Factor on the light from `direction`, whose cosine with the new normal is `cos_perturbed`: none where the two
  /// normals see it from different sides.
  NORRSKEN_INLINE Float weight(const Vec3f& direction, Float cos_perturbed) const {
    const Float cos_theta = dot(direction, normal);
    const Float cos2 = cos_theta * cos_theta;
    const Float tan2 = max(Float(1.0f) - cos2, Float(0.0f)) / cos2;
    const Float shadowing = Float(2.0f) / (Float(1.0f) + sqrt(fma(alpha2, tan2, Float(1.0f))));
    return select(lanes, zero_unless(cos_theta * cos_perturbed > Float(0.0f), shadowing), Float(1.0f));
  }
};

struct PerturbedFrame {
  Frame frame;
  Perturbation map;
};

/// For lanes with a map. Not inlined: few scenes have one, and every BSDF would repeat it.
__attribute__((noinline)) inline PerturbedFrame perturbed_frame(const SceneView& scene, UInt bump, Vec3f direction,
                                                                SurfacePoint surface, Mask lanes) {
  // The frame is mirrored in the surface where it is seen from the back: see make_surface_point.
  const Frame& seen = surface.frame;
  const Float side = copysign(Float(1.0f), dot(cross(seen.s, seen.t), seen.n));
  const Unperturbed outside{{seen.s, seen.t, seen.n * side}, surface.normal * side, surface.dp_du, surface.dp_dv};
  const ParameterReader parameters{scene, bump & UInt(kMaterialOffsetMask), surface.texture, lanes};
  Vec3f n{Float(0.0f), Float(0.0f), Float(1.0f)};
#define NORRSKEN_BSDF_PERTURBING(kind, Adapter)                                                                \
  if (scene.bsdf_kinds & (1u << static_cast<std::uint32_t>(BsdfKind::kind))) {                                 \
    const Mask of_kind = lanes & ((bump & UInt(kMaterialKindMask)) == UInt(make_material(BsdfKind::kind, 0))); \
    if (any(of_kind))                                                                                          \
      n = select(of_kind, Adapter::normal({scene, parameters.offset, surface.texture, of_kind}, outside), n);  \
  }
#include "bsdf/resolved.def"
#undef NORRSKEN_BSDF_PERTURBING

  const UInt flags = bits(parameters.number(1));
  const Vec3f wo = outside.frame.to_local(-direction);
  const Mask flip = ((flags & UInt(kPerturbFlips)) != UInt(0u)) & (wo.z * dot(wo, n) <= Float(0.0f));
  n = {select(flip, -n.x, n.x), select(flip, -n.y, n.y), n.z};
  const Float inv_length = Float(1.0f) / sqrt(dot(n, n));
  const Mask usable = inv_length < Float(kInfinity);  // also false for what is no number
  n = select(usable, n * inv_length, Vec3f{Float(0.0f), Float(0.0f), Float(1.0f)});

  Perturbation map{true, lanes, seen.n, Float(0.0f)};
  const Float tan2 = fma(n.x, n.x, n.y * n.y) / (n.z * n.z);
  map.alpha2 = zero_unless((flags & UInt(kPerturbShadows)) != UInt(0u), min(Float(0.125f) * tan2, Float(1.0f)));
  const Vec3f world = outside.frame.to_world(n);
  Frame frame = frame_along(world, seen.s);
  frame.n = frame.n * side;
  return {{select(lanes, frame.s, seen.s), select(lanes, frame.t, seen.t), select(lanes, frame.n, seen.n)}, map};
}

/// Gives the surface the frame of the map that its hit has, if any.
template <class Scene>
NORRSKEN_INLINE Perturbation perturb_frame(const Scene& scene, const Hit& hit, SurfacePoint& surface, Mask active) {
  if (scene.any_resolved) {
    const Mask lanes = active & (hit.bump != UInt(0u));
    if (any(lanes)) {
      const PerturbedFrame perturbed =
          perturbed_frame(scene, hit.bump, copied(hit.ray.direction), copied(surface), lanes);
      surface.frame = perturbed.frame;
      return perturbed.map;
    }
  }
  Perturbation none;
  return none;
}

}  // namespace norrsken::NORRSKEN_ISA
