#include "medium/medium_host.h"

#include <fmt/core.h>

#include "medium/isotropic.h"

namespace norrsken {

void warn_beyond(Parameters& p, const char* name, const Volume& volume, const Range& range) {
  if (volume.index == kNone || (volume.min >= range.min && volume.max <= range.max)) return;
  const std::string below = volume.min < range.min ? fmt::format("below {:g} for {:g}", range.min, range.min) : "",
                    above = volume.max > range.max ? fmt::format("above {:g} for {:g}", range.max, range.max) : "";
  p.diagnostics().warning(p.where(name),
                          fmt::format("the values of {} go from {:g} to {:g}: those {}{}{} are taken", name, volume.min,
                                      volume.max, below, below.empty() || above.empty() ? "" : ", and those ", above));
}

void read_scattering(Parameters& p, Media& media, MediumRecord& record) {
  record.scatters = 1;
  if (const Node::Child* child = p.volume(kAlbedo.name)) {
    const Volume volume = media.volume(*child->node);
    warn_beyond(p, kAlbedo.name.data(), volume, kAlbedo.range);
    record.albedo_volume = volume.index;
    if (volume.max <= 0) record.scatters = 0;
  } else {
    const glm::dvec3 albedo = p.read(kAlbedo).rgb();
    for (int c = 0; c < 3; ++c) record.albedo[c] = static_cast<float>(albedo[c]);
    if (albedo == glm::dvec3(0)) record.scatters = 0;
  }
  record.sample_emitters = p.read(kSampleEmitters) ? 1 : 0;
  const Node::Child* phase = p.child("phase");
  record.phase = phase ? media.phase(*phase->node) : media.add(isa_host::Isotropic::Stored{});
}

}  // namespace norrsken
