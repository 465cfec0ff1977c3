// From a hit to the surface there: position, normals, and the offset that keeps spawned rays off it.
#pragma once

#include "accel/intersect.h"
#include "math/frame.h"
#include "shape/sphere.h"
#include "texture/parameter_reader.h"
#include "wave/placed_surface.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

/// A surface point as shading sees it.
struct SurfacePoint {
  Vec3f position;
  Vec3f normal;  ///< geometric, as the shape has it: it may point away from the ray
  Frame frame;   ///< around the shading normal, turned to the side that the ray came from
  Float side;    ///< -1 where the shading normal had to be turned, otherwise 1
  Float offset;  ///< bound of how far rounding may have moved the position off the surface, with reserve
  /// Only if the scene `needs_uv`: where textures look, and how the position moves with u and v.
  TexturePoint texture;
  Vec3f dp_du, dp_dv;
};
NORRSKEN_INLINE SurfacePoint copied(const SurfacePoint& s) {
  return {copied(s.position),
          copied(s.normal),
          {copied(s.frame.s), copied(s.frame.t), copied(s.frame.n)},
          s.side,
          s.offset,
          copied(s.texture),
          copied(s.dp_du),
          copied(s.dp_dv)};
}

/// a < n, for numbers below 2^31.
NORRSKEN_INLINE Mask below(UInt a, std::uint32_t n) { return shift_right<31>(a - UInt(n)) != 0u; }

/// Where the primitives of a primitive's shape begin among those that are lights, or kNone.
NORRSKEN_INLINE UInt lights_of_shape(const SceneView& scene, UInt shape, Mask active) {
  return gather(scene.shapes, &ShapeRecord::lights, shape, active);
}

NORRSKEN_INLINE UInt shape_of(const SceneView& scene, UInt primitive, Mask active) {
  return gather(scene.surfaces, &SurfaceRecord::shape, primitive, active);
}

/// Whether the primitive is part of a light, on whichever side.
NORRSKEN_INLINE Mask is_emitter(const SceneView& scene, UInt primitive, Mask active) {
  return lights_of_shape(scene, shape_of(scene, primitive, active), active) != kNone;
}

/// The light that a primitive is part of, for lanes with one.
NORRSKEN_INLINE UInt light_of(const SceneView& scene, UInt primitive, Mask active) {
  const UInt shape = shape_of(scene, primitive, active);
  const UInt first = gather(scene.shapes, &ShapeRecord::first_primitive, shape, active);
  return gather(scene.primitive_lights, lights_of_shape(scene, shape, active) + (primitive - first), active);
}

/// Three numbers at each of three places. Component by component: so that what a processor has under way at a time asks
/// for the memory of all three places.
NORRSKEN_INLINE void gather_corners(const float* base, const UInt (&places)[3], Mask active, Vec3f (&corners)[3]) {
  for (int k = 0; k < 3; ++k) corners[k].x = gather(base, places[k], active);
  for (int k = 0; k < 3; ++k) corners[k].y = gather(base + 1, places[k], active);
  for (int k = 0; k < 3; ++k) corners[k].z = gather(base + 2, places[k], active);
}

/// A point of a triangle: its corners, and its barycentric coordinates recomputed from the position.
struct TrianglePoint {
  UInt vertices[3];
  Vec3f e1, e2;
  Vec2f barycentric;  ///< weights of the second and third corner

  NORRSKEN_INLINE Vec3f interpolate(const Vec3f v[3]) const {
    return fma(v[1], barycentric.x, fma(v[2], barycentric.y, v[0] * (1.0f - barycentric.x - barycentric.y)));
  }
};

inline TrianglePoint make_triangle_point(const SceneView& scene, UInt primitive, Vec3f p, Mask active) {
  const UInt first = primitive * 3u;
  TrianglePoint t;
  for (int k = 0; k < 3; ++k) t.vertices[k] = gather(scene.triangle_vertices + k, first, active);
  Vec3f corners[3];
  gather_corners(scene.positions, {t.vertices[0] * 3u, t.vertices[1] * 3u, t.vertices[2] * 3u}, active, corners);
  t.e1 = corners[1] - corners[0], t.e2 = corners[2] - corners[0];
  const Vec3f q = p - corners[0];
  const Float a11 = dot(t.e1, t.e1), a12 = dot(t.e1, t.e2), a22 = dot(t.e2, t.e2), b1 = dot(q, t.e1), b2 = dot(q, t.e2);
  const Float inv = 1.0f / fms(a11, a22, a12 * a12);
  t.barycentric = {fms(a22, b1, a12 * b2) * inv, fms(a11, b2, a12 * b1) * inv};
  return t;
}

inline Vec3f smooth_normal(const SceneView& scene, TrianglePoint t, Mask active) {
  Vec3f normals[3];
  gather_corners(scene.normals, {t.vertices[0] * 3u, t.vertices[1] * 3u, t.vertices[2] * 3u}, active, normals);
  return normalize(t.interpolate(normals));
}

