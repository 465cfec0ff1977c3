// A ray against a block of triangles, without a gap between neighbours.
// Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. The ray is sheared onto an axis;
// which side of an edge it passes is then the sign of a difference of two products, the same two for either triangle at
// the edge, and rounded alike as nothing fuses one of them with the difference. A ray through an edge or a corner meets
// all that are there.
// Departures: what is weighted are differences of the corners' distances, by weights that are divided by their sum first:
// coordinates may be as large or as small as their squares can be, and a triangle that the ray meets squarely is met where
// it is. Where those distances are too far apart for that, as those of a ground plane's corners are, the ray meets the
// triangle's plane in double precision instead. No second try whether it is inside, since zeros count as that.
#pragma once

#include "accel/bvh/ray_state.h"

namespace norrsken::NORRSKEN_ISA {

struct BlockCrossing {
  Octet t;
  Octet determinant;      ///< by its sign and that of shear[2] the side is told
  std::uint32_t crossed;  ///< bit i: triangle i, for a t of any sign
};

/// How many times the distance a corner may be away. What is interpolated rounds relative to that, which does not matter
/// within RayState::reach.
inline constexpr float kMostReach = 8.0f;

/// The distance along a ray to a triangle's plane.
__attribute__((noinline)) inline float distance_to_plane(const TriangleBlock& block, std::uint32_t triangle,
                                                         const RaySpan& rays, std::uint32_t ray) {
  double to_corner[3], edge[2][3], direction[3];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto corner = [&](std::uint32_t k) { return double{block.corners[axis][k][triangle]}; };
    to_corner[axis] = corner(0) - double{rays.origin[axis][ray]};
    edge[0][axis] = corner(1) - corner(0), edge[1][axis] = corner(2) - corner(0);
    direction[axis] = double{rays.direction[axis][ray]};
  }
  double along_normal = 0, speed = 0;
  for (std::uint32_t x = 0; x < 3; ++x) {
    const std::uint32_t y = (x + 1) % 3, z = (x + 2) % 3;
    const double normal = edge[0][y] * edge[1][z] - edge[0][z] * edge[1][y];
    along_normal += normal * to_corner[x];
    speed += normal * direction[x];
  }
  return static_cast<float>(along_normal / speed);
}

/// `t` is only computed if any is crossed.
NORRSKEN_INLINE BlockCrossing cross_block(const TriangleBlock& block, const RaySpan& rays, const RayState& r) {
  const float* corners = &block.corners[0][0][0];
  const float *xs = corners + r.corners[0], *ys = corners + r.corners[1], *zs = corners + r.corners[2];
  const Octet ox(r.sheared_origin[0]), oy(r.sheared_origin[1]), oz(r.sheared_origin[2]);
  const Octet shear_x(r.shear[0]), shear_y(r.shear[1]);
  Octet x[3], y[3], z[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    z[k] = load_octet(zs + k * kBvhWidth) - oz;
    x[k] = (load_octet(xs + k * kBvhWidth) - ox) - shear_x * z[k];
    y[k] = (load_octet(ys + k * kBvhWidth) - oy) - shear_y * z[k];
  }
  const Octet u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2], w = x[1] * y[0] - y[1] * x[0];
  const Octet determinant = u + v + w, zero(0.0f);
  const OctetMask inside = (zero <= min(min(u, v), w)) | (max(max(u, v), w) <= zero);
  BlockCrossing c;
  c.determinant = determinant;
  c.crossed = to_bits(inside & (determinant != zero));
  if (c.crossed != 0) {
    const Octet inverse = Octet(1.0f) / determinant;
    const Octet distance = z[0] + v * inverse * (z[1] - z[0]) + w * inverse * (z[2] - z[0]);
    c.t = distance * Octet(r.shear[2]);
    const Octet highest = max(max(z[0], z[1]), z[2]), lowest = min(min(z[0], z[1]), z[2]);
    const OctetMask is_near = max(size(distance) * Octet(kMostReach), Octet(r.reach)) < max(highest, zero - lowest);
    std::uint32_t spread_out = c.crossed & to_bits(is_near);
    if (spread_out != 0) {
      alignas(32) float t[kBvhWidth];
      store_octet(t, c.t);
      for (; spread_out != 0; spread_out &= spread_out - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(spread_out));
        t[i] = distance_to_plane(block, i, rays, r.ray);
      }
      c.t = load_octet(t);
    }
  }
  return c;
}

}  // namespace norrsken::NORRSKEN_ISA
