// How much memory Embree's acceleration structure takes.
#pragma once

#include <cstdint>

#include "tables/scene_tables.h"

namespace norrsken {

/// An estimate of the most that it takes, which is while it is built: its copy of the vertices, and for each primitive
/// its share, as measured on a mesh of a million triangles. What is left when it is built is two thirds of that.
inline std::uint64_t embree_bytes(const SceneTables& scene) {
  constexpr std::uint64_t kPerPrimitive = 100, kPerInstance = 768;
  return scene.positions.size() * sizeof(float) + kPerPrimitive * scene.surfaces.size() +
         kPerInstance * scene.instances.size();
}

}  // namespace norrsken
