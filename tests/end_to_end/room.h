// The hexagon room, small, for the statistical tests.
#pragma once

#include <optional>
#include <string>

#include "tests/end_to_end/rendering.h"
#include "tests/oracle/room_reference.h"

namespace norrsken::end_to_end {

using oracle::kRoomSize;
using oracle::RoomResolution;

inline constexpr int kRoomSeeds = 24;  ///< replicates

struct RoomVariant {
  std::string light = "area";
  std::string integrator = "path";
  int bounces = 3;
  int shadow_rays = 1;
  std::optional<std::string> sampler = {};  ///< in place of the scene's
};

inline Scene load_room(const RoomVariant& variant) {
  return load("hexagon_room", {.parameters = {{"light", variant.light},
                                              {"integrator", variant.integrator},
                                              {"bounces", std::to_string(variant.bounces)},
                                              {"shadow_rays", std::to_string(variant.shadow_rays)}},
                               .sampler = variant.sampler,
                               .width = kRoomSize,
                               .height = kRoomSize});
}

/// Replicates of the room, `first_seed` and on.
inline statistics::RegionMeans room_replicates(const RoomVariant& variant, int samples_per_pixel,
                                               std::uint64_t first_seed, const RoomResolution& resolution,
                                               RenderOptions options = {}) {
  options.samples_per_pixel = samples_per_pixel;
  options.threads = kThreads;
  return render_replicates(load_room(variant), options, kRoomSeeds, oracle::room_regions(resolution), first_seed);
}

}  // namespace norrsken::end_to_end
