// What the host sides of the BSDFs that stand before others share.
#pragma once

#include "compile/plugins.h"

namespace norrsken {

/// The materials of the `count` BSDFs that must stand inside; empty after a complaint.
std::vector<Material> nested_bsdfs(Parameters& p, Builder& builder, std::size_t count);

/// The words inside and the flags that bump and normal maps begin with, for the front and the back; empty after a
/// complaint. More maps inside each other than a hit remembers are refused.
struct PerturbedBlocks {
  ParameterBlock front, back;
};
std::optional<PerturbedBlocks> perturbed_blocks(Parameters& p, Builder& builder);

}  // namespace norrsken
