// What the host sides of the BSDFs that stand before others share.
#pragma once

#include <optional>
#include <vector>

#include "bsdf/resolved.h"
#include "compile/materials.h"

namespace norrsken {

/// The materials of the `count` BSDFs that must stand inside; empty after a complaint.
std::vector<Material> nested_bsdfs(Parameters& p, Materials& materials, std::size_t count);

/// What the blocks of a bump or normal map begin with, for the front and the back; empty after a complaint. More maps
/// inside each other than a hit remembers are refused.
struct PerturbedSides {
  isa_host::PerturbedSlots front, back;
};
std::optional<PerturbedSides> perturbed_slots(Parameters& p, Materials& materials);

}  // namespace norrsken
