// A ray and the surface in one voxel of a grid of signed distances, in double precision.
//
// Source      Hansson-Söderlund, Evans, Akenine-Möller, "Ray Tracing of Signed Distance Function Grids", JCGT 11(3), 2022:
//             along a ray the trilinear interpolation is a cubic polynomial, whose first root in the voxel is sought.
//             Roots: Marmitt, Kleer, Wald, Friedrich, Slusallek, "Fast and Accurate Ray-Voxel Intersection Techniques for
//             Iso-Surface Ray Tracing", VMV 2004: the extrema split the interval, a change of sign brackets each root.
//             Boxes: Hansson-Söderlund, Akenine-Möller, "Tight Bounding Boxes for Voxels and Bricks in a Signed Distance
//             Field Ray Tracer", EGSR 2023.
// Departures  The polynomial is in Bernstein form, from its polar form (Ramshaw, "Blossoming: A Connect-the-Dots Approach
//             to Splines", 1987): its ends are the interpolation on the voxel's faces, computed alike, bit by bit, in the
//             two voxels that share a face, so that no ray slips through between them; and values of one sign have no
//             root, because the polynomial lies between its coefficients.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

namespace norrsken {

struct Voxel {
  glm::dvec3 lower;              ///< corner; the upper one is 1 further along each axis
  std::array<double, 8> values;  ///< at the corners: bit 0 of the number is x, bit 1 is y, bit 2 is z
};

/// Inside and outside are told apart everywhere in this one way.
inline bool is_inside(double value) { return value < 0; }

struct Box {
  glm::dvec3 lower, upper;
};
/// Around the surface in a voxel that it crosses.
Box surface_box(const Voxel& voxel);

struct VoxelHit {
  float t;
  glm::dvec3 gradient;  ///< of the interpolation there
};
/// The first crossing within (0, t_max), as floats tell them apart.
std::optional<VoxelHit> cross_voxel(const Voxel& voxel, const glm::dvec3& origin, const glm::dvec3& direction,
                                    float t_max);

}  // namespace norrsken
