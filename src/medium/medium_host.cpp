#include "medium/medium_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "medium/majorants_host.h"

namespace norrsken {

void warn_beyond(Parameters& p, std::string_view name, const Volume& volume, const Range& range) {
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
    warn_beyond(p, kAlbedo.name, volume, kAlbedo.range);
    record.albedo_volume = volume.index;
    if (volume.max <= 0) record.scatters = 0;
  } else {
    const glm::dvec3 albedo = p.read(kAlbedo).rgb();
    for (int c = 0; c < 3; ++c) record.albedo[c] = static_cast<float>(albedo[c]);
    if (albedo == glm::dvec3(0)) record.scatters = 0;
  }
  record.sample_emitters = p.read(kSampleEmitters) ? 1 : 0;
  const Node::Child* phase = p.child("phase");
  record.flakes_volume = kNone;
  record.phase = phase ? media.phase(*phase->node) : default_phase(media);
  if (record.phase >> 24 != static_cast<std::uint32_t>(PhaseKind::sggx)) return;
  const std::uint32_t offset = record.phase & kPhaseOffsetMask;
  if (offset < media.tables().parameters.size())
    record.flakes_volume = std::bit_cast<std::uint32_t>(media.tables().parameters[offset]);
}

double largest_area(const SceneTables& tables, const MediumRecord& record) {
  if (record.flakes_volume == kNone) return 1;
  const VolumeRecord& volume = tables.volumes[record.flakes_volume];
  // The square of the area is at most the largest eigenvalue, and that at most the trace.
  double largest = double{volume.value[0]} + double{volume.value[1]} + double{volume.value[2]};
  const auto places = static_cast<std::size_t>(volume.size_x) * static_cast<std::size_t>(volume.size_y) *
                      static_cast<std::size_t>(volume.size_z);
  for (std::size_t i = 0; i < places; ++i) {
    const float* s = tables.texels.data() + volume.first + 6 * i;
    largest = std::max(largest, double{s[0]} + double{s[1]} + double{s[2]});
  }
  return std::sqrt(std::max(largest, 0.0));
}

void set_extinction(Parameters& p, Media& media, const Volume& volume, double scale, MediumRecord& record) {
  const double most = scale * largest_area(media.tables(), record);
  if (most * volume.max > kMostExtinction) {
    p.error("sigma_t", fmt::format("an extinction of {:g} per unit of length", most * volume.max),
            fmt::format("up to {:g}, with 'scale'", kMostExtinction));
    return;
  }
  for (float& s : record.sigma_t) s = static_cast<float>(scale);
  record.sigma_volume = volume.index;
  const MajorantSummary majorants = add_majorants(media.tables(), volume, most, record);
  media.describe(p.node(), fmt::format("sigma_t up to {:.4g}, {:.4g} as the mean of {} majorant{}", most * volume.max,
                                       majorants.mean, majorants.count, majorants.count == 1 ? "" : "s"));
}

}  // namespace norrsken
