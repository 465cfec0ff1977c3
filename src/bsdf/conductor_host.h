// What a conductor is made of: parameters that smooth and rough ones share.
#pragma once

#include <string>

#include "compile/builder.h"

namespace norrsken {

struct ConductorMaterial {
  ColorParameter eta, k;  ///< index of refraction eta + i k
  ColorParameter specular_reflectance;
  std::string description;  ///< for `norrsken info`
};

/// `material`, or else `eta` and `k`; `specular_reflectance`.
ConductorMaterial read_conductor(Parameters& p, Builder& builder);

}  // namespace norrsken
