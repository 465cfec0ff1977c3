// Writes tests/oracle/room_reference.txt to standard output: make_room_reference STRATA [CASE]...
// Takes about (STRATA / 16)^2 times five minutes for all cases.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/oracle/room_reference.h"

using norrsken::oracle::RoomCase;

int main(int argc, char** argv) {
  constexpr int kReplicates = 24;
  constexpr std::uint64_t kFirstSeed = 1000;
  const int strata = argc > 1 ? std::atoi(argv[1]) : 0;
  if (strata < 1) {
    fmt::print(stderr, "usage: make_room_reference STRATA [CASE]...\n");
    return 64;
  }
  for (const RoomCase& room : norrsken::oracle::room_cases()) {
    const auto asked = [&](const char* name) { return room.name == name; };
    if (argc > 2 && std::none_of(argv + 2, argv + argc, asked)) continue;
    const auto estimates = norrsken::oracle::estimate_room(room, strata, kReplicates, kFirstSeed);
    fmt::print("{}", norrsken::oracle::room_reference_lines(room.name, estimates));
    std::fflush(stdout);
  }
  return 0;
}
