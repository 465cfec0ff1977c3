// A ray against a block of triangles, without a gap between neighbours.
// Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. The ray is sheared onto an axis;
// which side of an edge it passes is then the sign of a difference of two products, the same two for either triangle at
// the edge, and rounded alike as nothing fuses one of them with the difference. A ray through an edge or a corner meets
// all that are there.
// Departures: what is weighted are differences of the corners' distances, by weights that are divided by their sum first:
// coordinates may be as large or as small as their squares can be, and a triangle that the ray meets squarely is met where
// it is. No second try in double precision, since zeros count as inside.
#pragma once

#include "accel/bvh/ray_state.h"

namespace norrsken::NORRSKEN_ISA {

struct BlockCrossing {
  Octet t;
  Octet determinant;      ///< by its sign and that of shear[2] the side is told
  std::uint32_t crossed;  ///< bit i: triangle i, for a t of any sign
};

/// `t` is only computed if any is crossed.
NORRSKEN_INLINE BlockCrossing cross_block(const TriangleBlock& block, const RayState& r) {
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
    c.t = (z[0] + v * inverse * (z[1] - z[0]) + w * inverse * (z[2] - z[0])) * Octet(r.shear[2]);
  }
  return c;
}

}  // namespace norrsken::NORRSKEN_ISA
