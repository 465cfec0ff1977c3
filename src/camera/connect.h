// The other way round: where on the film a point of the scene is seen, and how strongly. Camera models give
//
//   static CameraConnection connect(const CameraRecord&, const Vec3f& point, Vec2f lens);
//
// Measure: what a surface of area dA that faces the camera covers of the film, dpx dpy / dA.
// Source:  Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 4.5: importance; here per
//          pixel of the film, over which it is constant.
#pragma once

#include "camera/camera.h"

namespace norrsken::NORRSKEN_ISA {

struct CameraConnection {
  Vec3f target;   ///< on the near plane: there the camera begins to see, along the line to the point
  Vec2f film;     ///< in pixels from the top left corner of the whole film; may lie beyond its edges
  Float density;  ///< pixels of film per unit of area at the point, perpendicular to the line
  Mask valid;     ///< the point lies between the near and the far plane
};

NORRSKEN_INLINE Mask between_clip_planes(const CameraRecord& camera, Float depth) {
  return (depth > Float(camera.near_clip)) & (depth <= Float(camera.far_clip));
}

/// Through the point `eye` from `origin`, where film_point is in a plane perpendicular to the axis. In that plane, f
/// ahead, a pixel is a rectangle of du dv; seen under an angle theta its solid angle is du dv cos^3(theta) / f^2.
NORRSKEN_INLINE CameraConnection connect_through(const CameraRecord& camera, const Vec3f& eye, const Vec3f& point) {
  const Vec3f du = broadcast(camera.du), dv = broadcast(camera.dv), base = broadcast(camera.base);
  const Vec3f forward = broadcast(camera.forward), begin = broadcast(camera.origin) + eye;
  const Float du2 = dot(du, du), dv2 = dot(dv, dv), focus = dot(base, forward);
  const Vec3f from_eye = point - begin;
  const Float depth = dot(from_eye, forward);
  const Vec3f on_film = fma(from_eye, focus / depth, eye) - base;
  // focus^2 / (du dv cos^3 distance^2), with cos = depth / distance
  const Float distance = sqrt(dot(from_eye, from_eye));
  const Float density = focus * focus * distance / (sqrt(du2 * dv2) * depth * depth * depth);
  return {fma(from_eye, Float(camera.near_clip) / depth, begin),
          {dot(on_film, du) / du2, dot(on_film, dv) / dv2},
          density,
          between_clip_planes(camera, depth)};
}

}  // namespace norrsken::NORRSKEN_ISA
