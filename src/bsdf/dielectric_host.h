// Parameters that smooth, thin and rough dielectrics share.
#pragma once

#include <string>

#include "compile/builder.h"

namespace norrsken {

struct DielectricMaterial {
  double eta;  ///< index of refraction inside over that outside
  ColorParameter specular_reflectance, specular_transmittance;
  std::string description;  ///< for `norrsken info`
};

/// `int_ior` (default bk7) and `ext_ior` (default air), `specular_reflectance`, `specular_transmittance`.
DielectricMaterial read_dielectric(Parameters& p, Builder& builder);

}  // namespace norrsken
