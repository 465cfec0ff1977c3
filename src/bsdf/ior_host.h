// Indices of refraction of transparent materials, by number or by name.
#pragma once

#include <string_view>

#include "scene/parameters.h"

namespace norrsken {

/// A number, or the name of a material in any case.
struct IorParameter {
  std::string_view name;
  std::string_view fallback;  ///< a material
  std::string_view text;
};

/// `inside` over `outside`: what light that enters finds.
double read_relative_ior(Parameters& p, const IorParameter& inside, const IorParameter& outside);

/// An error for models that two sides alike make no sense to.
void refuse_same_ior(Parameters& p, const IorParameter& inside, const IorParameter& outside);

}  // namespace norrsken
