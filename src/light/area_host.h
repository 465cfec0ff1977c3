// A shape's surface cut into the pieces that next-event estimation samples.
#pragma once

#include <vector>

#include "compile/lights.h"

namespace norrsken {

/// A light without its emission, and the shape's primitives (counted from its first) that it covers.
struct AreaLight {
  LightRecord record{};
  std::vector<std::uint32_t> primitives;
  LightBounds bounds{};
  bool sampled = true;  ///< false: only rays find it
};

/// In order of the first primitive of each. Two triangles become one parallelogram if they share an edge, face the same
/// way, and the corners across that edge mirror each other in its middle, to within the rounding of their coordinates.
/// With a `texture` as their radiance, texture coordinates count as corners do. A shape with a formula is one light.
/// `along_normals`: the lights are to know the vertices' normals, so triangles of smooth meshes stay apart.
std::vector<AreaLight> area_lights(Lights& lights, std::uint32_t shape, TextureWord texture,
                                   bool along_normals = false);

/// An error for emitters of lights that only rays find, if paths are to begin at them.
void refuse_as_beginning(const AreaLight& light, const Parameters& emitter, Lights& lights);

}  // namespace norrsken
