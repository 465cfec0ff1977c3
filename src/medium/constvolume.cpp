// constvolume: one value everywhere. As the extinction of a heterogeneous medium it fills the box that its unit cube is in.
#include <fmt/core.h>

#include "medium/majorants_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kValue{.name = "value", .fallback = 1, .text = "the value"};
constexpr TransformParameter kToWorld{.name = "to_world", .text = "where the unit cube stands"};

}  // namespace

Volume compile_volume_constvolume(Parameters& p, Media& media) {
  const glm::dvec3 value = p.read(kValue).rgb();
  media.describe(p.node(), fmt::format("{:.4g} {:.4g} {:.4g}", value.r, value.g, value.b));
  return add_constant(media, value, p.read(kToWorld));
}

}  // namespace norrsken
