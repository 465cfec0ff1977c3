// The hexagon room as the oracle sees it. To tell a bias of half a percent takes the oracle minutes, so what it
// estimates is kept in room_reference.txt, which make_room_reference writes anew; a test repeats it coarsely.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/oracle/oracle.h"

namespace norrsken::oracle {

struct RoomCase {
  std::string_view name;
  RoomLight light;
  Settings settings;
};

std::span<const RoomCase> room_cases();

inline constexpr int kRoomSize = 64;  ///< pixels a side

/// The regions in which the room is compared, finer from grid to grid, with the bias that has to be seen in each.
struct RoomResolution {
  double whole = 0.005, half = 0.0075, quadrant = 0.015, block = 0.08;
};
std::vector<statistics::Region> room_regions(const RoomResolution& resolution);

/// What the oracle sees; `strata` and `replicates` as in Sampling.
statistics::RegionEstimates estimate_room(const RoomCase& room, int strata, int replicates, std::uint64_t first_seed,
                                          const RoomResolution& resolution = {});

/// What is written in room_reference.txt. Throws std::runtime_error if the case is not there.
statistics::RegionEstimates read_room_reference(std::string_view name);
/// The lines that it consists of.
std::string room_reference_lines(std::string_view name, const statistics::RegionEstimates& estimates);

}  // namespace norrsken::oracle
