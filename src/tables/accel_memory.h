// How much memory an acceleration structure takes.
#pragma once

#include <cstdint>

#include "tables/scene_tables.h"

namespace norrsken {

/// An estimate of the most that it takes, which is while it is built. The hierarchy (src/accel/bvh): a binary tree beside the
/// wide one, of which less than half is left when it is built. Embree, for scenes with groups or with other shapes than
/// triangles and spheres: its copy of the vertices, and for each primitive its share, of which two thirds are left. Both as measured on a
/// mesh of a million triangles.
inline std::uint64_t acceleration_bytes(const SceneTables& scene) {
  constexpr std::uint64_t kPerTriangle = 148, kPerPrimitive = 100, kPerInstance = 768;
  if (scene.analytics.empty() && scene.group_count == 0) return kPerTriangle * scene.triangle_count();
  return scene.positions.size() * sizeof(float) + kPerPrimitive * scene.surfaces.size() +
         kPerInstance * scene.instances.size();
}

}  // namespace norrsken
