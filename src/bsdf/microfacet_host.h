// The parameters that all microfacet models share.
#pragma once

#include <string>

#include "compile/builder.h"

namespace norrsken {

/// Slope of the roughest surface that is accepted.
inline constexpr double kMaxAlpha = 100;

struct Roughness {
  ScalarParameter alpha_u, alpha_v;
  bool ggx;
};

/// `distribution` ("beckmann" or "ggx"), and `alpha` or both of `alpha_u` and `alpha_v`. `sample_visible` is read and
/// changes nothing: visible normals are always what is sampled.
Roughness read_roughness(Parameters& p, Builder& builder);

/// `distribution` alone.
bool read_is_ggx(Parameters& p);

/// Two scalars and 1 for GGX, as the kernels' load_microfacet reads them.
void add_roughness(ParameterBlock& block, const Roughness& roughness);

/// For `norrsken info`: "ggx, alpha 0.1".
std::string describe_roughness(const Roughness& roughness);

}  // namespace norrsken
