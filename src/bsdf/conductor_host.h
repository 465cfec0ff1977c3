// What a conductor is made of: parameters that smooth and rough ones share.
#pragma once

#include <string>

#include "compile/materials.h"

namespace norrsken {

struct ConductorMaterial {
  ColorOrTexture eta, k;  ///< index of refraction eta + i k
  ColorOrTexture specular_reflectance;
  std::string description;  ///< for `norrsken info`
};

/// `material`, or else `eta` and `k`; `specular_reflectance`.
ConductorMaterial read_conductor(Parameters& p, Materials& materials);

}  // namespace norrsken
