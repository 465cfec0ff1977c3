// What a conductor is made of: parameters that smooth and rough ones share.
#pragma once

#include <string>

#include "compile/builder.h"

namespace norrsken {

struct ConductorMaterial {
  ColorParameter eta, k;  ///< index of refraction eta + i k
  ColorParameter specular_reflectance;
  std::string description;  ///< for `norrsken info`

  bool reflects_nothing() const {
    return specular_reflectance.texture == 0 && specular_reflectance.value == glm::dvec3(0);
  }
};

/// `material`, or else `eta` and `k`; `specular_reflectance`.
ConductorMaterial read_conductor(Parameters& p, Builder& builder);

}  // namespace norrsken
