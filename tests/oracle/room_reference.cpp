#include "tests/oracle/room_reference.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace norrsken::oracle {

using statistics::Estimate;
using statistics::Grid;
using statistics::Region;
using statistics::RegionEstimates;

std::span<const RoomCase> room_cases() {
  static constexpr RoomCase kCases[] = {
      {"area_0_bounces", RoomLight::area, {.bounces = 0}},
      {"area_1_bounce", RoomLight::area, {.bounces = 1}},
      {"area_2_bounces", RoomLight::area, {.bounces = 2}},
      {"area_3_bounces", RoomLight::area, {.bounces = 3}},
      {"area_4_bounces", RoomLight::area, {.bounces = 4}},
      {"area_whitted", RoomLight::area, {.bounces = 3, .diffuse_bounces = false}},
      {"point_1_bounce", RoomLight::point, {.bounces = 1}},
      {"point_3_bounces", RoomLight::point, {.bounces = 3}},
      {"point_whitted", RoomLight::point, {.bounces = 3, .diffuse_bounces = false}},
  };
  return kCases;
}

std::vector<Region> room_regions(const RoomResolution& resolution) {
  return statistics::regions_of(kRoomSize, kRoomSize,
                                std::array{Grid{1, 1, resolution.whole}, Grid{1, 2, resolution.half},
                                           Grid{2, 2, resolution.quadrant}, Grid{4, 4, resolution.block}});
}

RegionEstimates estimate_room(const RoomCase& room, int strata, int replicates, std::uint64_t first_seed,
                              const RoomResolution& resolution) {
  return estimate(hexagon_room(room.light), hexagon_room_camera(), room.settings,
                  {kRoomSize, kRoomSize, strata, replicates, first_seed}, room_regions(resolution));
}

// One line for each region: case, region, replicates, then mean and variance of the mean for R, G and B.
RegionEstimates read_room_reference(std::string_view name) {
  RegionEstimates result{room_regions({}), {}};
  std::ifstream file(NORRSKEN_ROOM_REFERENCE);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string of_case, region;
    int replicates = 0;
    if (!std::getline(fields, of_case, '\t') || of_case != name) continue;
    std::getline(fields, region, '\t');
    fields >> replicates;
    std::array<Estimate, 3> values;
    for (Estimate& value : values) {
      fields >> value.mean >> value.variance;
      value.replicates = replicates;
    }
    const std::size_t index = result.values.size();
    if (!fields || index >= result.regions.size() || region != result.regions[index].name) {
      throw std::runtime_error("malformed line in " NORRSKEN_ROOM_REFERENCE ": " + line);
    }
    result.values.push_back(values);
  }
  if (result.values.size() != result.regions.size()) {
    throw std::runtime_error(NORRSKEN_ROOM_REFERENCE " lacks " + std::string(name));
  }
  return result;
}

std::string room_reference_lines(std::string_view name, const RegionEstimates& estimates) {
  std::string text;
  for (std::size_t r = 0; r < estimates.regions.size(); ++r) {
    text += fmt::format("{}\t{}\t{}", name, estimates.regions[r].name, estimates.values[r][0].replicates);
    for (const Estimate& value : estimates.values[r])
      text += fmt::format("\t{:.9g}\t{:.4g}", value.mean, value.variance);
    text += '\n';
  }
  return text;
}

}  // namespace norrsken::oracle
