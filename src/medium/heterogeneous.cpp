// heterogeneous: a medium whose extinction differs from place to place. It fills what the shapes that name it enclose, as far
// as its volume goes: outside the box, along the axes of the world, that holds the volume's unit cube, there is none of it.
//
// Light is followed by null collisions: up to places that are drawn by the largest extinction of each cell of a coarse
// grid, 8 values wide, where it is then scattered, or goes on.
#include <fmt/core.h>

#include <cmath>

#include "medium/majorants_host.h"
#include "medium/medium_host.h"

namespace norrsken {
MediumRecord compile_medium_heterogeneous(Parameters& p, Media& media) {
  MediumRecord record{.sigma_t = {}, .albedo = {}};
  Volume volume;
  if (const Node::Child* child = p.volume(kSigmaT.name)) {
    volume = media.volume(*child->node);
    warn_beyond(p, kSigmaT.name, volume, kSigmaT.range);
  } else {
    volume = add_constant(media, p.read(kSigmaT).rgb(), glm::dmat4(1));
  }
  const double scale = p.read(kScale);
  read_scattering(p, media, record);
  if (volume.index != kNone) set_extinction(p, media, volume, scale, record);
  return record;
}

}  // namespace norrsken
