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
namespace {

constexpr ColorParameter kSigmaT{.name = "sigma_t",
                                 .fallback = 1,
                                 .range = kFromZero,
                                 .text = "extinction: what is scattered and absorbed of light on a unit of length"};

}  // namespace

MediumRecord compile_medium_heterogeneous(Parameters& p, Media& media) {
  MediumRecord record{};
  Volume volume;
  if (const Node::Child* child = p.volume(kSigmaT.name)) {
    volume = media.volume(*child->node);
    warn_beyond(p, kSigmaT.name.data(), volume, kSigmaT.range);
  } else {
    volume = add_constant(media, p.read(kSigmaT).rgb(), glm::dmat4(1));
  }
  double scale = p.read(kScale);
  if (scale * volume.max > kMostExtinction) {
    p.error(kSigmaT.name, fmt::format("an extinction of {:g} per unit of length", scale * volume.max),
            fmt::format("up to {:g}, with 'scale'", kMostExtinction));
    scale = 0;
  }
  for (float& s : record.sigma_t) s = static_cast<float>(scale);
  read_scattering(p, media, record);
  if (volume.index == kNone) return record;
  record.sigma_volume = volume.index;
  const MajorantSummary majorants = add_majorants(media.tables(), volume, scale, record);
  media.describe(p.node(), fmt::format("sigma_t up to {:.4g}, {:.4g} as the mean of {} majorants", scale * volume.max,
                                       majorants.mean, majorants.count));
  return record;
}

}  // namespace norrsken
