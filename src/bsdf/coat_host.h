// Parameters that smooth and rough plastic share.
#pragma once

#include <string>

#include "bsdf/coat.h"
#include "bsdf/ior_host.h"
#include "compile/materials.h"

namespace norrsken {

struct CoatMaterial {
  ColorOrTexture diffuse_reflectance, specular_reflectance;
  double eta;  ///< index of refraction inside over that outside
  bool nonlinear;
  std::string description;  ///< for `norrsken info`
};

/// `diffuse_reflectance`, `specular_reflectance`, the two indices of refraction, `nonlinear`.
CoatMaterial read_coat(Parameters& p, Materials& materials, const IorParameter& inside, const IorParameter& outside);

/// `from_inside` is the coat's reflectance for diffuse light from below.
isa_host::CoatSlots coat_slots(const CoatMaterial& coat, double from_inside);

}  // namespace norrsken
