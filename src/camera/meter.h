// What a meter (src/camera/NAME.h, listed in lists/meter.def) gives the kernels, and the points of a surface that it
// looks at or stands on.
//
//   struct Model {
//     static constexpr float kWeight;  // what every ray counts for
//     // `place` and `angle` in the unit square: where on the film, which rays may be chosen by, and another pair
//     static CameraRay sample(const SceneView&, const CameraRecord&, Vec2f place, Vec2f angle, Mask active);
//   };
//
// Nothing connects to a meter: paths that begin at the lights do not find it.
#pragma once

#include "camera/camera.h"
#include "math/affine.h"
#include "math/gather.h"

namespace norrsken::NORRSKEN_ISA {

struct MeterPoint {
  Vec3f position, normal;  ///< unit
  Float scale;             ///< what rounding is relative to
};

/// Uniform over the area of the record's pieces of surface (tables/meter_tables.h).
inline MeterPoint sample_meter_surface(const SceneView& scene, const CameraRecord& camera, Vec2f u, Mask active) {
  const std::uint32_t count = camera.piece_count;
  const float* first = scene.meter + camera.first_piece;
  const auto number = [&](UInt piece, std::uint32_t k) { return gather(first + k, piece * kMeterPieceFloats, active); };
  // The last piece that begins at or before u.y, of a number that is a power of two.
  UInt piece(0u);
  for (std::uint32_t step = count / 2; step != 0; step /= 2) {
    const UInt later = piece + step;
    piece = select(number(later, kMeterBegin) <= u.y, later, piece);
  }
  u.y = min((u.y - number(piece, kMeterBegin)) / number(piece, kMeterShare), 1.0f - 0x1p-24f);

  const UInt kind = gather_uint(first + kMeterKind, piece * kMeterPieceFloats, active);
  const auto is = [&](MeterKind k) { return kind == UInt(static_cast<std::uint32_t>(k)); };
  const Vec2f in_triangle = warp_to_triangle(u), in_disk = warp_to_disk(u);
  const Vec2f flat = select(is(MeterKind::triangle), in_triangle, select(is(MeterKind::disk), in_disk, u));
  const Vec3f on_sphere = warp_to_sphere({u.y, u.x});
  const SinCos phi = sin_cos_turns(u.x);
  const Mask sphere = is(MeterKind::sphere), cylinder = is(MeterKind::cylinder);
  const Vec3f local = select(sphere, on_sphere, select(cylinder, Vec3f{phi.cos, phi.sin, u.y}, {flat.x, flat.y, 0.0f}));
  const Vec3f normal = select(sphere, on_sphere, select(cylinder, Vec3f{phi.cos, phi.sin, 0.0f}, {0.0f, 0.0f, 1.0f}));
  const Affine place = gather_affine(first + kMeterPlace, piece * kMeterPieceFloats, active);
  return {place.point(local), normalize(place.vector(normal)) * number(piece, kMeterSide),
          largest(place.magnitude({1.0f, 1.0f, 1.0f}))};
}

}  // namespace norrsken::NORRSKEN_ISA
