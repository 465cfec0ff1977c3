// Parameters that smooth, thin and rough dielectrics share.
#pragma once

#include <string>

#include "bsdf/ior_host.h"
#include "compile/materials.h"

namespace norrsken {

struct DielectricMaterial {
  double eta;  ///< index of refraction inside over that outside
  ColorOrTexture specular_reflectance, specular_transmittance;
  std::string description;  ///< for `norrsken info`
};

/// The two indices of refraction, `specular_reflectance`, `specular_transmittance`.
DielectricMaterial read_dielectric(Parameters& p, Materials& materials, const IorParameter& inside,
                                   const IorParameter& outside);

}  // namespace norrsken
