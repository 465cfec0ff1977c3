// Parameters that smooth and rough plastic share.
#pragma once

#include <string>

#include "compile/builder.h"

namespace norrsken {

struct CoatMaterial {
  ColorParameter diffuse_reflectance, specular_reflectance;
  double eta;  ///< index of refraction inside over that outside
  bool nonlinear;
  std::string description;  ///< for `norrsken info`
};

/// `diffuse_reflectance`, `specular_reflectance`, `int_ior` (default polypropylene), `ext_ior` (default air), `nonlinear`.
CoatMaterial read_coat(Parameters& p, Builder& builder);

/// The floats that load_coat (coat.h) reads; `from_inside` is the coat's reflectance for diffuse light from below.
ParameterBlock coat_block(const CoatMaterial& coat, double from_inside);

}  // namespace norrsken
