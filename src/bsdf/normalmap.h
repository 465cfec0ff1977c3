// Model       The BSDF inside, with shading normals from a texture.
// Measure     that of the BSDF inside
// Source      Mitsuba 3's documentation of its plugin
// Departures  none
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

struct NormalMap {
  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::normalmap;
    PerturbedSlots around;
    ColorSlot normals;
  };

  static NORRSKEN_INLINE Vec3f normal(const ParameterReader& p, const Unperturbed&) {
    const Color c = p.get(&Stored::normals);
    const auto decoded = [](Float x) { return fms(2.0f, x, 1.0f); };
    return {decoded(c.r), decoded(c.g), decoded(c.b)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