/// Texture coordinates, and how the position moves with them.
struct Parametrization {
  Vec2f uv;
  Vec3f dp_du, dp_dv;
};

NORRSKEN_INLINE void set_parametrization(SurfacePoint& s, const Parametrization& p, Mask m) {
  s.texture.uv = select(m, p.uv, s.texture.uv);
  s.dp_du = select(m, p.dp_du, s.dp_du);
  s.dp_dv = select(m, p.dp_dv, s.dp_dv);
}

/// `shading` and `scale` are those that the point's frame and offset will be made of.
NORRSKEN_INLINE void set_place(SurfacePoint& s, Vec3f& shading, Float& scale, const PlacedSurface& p, Mask m) {
  s.position = select(m, p.position, s.position);
  s.normal = select(m, p.normal, s.normal);
  shading = select(m, p.shading, shading);
  scale = select(m, p.scale, scale);
  set_parametrization(s, {p.uv, p.dp_du, p.dp_dv}, m);
}

/// Of triangles; without coordinates of their own they are the barycentric ones, whose tangents are the edges, and where
/// those that they have are the same everywhere any frame around the normal, both as in Mitsuba.
inline Parametrization parametrize_triangle(const SceneView& scene, TrianglePoint t, Vec3f normal, UInt shape,
                                            Mask active) {
  Vec2f uv = t.barycentric;
  Vec3f dp_du = t.e1, dp_dv = t.e2;
  if (scene.texcoords != nullptr) {
    const Mask mapped = active & (gather(scene.shapes, &ShapeRecord::has_texcoords, shape, active) != 0u);
    Vec2f c[3];
    for (int k = 0; k < 3; ++k) c[k].x = gather(scene.texcoords, t.vertices[k] * 2u, mapped);
    for (int k = 0; k < 3; ++k) c[k].y = gather(scene.texcoords + 1, t.vertices[k] * 2u, mapped);
    const Vec2f d1{c[1].x - c[0].x, c[1].y - c[0].y}, d2{c[2].x - c[0].x, c[2].y - c[0].y};
    uv = select(mapped,
                Vec2f{fma(d1.x, t.barycentric.x, fma(d2.x, t.barycentric.y, c[0].x)),
                      fma(d1.y, t.barycentric.x, fma(d2.y, t.barycentric.y, c[0].y))},
                uv);
    // p = p0 + e1 b1 + e2 b2 and uv = c0 + d1 b1 + d2 b2, solved for the derivatives of p.
    const Float determinant = fms(d1.x, d2.y, d1.y * d2.x);
    const Mask regular = mapped & (determinant != 0.0f);
    const Float inv = 1.0f / determinant;
    const Frame any_frame = make_frame(normal);
    dp_du = select(mapped, select(regular, fma(t.e1, d2.y, t.e2 * -d1.y) * inv, any_frame.s), dp_du);
    dp_dv = select(mapped, select(regular, fma(t.e2, d1.x, t.e1 * -d2.x) * inv, any_frame.t), dp_dv);
  }
  return {uv, dp_du, dp_dv};
}

/// Of spheres.
inline Parametrization parametrize_sphere(const SceneView& scene, Float radius, Vec3f normal, UInt shape, Mask active) {
  const SphereRotation rotation = gather_sphere_rotation(scene, shape, active);
  const Vec3f local = rotation.local(normal);
  // Derivatives of (cos 2 pi u sin pi v, sin 2 pi u sin pi v, cos pi v).
  const Float sin_theta = sqrt(fma(local.x, local.x, local.y * local.y));
  const Mask pole = !(sin_theta > 0.0f);
  const Float inv = 1.0f / sin_theta;
  const Vec2f phi = select(pole, Vec2f{1.0f, 0.0f}, Vec2f{local.x * inv, local.y * inv});
  const Float two_pi_r = radius * Float(2.0f * kPi), pi_r = radius * kPi;
  return {sphere_uv(local), rotation.world({-local.y, local.x, 0.0f}) * two_pi_r,
          rotation.world({local.z * phi.x, local.z * phi.y, -sin_theta}) * pi_r};
}

/// -1 where the sphere's normal points to its centre, otherwise 1.
NORRSKEN_INLINE Float direction_of_sphere_normal(const SceneView& scene, UInt primitive, Mask active) {
  const UInt shape = shape_of(scene, primitive, active);
  const UInt flipped = gather(scene.shapes, &ShapeRecord::flip_normals, shape, active);
  return select(flipped != 0u, Float(-1.0f), Float(1.0f));
}

/// -1 where a ray of this direction comes from the back of a surface with this shading normal, otherwise 1. The shading
/// normal tells, not the geometric one: BSDFs are made of it, and would be black where the viewer is below it.
NORRSKEN_INLINE Float side_told_by(const Vec3f& shading, const Vec3f& direction) {
  return select(dot(shading, direction) > 0.0f, Float(-1.0f), Float(1.0f));
}

