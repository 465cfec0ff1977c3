// What every phase function gives to the stages. Directions are unit, in the world: `wo` points back along the ray, `wi` to
// where light comes from. A phase function is its own density over solid angle, so samples have no weight.
//
// A model is a struct with
//   struct Stored;                             its block of parameters (tables/slots.h), with its kKind
//   struct Parameters;                         what comes of it, in lanes
//   static Parameters load(const PhaseReader&);
//   static Float pdf_sa(const Parameters&, wo, wi);
//   static PhaseSample sample(const Parameters&, wo, Vec2f u);
#pragma once

#include "math/frame.h"
#include "math/special.h"
#include "math/warp.h"
#include "medium/volume.h"
#include "texture/slots.h"

namespace norrsken::NORRSKEN_ISA {

struct PhaseSample {
  Vec3f wi;
  Float pdf_sa;
};

/// The block at `offset`, and where the path is.
struct PhaseReader {
  const SceneView& scene;
  UInt offset;
  const Vec3f& position;
  Mask active;

  template <class Block, class Slot>
  NORRSKEN_INLINE auto get(Slot Block::*member) const {
    return gather_slot(scene.parameters, member, offset, active);
  }
};

/// The cosine of the angle by which light is turned: 1 is straight on.
NORRSKEN_INLINE Float scattering_cosine(const Vec3f& wo, const Vec3f& wi) { return -dot(wo, wi); }

/// The direction with that cosine, `turns` around.
NORRSKEN_INLINE Vec3f scattered(const Vec3f& wo, Float cosine, Float turns) {
  const Float sine = sqrt(max(fnma(cosine, cosine, 1.0f), 0.0f));
  const SinCos phi = sin_cos_turns(turns);
  return normalize(make_frame(-wo).to_world({sine * phi.cos, sine * phi.sin, cosine}));
}

}  // namespace norrsken::NORRSKEN_ISA
