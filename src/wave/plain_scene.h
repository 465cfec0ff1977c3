// Scenes of nothing but flat triangles and spheres, without textures, tangents, maps or instances.
//
// What a scene may have costs a scene that does not have it: values that only some branch needs take registers all the
// same. `shade_surface` is compiled for a `PlainScene` too, without those branches, and computes the same bits.
#pragma once

#include "simd/isa_namespace.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// Its constants hide the scene's own fields.
struct PlainScene : SceneView {
  // NOLINTBEGIN(readability-identifier-naming): the names of what they hide
  static constexpr std::uint32_t instance_count = 0, first_analytic = kNone, texture_kinds = 0;
  static constexpr bool any_smooth = false, any_resolved = false, needs_uv = false, volumetric = false;
  // NOLINTEND(readability-identifier-naming)

  /// Of a scene that `is_plain`.
  explicit PlainScene(const SceneView& scene) : SceneView(scene) {}

  static bool is_plain(const SceneView& scene) {
    return scene.instance_count == instance_count && scene.first_analytic == first_analytic &&
           scene.texture_kinds == texture_kinds && scene.any_smooth == any_smooth &&
           scene.any_resolved == any_resolved && scene.needs_uv == needs_uv && scene.volumetric == volumetric;
  }
};

/// For whom the side of a triangle's shading normal is all that matters.
struct NormalsAlone : SceneView {
  static constexpr bool needs_uv = false;  // NOLINT(readability-identifier-naming): the name of what it hides

  explicit NormalsAlone(const SceneView& scene) : SceneView(scene) {}
};

}  // namespace norrsken::NORRSKEN_ISA
