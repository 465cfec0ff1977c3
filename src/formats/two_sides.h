// The two sides of a surface that shines on both, where emitters shine from the front alone.
#pragma once

#include <array>

#include "norrsken/description.h"

namespace norrsken {

/// A mesh twice, facing to either side, and each of the two just off the other.
std::array<Mesh, 2> two_sides(const Mesh& mesh);

}  // namespace norrsken
