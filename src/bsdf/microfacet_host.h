// The parameters that all microfacet models share.
#pragma once

#include <string>

#include "bsdf/microfacet.h"
#include "compile/materials.h"

namespace norrsken {

/// Roughness 100 is the slope of the roughest surface that is accepted.
inline constexpr NumberParameter kAlpha{
    .name = "alpha", .fallback = 0.1, .range = {0, 100}, .text = "roughness, the root mean square slope of the facets"};
inline constexpr NumberParameter kAlphaU{.name = "alpha_u",
                                         .fallback = 0.1,
                                         .range = kAlpha.range,
                                         .text = "the same along u of the texture coordinates; both or none",
                                         .in_place_of = "alpha"};
inline constexpr NumberParameter kAlphaV{.name = "alpha_v",
                                         .fallback = 0.1,
                                         .range = kAlpha.range,
                                         .text = "the same along v of the texture coordinates; both or none",
                                         .in_place_of = "alpha"};
inline constexpr ChoiceParameter<bool> kIsGgx{
    .name = "distribution", .words = {{{"beckmann", false}, {"ggx", true}}}, .text = "of the facets' normals"};
/// Visible normals are always what is sampled.
inline constexpr BooleanParameter kSampleVisible{
    .name = "sample_visible", .fallback = true, .text = "accepted; visible normals are sampled either way"};

struct Roughness {
  NumberOrTexture alpha_u, alpha_v;
  bool ggx;
};

/// All of the above.
Roughness read_roughness(Parameters& p, Materials& materials);

isa_host::RoughnessSlots roughness_slots(const Roughness& roughness);

/// For `norrsken info`: "ggx, alpha 0.1".
std::string describe_roughness(const Roughness& roughness);

}  // namespace norrsken
