// How much memory Embree's acceleration structure takes.
#pragma once

#include <cstdint>

#include "tables/scene_tables.h"

namespace norrsken {

/// An estimate, within a factor of two for scenes of many primitives: its copy of the vertices, and per primitive its
/// share of the structure, as measured on meshes from ten thousand triangles up.
inline std::uint64_t embree_bytes(const SceneTables& scene) {
  constexpr std::uint64_t kPerPrimitive = 128, kPerInstance = 768;
  return scene.positions.size() * sizeof(float) + kPerPrimitive * scene.surfaces.size() +
         kPerInstance * scene.instances.size();
}

}  // namespace norrsken
