// Indices of refraction of transparent materials, by number or by name.
#pragma once

#include <string_view>

#include "scene/parameters.h"

namespace norrsken {

/// What the parameter says: a number greater than 0, or the name of a material (in any case).
double read_ior(Parameters& p, std::string_view name, std::string_view fallback);

/// `int_ior` over `ext_ior`: what light that enters finds. The exterior is air unless told.
double read_relative_ior(Parameters& p, std::string_view interior);

}  // namespace norrsken
