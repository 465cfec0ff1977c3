// What decides about the bits of a sample, by name: two renderings whose traits are equal may be added up.
#pragma once

#include <string>
#include <vector>

#include "compile/compile.h"
#include "tables/wave_types.h"

namespace norrsken {

struct Trait {
  std::string name;   ///< "seed", "textures"
  std::string value;  ///< "7", or a fingerprint
  bool is_fingerprint = false;

  friend bool operator==(const Trait&, const Trait&) = default;
};
using Traits = std::vector<Trait>;

/// Of a scene as it is rendered: tables with all meshes and textures, settings, instruction set, and this program.
/// Neither the number of samples nor that of threads.
Traits traits_of(const SceneTables& tables, const SceneFrame& frame, const SceneView& view, const FilmSettings& film,
                 const SceneLayers& layers, const std::string& isa, const std::string& accelerator);

/// "seed is 7, not 8; other textures", or nothing if all are equal: how `found` is not `expected`.
std::string difference(const Traits& found, const Traits& expected);

}  // namespace norrsken