/// `Scene`: SceneView or PlainScene.
template <class Scene>
NORRSKEN_INLINE SurfacePoint make_surface_point(const Scene& scene, const Hit& hit, Mask active) {
  const auto [geometry, fourth] = gather(scene.surfaces, &SurfaceRecord::geometry, hit.primitive, active);
  // Everything is computed where the surface's tables are told: in the world, or in the space of an instance.
  Vec3f along = fma(hit.ray.direction, hit.t, hit.ray.origin);
  Mask instanced = Mask::none();
  if (scene.instance_count > 0) {
    instanced = active & (hit.instance != kNone);
    if (any(instanced))
      along = select(
          instanced,
          hit_in_object(scene, copied(hit.ray.origin), copied(hit.ray.direction), hit.t, hit.instance, instanced),
          along);
  }

  // A triangle's record is its plane: move the point onto it.
  SurfacePoint s{};
  s.normal = geometry;
  s.position = fma(geometry, fourth - dot(geometry, along), along);
  Float scale = largest(s.position);
  const Mask triangle = active & below(hit.primitive, scene.triangle_count);
  Mask analytic = Mask::none();
  if (scene.first_analytic != kNone) analytic = active & !below(hit.primitive, scene.first_analytic);
  const Mask sphere = active & !triangle & !analytic;
  if (scene.accel.rounding_extents != nullptr) {
    scale = max(scale, zero_unless(triangle, gather(scene.accel.rounding_extents, hit.primitive, triangle)));
  }
  if (scene.sphere_count > 0) {
    if (any(sphere)) {
      const Vec3f n = normalize(along - geometry);
      s.position = select(sphere, fma(n, fourth, geometry), s.position);
      scale = select(sphere, largest(s.position) + fourth, scale);
      // Which way it points matters to maps, layers and media alone: else a surface looks the same from both sides.
      Float outwards(1.0f);
      if (scene.needs_uv || scene.volumetric) outwards = direction_of_sphere_normal(scene, hit.primitive, sphere);
      s.normal = select(sphere, n * outwards, s.normal);
    }
  }

  Vec3f shading = s.normal;
  if (scene.any_smooth || scene.needs_uv) {
    if (scene.needs_uv) {
      s.texture.shape = shape_of(scene, hit.primitive, active);
      s.texture.primitive = hit.primitive;
    }
    const Float turned_below = gather(scene.surfaces, &SurfaceRecord::turned_below, hit.primitive, triangle);
    const Mask interpolate = triangle & (turned_below >= 0.0f);
    const Mask look = scene.needs_uv ? triangle : interpolate;
    if (any(look)) {
      const TrianglePoint t = make_triangle_point(scene, hit.primitive, copied(s.position), look);
      if (any(interpolate)) shading = select(interpolate, smooth_normal(scene, t, interpolate), shading);
      if (scene.needs_uv) {
        s.texture.barycentric = select(triangle, t.barycentric, s.texture.barycentric);
        set_parametrization(s, parametrize_triangle(scene, t, copied(s.normal), s.texture.shape, triangle), triangle);
      }
    }
    if (scene.needs_uv && any(sphere)) {
      set_parametrization(s, parametrize_sphere(scene, fourth, normalize(along - geometry), s.texture.shape, sphere),
                          sphere);
    }
  }
  if (any(analytic)) {
    const PlacedSurface p = analytic_surface(scene, bits(geometry.x), bits(geometry.y), copied(along), analytic);
    set_place(s, shading, scale, p, analytic);
  }
  if (any(instanced)) {
    const PlacedSurface p = surface_in_world(
        scene, hit.instance,
        {copied(s.position), copied(s.normal), copied(shading), scale, s.texture.uv, copied(s.dp_du), copied(s.dp_dv)},
        instanced);
    set_place(s, shading, scale, p, instanced);
  }
  s.offset = scale * kOffsetUlps;

  s.side = side_told_by(shading, hit.ray.direction);
  if (scene.needs_uv) {
    // Along the first tangent, as anisotropic models and normal maps want it. From the back the frame is mirrored in
    // the surface, not turned: s and t stay.
    s.frame = frame_along(shading, s.dp_du);
    s.frame.n = shading * s.side;
  } else {
    s.frame = make_frame(shading * s.side);
  }
  return s;
}

/// The parameters of the model that a hit's material word names.
template <class Scene>
NORRSKEN_INLINE ParameterReader parameter_reader(const Scene& scene, const Hit& hit, const SurfacePoint& surface,
                                                 Mask active) {
  return {scene, hit.material & kMaterialOffsetMask, surface.texture, active, scene.texture_kinds != 0};
}

/// Where a ray that leaves towards `side` of the surface begins.
NORRSKEN_INLINE Vec3f spawn_origin(const Vec3f& position, const Vec3f& normal, Float offset, Float side) {
  return fma(normal, copysign(offset, side), position);
}

}  // namespace norrsken::NORRSKEN_ISA
