// What a BSDF becomes.
#pragma once

#include "tables/scene_tables.h"

namespace norrsken {

/// The two sides of a surface; `front` is the one that the normal points to.
struct Material {
  MaterialWord front = make_material(BsdfKind::absorb, 0);
  MaterialWord back = make_material(BsdfKind::absorb, 0);
  std::uint32_t choices = 0;  ///< the most that a way from here to a model has
  std::uint32_t maps = 0;     ///< the same of bump and normal maps
  Variation variation = Variation::none;
};

}  // namespace norrsken
